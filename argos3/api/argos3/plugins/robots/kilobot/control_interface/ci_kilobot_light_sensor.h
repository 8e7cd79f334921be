// The light sensor of a Kilobot.
#pragma once

#include <argos3/core/control_interface/ci_sensor.h>

namespace argos
{

class CCI_KilobotLightSensor : public CCI_Sensor
{
public:
  // Returns the brightness, 0 to 1024: for each visible light of intensity I at d m, exp(-2 d / I) (1 - angle / pi) of
  // 1024, if d / I is below 2.5.
  SInt16 GetReading() const { return m_nReading; }

protected:
  SInt16 m_nReading = 0;
};

}  // namespace argos

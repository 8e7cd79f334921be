// What is left in the battery.
#pragma once

#include <argos3/core/control_interface/ci_sensor.h>

namespace argos
{

class CCI_BatterySensor : public CCI_Sensor
{
public:
  // 0 to 1; seconds.
  struct SReading
  {
    Real AvailableCharge = 1;
    Real TimeLeft = 0;
  };
  const SReading& GetReading() const { return m_sReading; }

protected:
  SReading m_sReading;
};

}  // namespace argos

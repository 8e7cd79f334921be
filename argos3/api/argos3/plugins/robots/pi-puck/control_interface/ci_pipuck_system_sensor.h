// The clock and the thermometer of a Pi-Puck. In ARGoS3 scripts alone can read them.
#pragma once

#include <argos3/core/control_interface/ci_sensor.h>

namespace argos
{

class CCI_PiPuckSystemSensor : public CCI_Sensor
{
public:
  Real GetTime() const { return m_fTime; }
  Real GetTemperature() const { return m_fTemperature; }

protected:
  Real m_fTime = 0;         // s since the start or the last reset
  Real m_fTemperature = 0;  // always 0
};

}  // namespace argos

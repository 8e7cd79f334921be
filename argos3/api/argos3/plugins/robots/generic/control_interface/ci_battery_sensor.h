// The charge of the battery.
#pragma once

#include <argos3/core/control_interface/ci_sensor.h>

namespace argos
{

class CCI_BatterySensor : public CCI_Sensor
{
public:
  // The charge is 0 to 1; the time is in seconds.
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

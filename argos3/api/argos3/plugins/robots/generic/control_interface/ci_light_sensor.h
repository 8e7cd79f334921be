// Light sensors around a foot-bot or an e-puck.
#pragma once

#include <argos3/core/control_interface/ci_sensor.h>

#include <vector>

namespace argos
{

class CCI_LightSensor : public CCI_Sensor
{
public:
  // Returns readings from 0 (dark) to 1: the sum of (intensity / m)^2 of the lights that a sensor sees. They are
  // counter-clockwise: 24 of a foot-bot from 7.5 degrees on, 8 of an e-puck from 22.5 degrees on.
  const std::vector<Real>& GetReadings() const
  {
    Demand();
    return m_tReadings;
  }

protected:
  std::vector<Real> m_tReadings;
};

}  // namespace argos

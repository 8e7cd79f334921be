// The infrared sensors around any robot that has them. A reading is exp(-distance in metres) of the nearest body, 0 if
// none is in range.
#pragma once

#include <argos3/core/control_interface/ci_sensor.h>

namespace argos
{

class CCI_ProximitySensor : public CCI_Sensor
{
public:
  using TReadings = std::vector<Real>;
  // Returns the readings counter-clockwise from the front left.
  const TReadings& GetReadings() const
  {
    Demand();
    return m_tReadings;
  }

protected:
  TReadings m_tReadings;
};

}  // namespace argos

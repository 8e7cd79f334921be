// The infrared sensors around any robot that has them: exp(-distance in metres) of what is nearest, 0 if nothing is in
// range.
#pragma once

#include <argos3/core/control_interface/ci_sensor.h>

namespace argos
{

class CCI_ProximitySensor : public CCI_Sensor
{
public:
  using TReadings = std::vector<Real>;
  // Counter-clockwise from the front left.
  const TReadings& GetReadings() const { return m_tReadings; }

protected:
  TReadings m_tReadings;
};

}  // namespace argos

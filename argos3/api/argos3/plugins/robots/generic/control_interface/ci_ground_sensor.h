// The sensors below any robot that has them: 0 on black, 1 on white.
#pragma once

#include <argos3/core/control_interface/ci_sensor.h>

namespace argos
{

class CCI_GroundSensor : public CCI_Sensor
{
public:
  using TReadings = std::vector<Real>;
  const TReadings& GetReadings() const
  {
    Demand();
    return m_tReadings;
  }

protected:
  TReadings m_tReadings;
};

}  // namespace argos

// Sensors in a ring around a robot: the common base of light and proximity sensors.
#pragma once

#include <argos3/core/control_interface/ci_sensor.h>
#include <argos3/core/utility/math/angles.h>
#include <argos3/core/utility/math/vector2.h>

namespace argos
{

class CRingSensor : public CCI_Sensor
{
public:
  struct SReading
  {
    Real Value = 0;  // 0 to 1
    CRadians Angle;  // counter-clockwise from the front
    SReading() = default;
    SReading(Real value, const CRadians& angle) : Value(value), Angle(angle) {}
  };
  using TReadings = std::vector<SReading>;
  const TReadings& GetReadings() const
  {
    Demand();
    return m_tReadings;
  }

protected:
  TReadings m_tReadings;
};

}  // namespace argos

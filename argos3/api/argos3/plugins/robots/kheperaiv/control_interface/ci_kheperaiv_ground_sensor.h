// The four sensors below a Khepera IV: 0 on black, 1 on white. They are numbered counter-clockwise from the front left.
#pragma once

#include <argos3/core/control_interface/ci_sensor.h>
#include <argos3/core/utility/math/vector2.h>

namespace argos
{

class CCI_KheperaIVGroundSensor : public CCI_Sensor
{
public:
  struct SReading
  {
    Real Value = 0;
    CVector2 Offset;  // from the middle of the robot, m
    SReading() = default;
    SReading(Real value, const CVector2& offset) : Value(value), Offset(offset) {}
  };
  using TReadings = std::vector<SReading>;
  const TReadings& GetReadings() const { return m_tReadings; }

protected:
  TReadings m_tReadings;
};

}  // namespace argos

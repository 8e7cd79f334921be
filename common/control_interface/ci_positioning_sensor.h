// CCI_PositioningSensor: the pose of a robot from a tracking system or satellites.
#pragma once

#include "common/control_interface/ci_device.h"
#include "common/math/pose.h"

namespace swarmanoid
{

class CCI_PositioningSensor : public CCI_SensorOf<CCI_PositioningSensor>
{
public:
  // Returns the position of the robot's base in the space, m.
  virtual Vector3 GetPosition() const = 0;
  // Returns the rotation from the frame of the robot to that of the space, as a unit quaternion.
  virtual Quaternion GetOrientation() const = 0;
  // Returns the heading in radians, counter-clockwise from the x axis of the space, -pi..pi.
  double GetHeading() const { return YawOf(GetOrientation()); }

  static void Declare(Declaration& columns)
  {
    constexpr auto kPrograms = CCI_Column::For::kPrograms;
    const auto part = [](const char* name) { return CCI_Column{.name = name, .audience = kPrograms}; };
    columns
        .AddAll({{"x", "m"}, {"y", "m"}, {"z", "m"}},
                [](const CCI_PositioningSensor& sensor) -> std::array<double, 3>
                {
                  const Vector3 at = sensor.GetPosition();
                  return {at.x(), at.y(), at.z()};
                })
        .AddAll({part("qx"), part("qy"), part("qz"), part("qw")},
                [](const CCI_PositioningSensor& sensor) -> std::array<double, 4>
                {
                  const Quaternion turn = sensor.GetOrientation();
                  return {turn.x(), turn.y(), turn.z(), turn.w()};
                })
        .Add({.name = "heading", .unit = "rad", .audience = CCI_Column::For::kPeople},
             &CCI_PositioningSensor::GetHeading);
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_PositioningSensor;

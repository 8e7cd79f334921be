// Where a robot is, as a tracking system or satellites tell it.
#pragma once

#include "common/control_interface/ci_device.h"
#include "common/math/pose.h"

namespace swarmanoid
{

class CCI_PositioningSensor : public CCI_Sensor
{
public:
  // In the space, m: of the base of the robot.
  virtual Vector3 GetPosition() const = 0;
  // From the frame of the robot to that of the space.
  virtual Quaternion GetOrientation() const = 0;
  // Radians, counter-clockwise from the x axis of the space, -pi..pi.
  double GetHeading() const { return YawOf(GetOrientation()); }

  std::vector<CCI_Column> Columns() const override
  {
    return {{"x", "m"}, {"y", "m"}, {"z", "m"}, {"qx"}, {"qy"}, {"qz"}, {"qw"}};
  }
  void ReadColumns(std::vector<double>& values) const override
  {
    const Vector3 at = GetPosition();
    const Quaternion turn = GetOrientation();
    values.insert(values.end(), {at.x(), at.y(), at.z(), turn.x(), turn.y(), turn.z(), turn.w()});
  }
  void Describe(std::vector<CCI_Reading>& readings) const override
  {
    const Vector3 position = GetPosition();
    readings.push_back({"x", "m", position.x()});
    readings.push_back({"y", "m", position.y()});
    readings.push_back({"z", "m", position.z()});
    readings.push_back({"heading", "rad", GetHeading()});
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_PositioningSensor;

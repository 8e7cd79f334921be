#include "real_robot/ros2_controller/wheel_odometry.h"

#include <cmath>
#include <istream>
#include <ostream>

#include "common/math/elementary.h"

namespace swarmanoid::ros2
{

void WheelOdometry::Advance(double left, double right, double seconds)
{
  forward_ = (left + right) / 2 * radius_m_;
  turn_ = (right - left) / distance_m_ * radius_m_;
  const double half = turn_ * seconds / 2;
  const double chord = forward_ * seconds * (std::abs(half) > 1e-9 ? SinCosOf(half).sin / half : 1);
  const SinCos direction = SinCosOf(heading_ + half);
  x_ += chord * direction.cos;
  y_ += chord * direction.sin;
  heading_ = WrapAngle(heading_ + 2 * half);
  left_ += left * seconds;
  right_ += right * seconds;
}

void WheelOdometry::Save(std::ostream& state) const
{
  for (const double number : {x_, y_, heading_, forward_, turn_, left_, right_}) state << ' ' << number;
}

void WheelOdometry::Load(std::istream& state) { state >> x_ >> y_ >> heading_ >> forward_ >> turn_ >> left_ >> right_; }

}  // namespace swarmanoid::ros2

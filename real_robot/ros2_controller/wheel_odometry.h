// Dead reckoning of a robot on two wheels: its pose if the wheels rolled without slip. For the odometry of
// ros2_controller, in the thread of the controllers.
#pragma once

#include <iosfwd>

namespace swarmanoid::ros2
{

class WheelOdometry
{
public:
  // Lengths are in metres. The pose starts at 0, 0 with heading 0.
  WheelOdometry(double wheel_radius_m, double interwheel_distance_m)
      : radius_m_(wheel_radius_m), distance_m_(interwheel_distance_m)
  {
  }

  // Adds a motion on a part of a circle: the wheels turned at these speeds (rad/s) for this time (s).
  void Advance(double left, double right, double seconds);

  double X() const { return x_; }
  double Y() const { return y_; }
  double Heading() const { return heading_; }
  // Return the angles of the wheels, in rad, from 0 on.
  double LeftAngle() const { return left_; }
  double RightAngle() const { return right_; }
  // Return the speed ahead in m/s, and to the left in rad/s, in the last Advance.
  double Forward() const { return forward_; }
  double Turn() const { return turn_; }

  void Save(std::ostream& state) const;
  void Load(std::istream& state);

private:
  double radius_m_;
  double distance_m_;
  double x_ = 0;
  double y_ = 0;
  double heading_ = 0;
  double forward_ = 0;
  double turn_ = 0;
  double left_ = 0;
  double right_ = 0;
};

}  // namespace swarmanoid::ros2

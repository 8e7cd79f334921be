// The drive of a robot that a node of ROS 2 controls, and the topic of the node's velocity commands. ros2_controller
// uses it in the thread of the controllers.
#pragma once

#include <optional>
#include <string>

#include "common/control_interface/ci_robot.h"
#include "common/control_interface/ci_wheels_actuator.h"
#include "common/control_interface/eyebot/ci_eyebot_propellers_actuator.h"
#include "common/control_interface/footbot/ci_footbot_wheels_actuator.h"
#include "geometry_msgs.h"
#include "real_robot/drivers/ros2/ros2_messages.h"

namespace swarmanoid::ros2
{

using TwistStamped = geometry_msgs::msg::dds_::TwistStamped_;

// Drives two wheels, or propellers.
class Drive
{
public:
  // Throws DriverError for a robot that has neither, and for actuators that no node can command.
  explicit Drive(const CCI_Robot& robot);

  bool HasWheels() const { return propellers_ == nullptr; }
  double Radius() const { return wheels_ != nullptr ? wheels_->GetWheelRadius() : Footbot::WHEEL_RADIUS_M; }
  double Distance() const
  {
    return wheels_ != nullptr ? wheels_->GetInterwheelDistance() : Footbot::INTERWHEEL_DISTANCE_M;
  }
  // Returns the speed of a wheel for a command, in rad/s. `side`: -1 left, 1 right.
  double WheelSpeed(const Twist& twist, double side) const
  {
    return (twist.linear().x() + side * twist.angular().z() * Distance() / 2) / Radius();
  }
  void Command(const Twist& twist);

private:
  using Footbot = CCI_FootBotWheelsActuator;

  CCI_FootBotWheelsActuator* footbot_ = nullptr;
  CCI_WheelsActuator* wheels_ = nullptr;
  CCI_EyeBotPropellersActuator* propellers_ = nullptr;
};

// Reads the commands of the node, with time stamps or without.
class Commands
{
public:
  Commands(const DriverSetup& setup, bool stamped, bool reliable);

  // Returns the next command, oldest first. If commands have time stamps, it must have this time. Throws DriverError
  // for a number that is not finite.
  std::optional<Twist> Take(const std::optional<builtin_interfaces::msg::dds_::Time_>& of);
  void Wait(double seconds) { plain_ ? plain_->Wait(seconds) : stamped_->Wait(seconds); }
  unsigned Publishers() const { return plain_ ? plain_->Publishers() : stamped_->Publishers(); }
  std::string Name() const { return plain_ ? plain_->Name() : stamped_->Name(); }

private:
  Twist Checked(const Twist& twist) const;

  std::optional<Subscriber<Twist>> plain_;
  std::optional<Subscriber<TwistStamped>> stamped_;
};

}  // namespace swarmanoid::ros2

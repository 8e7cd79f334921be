#include "real_robot/ros2_controller/drive.h"

#include <fmt/format.h>

#include <cmath>

#include "common/configuration/wording.h"
#include "real_robot/ros2_controller/device_commands.h"

namespace swarmanoid::ros2
{
namespace
{

bool IsFinite(const Twist& twist)
{
  for (const auto& part : {twist.linear(), twist.angular()})
    if (!std::isfinite(part.x()) || !std::isfinite(part.y()) || !std::isfinite(part.z())) return false;
  return true;
}

}  // namespace

Drive::Drive(const CCI_Robot& robot)
{
  for (const std::string& type : robot.ActuatorTypes())
    if (robot.GetActuator(type)->Columns().empty())
      throw DriverError(fmt::format("the actuator <{}> declares no columns, so it has no topic", type));
  if (robot.HasActuator("footbot_wheels"))
    footbot_ = &robot.Actuator<CCI_FootBotWheelsActuator>("footbot_wheels");
  else if (robot.HasActuator("wheels"))
    wheels_ = &robot.Actuator<CCI_WheelsActuator>("wheels");
  else if (robot.HasActuator("eyebot_propellers"))
    propellers_ = &robot.Actuator<CCI_EyeBotPropellersActuator>("eyebot_propellers");
  else
    throw DriverError(fmt::format("ros2_controller needs one of the actuators {}",
                                  Listed({kDrivingActuators.begin(), kDrivingActuators.end()})));
}

void Drive::Command(const Twist& twist)
{
  const double left = HasWheels() ? WheelSpeed(twist, -1) : 0;
  const double right = HasWheels() ? WheelSpeed(twist, 1) : 0;
  if (footbot_ != nullptr) footbot_->SetFootBotWheelsAngularVelocity(left, right);
  if (wheels_ != nullptr) wheels_->SetAngularVelocity(left, right);
  if (propellers_ != nullptr)
    propellers_->SetVelocity(twist.linear().x(), twist.linear().y(), twist.linear().z(), twist.angular().z());
}

Commands::Commands(const DriverSetup& setup, bool stamped, bool reliable)
{
  if (stamped)
    stamped_.emplace(setup, "cmd_vel", reliable);
  else
    plain_.emplace(setup, "cmd_vel", reliable);
}

std::optional<Twist> Commands::Take(const std::optional<builtin_interfaces::msg::dds_::Time_>& of)
{
  if (plain_) return plain_->TakeNext() ? std::optional(Checked(plain_->Latest())) : std::nullopt;
  while (stamped_->TakeNext())
    if (!of || stamped_->Latest().header().stamp() == *of) return Checked(stamped_->Latest().twist());
  return std::nullopt;
}

Twist Commands::Checked(const Twist& twist) const
{
  if (IsFinite(twist)) return twist;
  throw DriverError(Name() + ": a command is not a finite number");
}

}  // namespace swarmanoid::ros2

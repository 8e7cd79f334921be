// The flight devices of eye-bots, by a position and by a velocity. A command stays until the next one, so it is given
// to the propellers again after each control step. A position without a yaw keeps the heading of the first command, and
// a yaw without a position keeps the place; relative commands start from the place that the robot has when they are
// given (m, rad).
#include "argos3/plugin/device_parts.h"

#include <argos3/plugins/robots/generic/control_interface/ci_quadrotor_position_actuator.h>
#include <argos3/plugins/robots/generic/control_interface/ci_quadrotor_speed_actuator.h>

#include <optional>

#include "common/control_interface/ci_positioning_sensor.h"
#include "common/control_interface/eyebot/ci_eyebot_propellers_actuator.h"

namespace swarmanoid::argos3
{
namespace
{

class QuadrotorPosition : public ActuatorBridge, public argos::CCI_QuadRotorPositionActuator
{
public:
  explicit QuadrotorPosition(const DeviceSetup& setup)
      : translation_(setup.translation),
        propellers_(setup.robot.Actuator<CCI_EyeBotPropellersActuator>("eyebot_propellers")),
        place_(setup.robot.Sensor<swarmanoid::CCI_PositioningSensor>("positioning"))
  {
  }
  argos::CCI_Actuator& Actuator() override { return *this; }
  void SetAbsolutePosition(const argos::CVector3& position) override
  {
    position_ = translation_.OurPosition(position);
    if (!yaw_) yaw_ = place_.GetHeading();
  }
  void SetRelativePosition(const argos::CVector3& position) override
  {
    position_ =
        place_.GetPosition() + place_.GetOrientation() * Vector3(position.GetX(), position.GetY(), position.GetZ());
    if (!yaw_) yaw_ = place_.GetHeading();
  }
  void SetAbsoluteYaw(const argos::CRadians& yaw) override
  {
    yaw_ = yaw.GetValue();
    if (!position_) position_ = place_.GetPosition();
  }
  void SetRelativeYaw(const argos::CRadians& yaw) override
  {
    yaw_ = place_.GetHeading() + yaw.GetValue();
    if (!position_) position_ = place_.GetPosition();
  }
  // After a reset it stays at its place.
  void Reset() override
  {
    position_.reset();
    yaw_.reset();
    propellers_.SetVelocity(0, 0, 0, 0);
  }
  void Commit() override
  {
    if (position_) propellers_.SetPosition(*position_, *yaw_);
  }

private:
  const Translation& translation_;
  CCI_EyeBotPropellersActuator& propellers_;
  const swarmanoid::CCI_PositioningSensor& place_;
  std::optional<Vector3> position_;
  std::optional<double> yaw_;
};

class QuadrotorSpeed : public ActuatorBridge, public argos::CCI_QuadRotorSpeedActuator
{
public:
  explicit QuadrotorSpeed(const DeviceSetup& setup)
      : propellers_(setup.robot.Actuator<CCI_EyeBotPropellersActuator>("eyebot_propellers"))
  {
  }
  argos::CCI_Actuator& Actuator() override { return *this; }
  void Reset() override
  {
    velocity_ = argos::CVector3();
    yaw_rate_ = 0;
  }
  void SetLinearVelocity(const argos::CVector3& velocity) override { velocity_ = velocity; }
  void SetRotationalSpeed(const argos::CRadians& speed) override { yaw_rate_ = speed.GetValue(); }
  void Commit() override { propellers_.SetVelocity(velocity_.GetX(), velocity_.GetY(), velocity_.GetZ(), yaw_rate_); }

private:
  CCI_EyeBotPropellersActuator& propellers_;
  argos::CVector3 velocity_;
  double yaw_rate_ = 0;
};

}  // namespace

std::unique_ptr<ActuatorBridge> MakeEyeBotActuator(const std::string& tag, const DeviceSetup& setup)
{
  if (tag == "quadrotor_position") return std::make_unique<QuadrotorPosition>(setup);
  if (tag == "quadrotor_speed") return std::make_unique<QuadrotorSpeed>(setup);
  return nullptr;
}

}  // namespace swarmanoid::argos3

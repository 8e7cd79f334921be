// Drivers of the gripper and the turret of a footbot.
#include <algorithm>
#include <array>

#include "common/control_interface/footbot/ci_footbot_gripper_actuator.h"
#include "common/control_interface/footbot/ci_footbot_gripper_sensor.h"
#include "common/control_interface/footbot/ci_footbot_turret_actuator.h"
#include "common/control_interface/footbot/ci_footbot_turret_encoder_sensor.h"
#include "common/control_interface/footbot/ci_footbot_turret_torque_sensor.h"
#include "common/math/elementary.h"
#include "real_robot/drivers/ros2/topic_driver.h"

namespace swarmanoid::ros2
{
namespace
{

class Gripper : public TopicActuator<CCI_FootBotGripperActuator, NumberPublisher>
{
public:
  void Init(const DriverSetup& setup) override { output_.emplace(setup, setup.parameters.Text("topic")); }
  void SetGripper(double closed) override { closed_ = std::clamp(closed, 0.0, 1.0); }
  void Push() override { output_->Publish(closed_); }
  void Stop() override {}  // a held object must not fall

private:
  double closed_ = 0;
};

REGISTER_ACTUATOR_DRIVER(
    Gripper, DescribeDriver("footbot_gripper", "ros2", "std_msgs/msg/Float64 on gripper/command", {"footbot"},
                            {TopicParameter("topic", "gripper/command", "Topic of 0 (open) to 1 (closed).")}))

class GripperSensor : public JointSensor<CCI_FootBotGripperSensor>
{
public:
  void Init(const DriverSetup& setup) override
  {
    Listen(setup, {setup.parameters.Text("joint")}, {setup.parameters.Text("holding_topic")});
  }
  double GetAperture() const override { return Position(0); }
  bool IsGripping() const override { return IsOn(0); }
};

REGISTER_SENSOR_DRIVER(
    GripperSensor,
    DescribeDriver("footbot_gripper", "ros2",
                   "sensor_msgs/msg/JointState on joint_states, std_msgs/msg/Bool on gripper/holding", {"footbot"},
                   {TopicParameter("topic", "joint_states", "Topic of the aperture."),
                    TopicParameter("joint", "gripper", "Name of the gripper's joint; its position is the aperture."),
                    TopicParameter("holding_topic", "gripper/holding", "Topic of whether it holds something.")}))

class Turret : public TopicActuator<CCI_FootBotTurretActuator, NumberPublisher>
{
public:
  void Init(const DriverSetup& setup) override
  {
    output_.emplace(setup, setup.parameters.Text("topic"));
    limit_ = setup.parameters.Number("max_speed");
  }
  void SetTurretAngularVelocity(double velocity) override { velocity_ = std::clamp(velocity, -limit_, limit_); }
  void Push() override { output_->Publish(velocity_); }
  void Stop() override { output_->Publish(0); }

private:
  double limit_ = 0;
  double velocity_ = 0;
};

REGISTER_ACTUATOR_DRIVER(
    Turret, DescribeDriver("footbot_turret", "ros2", "std_msgs/msg/Float64 on turret/velocity", {"footbot"},
                           {TopicParameter("topic", "turret/velocity", "Topic of the angular velocity, rad/s."),
                            NumberParameter("max_speed", "rad/s", "3.14159265", "Fastest angular velocity.")}))

class TurretEncoder : public JointSensor<CCI_FootBotTurretEncoderSensor>
{
public:
  void Init(const DriverSetup& setup) override { Listen(setup, {setup.parameters.Text("joint")}); }
  double GetTurretAngle() const override { return WrapAngle(Position(0)); }
};

REGISTER_SENSOR_DRIVER(TurretEncoder,
                       DescribeDriver("footbot_turret_encoder", "ros2", "sensor_msgs/msg/JointState on joint_states",
                                      {"footbot"},
                                      {TopicParameter("topic", "joint_states", "Topic of the joint states."),
                                       TopicParameter("joint", "turret", "Name of the turret's joint.")}))

using WrenchStamped = geometry_msgs::msg::dds_::WrenchStamped_;

class TurretTorque : public TopicSensor<CCI_FootBotTurretTorqueSensor, WrenchStamped>
{
public:
  std::span<const double, 3> GetAllSensorReadings() const override { return readings_; }

private:
  void Configure(const Parameters& parameters) override
  {
    max_force_ = parameters.Number("max_force");
    max_torque_ = parameters.Number("max_torque");
  }
  void Read(const WrenchStamped& message) override
  {
    const auto& wrench = message.wrench();
    readings_ = {std::clamp(wrench.force().x() / max_force_, -1.0, 1.0),
                 std::clamp(wrench.force().y() / max_force_, -1.0, 1.0),
                 std::clamp(wrench.torque().z() / max_torque_, -1.0, 1.0)};
  }

  double max_force_ = 0;
  double max_torque_ = 0;
  std::array<double, 3> readings_{};
};

REGISTER_SENSOR_DRIVER(
    TurretTorque,
    DescribeDriver("footbot_turret_torque", "ros2", "geometry_msgs/msg/WrenchStamped on turret/wrench", {"footbot"},
                   {TopicParameter("topic", "turret/wrench", "Topic of force and torque in the frame of the turret."),
                    NumberParameter("max_force", "N", "25", "Force that reads as 1."),
                    NumberParameter("max_torque", "N m", "1.5", "Torque that reads as 1.")}))

}  // namespace
}  // namespace swarmanoid::ros2

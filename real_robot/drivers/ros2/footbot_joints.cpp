// The gripper and the turret of a footbot.
#include <algorithm>
#include <array>
#include <optional>

#include "common/control_interface/footbot/ci_footbot_gripper_actuator.h"
#include "common/control_interface/footbot/ci_footbot_gripper_sensor.h"
#include "common/control_interface/footbot/ci_footbot_turret_actuator.h"
#include "common/control_interface/footbot/ci_footbot_turret_encoder_sensor.h"
#include "common/control_interface/footbot/ci_footbot_turret_torque_sensor.h"
#include "common/math/elementary.h"
#include "real_robot/drivers/ros2/ros2_kit.h"

namespace swarmanoid::ros2
{
namespace
{

class Gripper : public CActuatorDriver, public CCI_FootBotGripperActuator
{
public:
  void Init(const DriverSetup& setup) override { publisher_.emplace(setup, setup.parameters.Text("topic")); }
  CCI_Actuator* Actuator() override { return this; }
  void SetGripper(double closed) override { closed_ = std::clamp(closed, 0.0, 1.0); }
  void Push() override { publisher_->Publish(closed_); }
  void Stop() override {}  // what is held must not fall
  std::vector<std::string> Sinks() const override { return {publisher_->Name()}; }

private:
  std::optional<NumberPublisher> publisher_;
  double closed_ = 0;
};

REGISTER_ACTUATOR_DRIVER(
    Gripper, DescribeDriver("footbot_gripper", "ros2", "std_msgs/msg/Float64 on gripper/command", {"footbot"},
                            {TopicParameter("topic", "gripper/command", "Topic of 0 (open) to 1 (closed).")}))

class GripperSensor : public CSensorDriver, public CCI_FootBotGripperSensor
{
public:
  void Init(const DriverSetup& setup) override
  {
    joints_.emplace(setup, setup.parameters.Text("topic"), std::vector{setup.parameters.Text("joint")});
    holding_.emplace(setup, setup.parameters.Text("holding_topic"));
  }
  CCI_Sensor* Sensor() override { return this; }
  double GetAperture() const override { return joints_->Position(0); }
  bool IsGripping() const override { return gripping_; }
  void Poll() override
  {
    joints_->Poll();
    if (holding_->TakeLatest()) gripping_ = holding_->Latest().data();
  }
  std::vector<DriverSource> Sources() const override
  {
    std::vector<DriverSource> sources{holding_->Source()};
    joints_->AddSources(sources);
    return sources;
  }

private:
  std::optional<JointReader> joints_;
  std::optional<Subscriber<Bool>> holding_;
  bool gripping_ = false;
};

REGISTER_SENSOR_DRIVER(
    GripperSensor,
    DescribeDriver("footbot_gripper", "ros2",
                   "sensor_msgs/msg/JointState on joint_states, std_msgs/msg/Bool on gripper/holding", {"footbot"},
                   {TopicParameter("topic", "joint_states", "Topic of the aperture."),
                    TopicParameter("joint", "gripper", "Name of the gripper's joint; its position is the aperture."),
                    TopicParameter("holding_topic", "gripper/holding", "Topic of whether it holds something.")}))

class Turret : public CActuatorDriver, public CCI_FootBotTurretActuator
{
public:
  void Init(const DriverSetup& setup) override
  {
    publisher_.emplace(setup, setup.parameters.Text("topic"));
    limit_ = setup.parameters.Number("max_speed");
  }
  CCI_Actuator* Actuator() override { return this; }
  void SetTurretAngularVelocity(double velocity) override { velocity_ = std::clamp(velocity, -limit_, limit_); }
  void Push() override { publisher_->Publish(velocity_); }
  void Stop() override { publisher_->Publish(0); }
  std::vector<std::string> Sinks() const override { return {publisher_->Name()}; }

private:
  std::optional<NumberPublisher> publisher_;
  double limit_ = 0;
  double velocity_ = 0;
};

REGISTER_ACTUATOR_DRIVER(
    Turret, DescribeDriver("footbot_turret", "ros2", "std_msgs/msg/Float64 on turret/velocity", {"footbot"},
                           {TopicParameter("topic", "turret/velocity", "Topic of the angular velocity, rad/s."),
                            NumberParameter("max_speed", "rad/s", "2", "Fastest angular velocity.")}))

class TurretEncoder : public CSensorDriver, public CCI_FootBotTurretEncoderSensor
{
public:
  void Init(const DriverSetup& setup) override
  {
    joints_.emplace(setup, setup.parameters.Text("topic"), std::vector{setup.parameters.Text("joint")});
  }
  CCI_Sensor* Sensor() override { return this; }
  double GetTurretAngle() const override { return WrapAngle(joints_->Position(0)); }
  void Poll() override { joints_->Poll(); }
  std::vector<DriverSource> Sources() const override
  {
    std::vector<DriverSource> sources;
    joints_->AddSources(sources);
    return sources;
  }

private:
  std::optional<JointReader> joints_;
};

REGISTER_SENSOR_DRIVER(TurretEncoder,
                       DescribeDriver("footbot_turret_encoder", "ros2", "sensor_msgs/msg/JointState on joint_states",
                                      {"footbot"},
                                      {TopicParameter("topic", "joint_states", "Topic of the joint states."),
                                       TopicParameter("joint", "turret", "Name of the turret's joint.")}))

class TurretTorque : public CSensorDriver, public CCI_FootBotTurretTorqueSensor
{
public:
  void Init(const DriverSetup& setup) override
  {
    subscriber_.emplace(setup, setup.parameters.Text("topic"));
    max_force_ = setup.parameters.Number("max_force");
    max_torque_ = setup.parameters.Number("max_torque");
  }
  CCI_Sensor* Sensor() override { return this; }
  std::span<const double, 3> GetAllSensorReadings() const override { return readings_; }
  void Poll() override
  {
    if (!subscriber_->TakeLatest()) return;
    const auto& wrench = subscriber_->Latest().wrench();
    readings_ = {std::clamp(wrench.force().x() / max_force_, -1.0, 1.0),
                 std::clamp(wrench.force().y() / max_force_, -1.0, 1.0),
                 std::clamp(wrench.torque().z() / max_torque_, -1.0, 1.0)};
  }
  std::vector<DriverSource> Sources() const override { return {subscriber_->Source()}; }

private:
  std::optional<Subscriber<geometry_msgs::msg::dds_::WrenchStamped_>> subscriber_;
  double max_force_ = 0;
  double max_torque_ = 0;
  std::array<double, 3> readings_{};
};

REGISTER_SENSOR_DRIVER(
    TurretTorque,
    DescribeDriver("footbot_turret_torque", "ros2", "geometry_msgs/msg/WrenchStamped on turret/wrench", {"footbot"},
                   {TopicParameter("topic", "turret/wrench", "Topic of force and torque in the frame of the turret."),
                    NumberParameter("max_force", "N", "10", "Force that reads as 1."),
                    NumberParameter("max_torque", "N m", "1", "Torque that reads as 1.")}))

}  // namespace
}  // namespace swarmanoid::ros2

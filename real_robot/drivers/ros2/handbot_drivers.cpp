// Drivers of the head, arms, hands and rope of a handbot.
#include <algorithm>
#include <array>
#include <optional>

#include "common/control_interface/handbot/ci_handbot_arms_actuator.h"
#include "common/control_interface/handbot/ci_handbot_hands_actuator.h"
#include "common/control_interface/handbot/ci_handbot_head_actuator.h"
#include "common/control_interface/handbot/ci_handbot_joints_sensor.h"
#include "common/control_interface/handbot/ci_handbot_rope_actuator.h"
#include "real_robot/drivers/ros2/topic_driver.h"

namespace swarmanoid::ros2
{
namespace
{

// Publishes velocities of some joints, as a joint state without positions.
class JointCommand
{
public:
  JointCommand(const DriverSetup& setup, std::vector<std::string> joints)
      : publisher_(setup, setup.parameters.Text("topic")), limit_(setup.parameters.Number("max_speed"))
  {
    message_.velocity().resize(joints.size());
    message_.name(std::move(joints));
  }
  void Publish(const std::vector<double>& velocities)
  {
    message_.header(HeaderOfNow(""));
    for (std::size_t k = 0; k < velocities.size(); ++k)
      message_.velocity()[k] = std::clamp(velocities[k], -limit_, limit_);
    publisher_.Publish(message_);
  }
  std::string Name() const { return publisher_.Name(); }

private:
  Publisher<JointState> publisher_;
  double limit_;
  JointState message_;
};

std::vector<ParameterSpec> JointParameters()
{
  return {TopicParameter("topic", "joint_commands", "Topic of the angular velocities, rad/s."),
          NumberParameter("max_speed", "rad/s", "3", "Fastest angular velocity.")};
}

class Head : public TopicActuator<CCI_HandBotHeadActuator, JointCommand>
{
public:
  void Init(const DriverSetup& setup) override { output_.emplace(setup, std::vector<std::string>{"head"}); }
  void SetHeadAngularVelocity(double velocity) override { velocity_ = velocity; }
  void Push() override { output_->Publish({velocity_}); }
  void Stop() override { output_->Publish({0}); }

private:
  double velocity_ = 0;
};

REGISTER_ACTUATOR_DRIVER(Head,
                         DescribeDriver("handbot_head", "ros2", "sensor_msgs/msg/JointState (head) on joint_commands",
                                        {"handbot"}, JointParameters()))

class Arms : public TopicActuator<CCI_HandBotArmsActuator, JointCommand>
{
public:
  void Init(const DriverSetup& setup) override
  {
    output_.emplace(setup, std::vector<std::string>{"arm_left", "arm_right", "wrist_left", "wrist_right"});
  }
  void SetArmVelocities(double left, double right) override
  {
    velocities_[0] = left;
    velocities_[1] = right;
  }
  void SetWristVelocities(double left, double right) override
  {
    velocities_[2] = left;
    velocities_[3] = right;
  }
  void Push() override { output_->Publish(velocities_); }
  void Stop() override { output_->Publish({0, 0, 0, 0}); }

private:
  std::vector<double> velocities_ = std::vector<double>(4);
};

REGISTER_ACTUATOR_DRIVER(Arms, DescribeDriver("handbot_arms", "ros2",
                                              "sensor_msgs/msg/JointState (arms, wrists) on joint_commands",
                                              {"handbot"}, JointParameters()))

class Hands : public CActuatorDriver, public CCI_HandBotHandsActuator
{
public:
  void Init(const DriverSetup& setup) override
  {
    publishers_[LEFT].emplace(setup, setup.parameters.Text("left_topic"));
    publishers_[RIGHT].emplace(setup, setup.parameters.Text("right_topic"));
  }
  CCI_Actuator* Actuator() override { return this; }
  void Close(Hand hand) override { closed_[hand] = 1; }
  void Open(Hand hand) override { closed_[hand] = 0; }
  void Push() override
  {
    for (const Hand hand : {LEFT, RIGHT}) publishers_[hand]->Publish(closed_[hand]);
  }
  void Stop() override {}  // neither a held object nor a hanging robot must fall
  std::vector<std::string> Sinks() const override { return {publishers_[LEFT]->Name(), publishers_[RIGHT]->Name()}; }

private:
  std::array<std::optional<NumberPublisher>, 2> publishers_;
  std::array<double, 2> closed_{};
};

REGISTER_ACTUATOR_DRIVER(
    Hands, DescribeDriver("handbot_hands", "ros2", "std_msgs/msg/Float64 on hand_left/command and hand_right/command",
                          {"handbot"},
                          {TopicParameter("left_topic", "hand_left/command", "Topic of 0 (open) or 1 (closed)."),
                           TopicParameter("right_topic", "hand_right/command", "Topic of 0 (open) or 1 (closed).")}))

class Rope : public CActuatorDriver, public CCI_HandBotRopeActuator
{
public:
  void Init(const DriverSetup& setup) override
  {
    attach_topic_.emplace(setup, setup.parameters.Text("attach_topic"));
    winch_topic_.emplace(setup, setup.parameters.Text("winch_topic"));
  }
  CCI_Actuator* Actuator() override { return this; }
  void Launch() override { attached_ = true; }
  void Release() override { attached_ = false; }
  void SetWinchVelocity(double velocity) override
  {
    velocity_ = std::clamp(velocity, -MAX_WINCH_SPEED, MAX_WINCH_SPEED);
  }
  void Push() override
  {
    attach_topic_->Publish(attached_);
    winch_topic_->Publish(velocity_);
  }
  void Stop() override { winch_topic_->Publish(0); }  // the rope stays at its length
  std::vector<std::string> Sinks() const override { return {attach_topic_->Name(), winch_topic_->Name()}; }

private:
  std::optional<SwitchPublisher> attach_topic_;
  std::optional<NumberPublisher> winch_topic_;
  bool attached_ = false;
  double velocity_ = 0;
};

REGISTER_ACTUATOR_DRIVER(
    Rope,
    DescribeDriver("handbot_rope", "ros2", "std_msgs/msg/Bool on rope/attach, Float64 on rope/velocity", {"handbot"},
                   {TopicParameter("attach_topic", "rope/attach", "Topic of whether the rope is to hold."),
                    TopicParameter("winch_topic", "rope/velocity", "Topic of the rope let out, m/s.")}))

class Joints : public JointSensor<CCI_HandBotJointsSensor>
{
public:
  void Init(const DriverSetup& setup) override
  {
    Listen(setup, {"head", "arm_left", "arm_right", "wrist_left", "wrist_right", "hand_left", "hand_right", "rope"},
           {"hand_left/holding", "hand_right/holding", "rope/attached"});
  }
  std::span<const double, NUM_READINGS> GetAllSensorReadings() const override { return readings_; }

private:
  void Update() override
  {
    for (std::size_t k = HEAD; k <= HAND_RIGHT; ++k) readings_[k] = Position(k);
    readings_[ROPE_LENGTH] = Position(7);
    for (std::size_t k = 0; k < 3; ++k) readings_[HOLDS_LEFT + k] = IsOn(k) ? 1 : 0;
  }

  std::array<double, NUM_READINGS> readings_{};
};

REGISTER_SENSOR_DRIVER(
    Joints, DescribeDriver("handbot_joints", "ros2",
                           "sensor_msgs/msg/JointState on joint_states, std_msgs/msg/Bool on hand_left/holding, "
                           "hand_right/holding and rope/attached",
                           {"handbot"}, {TopicParameter("topic", "joint_states", "Topic of the joint states.")}))

}  // namespace
}  // namespace swarmanoid::ros2

// Head, arms, wrists and hands of the handbot. Channel "handbot_arms": angular velocities in rad/s of head, left arm,
// right arm, left wrist, right wrist. Channel "handbot_hands": 1 closes, 0 opens, left and right. The sensor reads what
// the engine reports as attributes.
#include <algorithm>

#include "common/control_interface/handbot/ci_handbot_arms_actuator.h"
#include "common/control_interface/handbot/ci_handbot_hands_actuator.h"
#include "common/control_interface/handbot/ci_handbot_head_actuator.h"
#include "common/control_interface/handbot/ci_handbot_joints_sensor.h"
#include "controller_host/devices/builtin_devices.h"
#include "controller_host/devices/device_plugins.h"
#include "controller_host/devices/value_devices.h"

namespace swarmanoid
{
namespace
{

constexpr int kArmChannelWidth = 5;

double Clamped(double velocity)
{
  constexpr double kLimit = CCI_HandBotArmsActuator::MAX_SPEED;
  return std::clamp(velocity, -kLimit, kLimit);
}

class Head : public CCI_HandBotHeadActuator
{
public:
  explicit Head(double* velocity) : velocity_(velocity) {}
  void SetHeadAngularVelocity(double velocity) override { *velocity_ = Clamped(velocity); }

  void Describe(std::vector<CCI_Reading>& readings) const override
  {
    readings.push_back({"velocity", "rad/s", *velocity_});
  }

private:
  double* velocity_;
};

class Arms : public CCI_HandBotArmsActuator
{
public:
  explicit Arms(double* velocities) : velocities_(velocities) {}
  void SetArmVelocities(double left, double right) override
  {
    velocities_[0] = Clamped(left);
    velocities_[1] = Clamped(right);
  }
  void SetWristVelocities(double left, double right) override
  {
    velocities_[2] = Clamped(left);
    velocities_[3] = Clamped(right);
  }

  void Describe(std::vector<CCI_Reading>& readings) const override
  {
    static constexpr const char* kNames[] = {"left arm", "right arm", "left wrist", "right wrist"};
    for (int i = 0; i < 4; ++i) readings.push_back({kNames[i], "rad/s", velocities_[i]});
  }

private:
  double* velocities_;
};

class Hands : public CCI_HandBotHandsActuator
{
public:
  explicit Hands(double* closed) : closed_(closed) {}
  void Close(Hand hand) override { closed_[hand] = 1; }
  void Open(Hand hand) override { closed_[hand] = 0; }

  void Describe(std::vector<CCI_Reading>& readings) const override
  {
    readings.push_back({"left closed", "yes/no", closed_[LEFT]});
    readings.push_back({"right closed", "yes/no", closed_[RIGHT]});
  }

private:
  double* closed_;
};

class Joints : public ReadingsOf<CCI_HandBotJointsSensor, CCI_HandBotJointsSensor::NUM_READINGS>
{
public:
  using ReadingsOf::ReadingsOf;
  std::string GetHeldId(CCI_HandBotHandsActuator::Hand hand) const override
  {
    const auto held = static_cast<std::uint32_t>(space->Attributes()[gripped_slot + static_cast<std::uint32_t>(hand)]);
    return held == 0 ? std::string() : space->GetEntity(held - 1).GetId();
  }

  const CSwarmanoidSpace* space = nullptr;
  std::uint32_t gripped_slot = 0;
};

class JointsSensor : public SensorsOf<AttributeSensor, Joints>
{
public:
  void Init(const DeviceSetup& setup) override
  {
    // The order of the slots is that of CCI_HandBotJointsSensor::Reading.
    Bind(setup, {"head_angle", "arm", "wrist", "hand_aperture", "gripped", "rope_attached", "rope_length"});
    joint_noise_ = NoiseFrom(setup.parameters);
    MakeDevices();
    for (std::size_t k = 0; k < devices_.size(); ++k)
    {
      devices_[k].space = &setup.space;
      devices_[k].gripped_slot = setup.space.GetEntity(robots_[k]).SlotOf("gripped");
    }
  }
  void Update(const ChannelView& channel) override
  {
    AttributeSensor::Update(channel);
    for (std::size_t k = 0; k < robots_.size(); ++k)
    {
      double* values = ValuesOf(k);
      for (const auto holds : {Joints::HOLDS_LEFT, Joints::HOLDS_RIGHT}) values[holds] = values[holds] != 0 ? 1 : 0;
      if (!joint_noise_.IsActive()) continue;
      RandomStream random = streams_.Of(k);
      for (std::size_t i = 0; i <= Joints::HAND_RIGHT; ++i) values[i] += joint_noise_.Sample(random);
    }
  }

private:
  NoiseModel joint_noise_;
};

PluginDescription Description(const char* label, const char* implementation, const char* brief)
{
  PluginDescription description;
  description.label = label;
  description.implementation = implementation;
  description.brief = brief;
  description.robots = {"handbot"};
  return description;
}

}  // namespace

void RegisterHandbotJoints()
{
  PluginDescription head = Description("handbot_head", "dummy_handbot_head", "turns the head with the two arms");
  head.channel = "handbot_arms";
  head.channel_width = kArmChannelWidth;
  head.parameters = NoiseParameters("the speed while the head is told to move", "rad/s");
  AddActuatorPlugin<ChannelCommands<Head, 1>>(head);

  PluginDescription arms = Description("handbot_arms", "dummy_handbot_arms", "moves arms and wrists at given speeds");
  arms.channel = "handbot_arms";
  arms.channel_width = kArmChannelWidth;
  arms.parameters = NoiseParameters("the speed of each joint that is told to move", "rad/s");
  AddActuatorPlugin<ChannelCommands<Arms, 4, 0, 1>>(arms);

  PluginDescription hands = Description("handbot_hands", "dummy_handbot_hands", "opens and closes the two hands");
  hands.channel = "handbot_hands";
  hands.channel_width = 2;
  hands.parameters =
      NoiseParameters("how far each hand closes, 0 to 1, while it is told to close; it holds above 0.5", "");
  AddActuatorPlugin<ChannelCommands<Hands, 2, 1>>(hands);

  PluginDescription joints = Description("handbot_joints", "generic_handbot_joints",
                                         "angles of head, arms, wrists and hands, what the hands hold, the rope");
  joints.parameters = NoiseParameters("each angle", "rad");
  AddSensorPlugin<JointsSensor>(joints);
}

}  // namespace swarmanoid

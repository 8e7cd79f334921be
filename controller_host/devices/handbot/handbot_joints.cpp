// Head, arms, wrists and hands of the handbot. The channel "handbot_arms" has angular velocities in rad/s: head, left
// arm, right arm, left wrist, right wrist. The channel "handbot_hands" has 1 for closing and 0 for opening, left and
// right. The sensor reads the attributes that the engine reports.
#include <algorithm>

#include "common/control_interface/handbot/ci_handbot_arms_actuator.h"
#include "common/control_interface/handbot/ci_handbot_hands_actuator.h"
#include "common/control_interface/handbot/ci_handbot_head_actuator.h"
#include "common/control_interface/handbot/ci_handbot_joints_sensor.h"
#include "common/space/space.h"
#include "controller_host/devices/device_plugins.h"
#include "controller_host/devices/value_devices.h"

namespace swarmanoid
{
namespace
{

double Clamped(double velocity)
{
  constexpr double kLimit = CCI_HandBotArmsActuator::MAX_SPEED;
  return std::clamp(velocity, -kLimit, kLimit);
}

class Head : public CommandsOf<CCI_HandBotHeadActuator>
{
public:
  using CommandsOf::CommandsOf;
  void SetHeadAngularVelocity(double velocity) override { *values_ = Clamped(velocity); }
};

class Arms : public CommandsOf<CCI_HandBotArmsActuator>
{
public:
  using CommandsOf::CommandsOf;
  void SetArmVelocities(double left, double right) override
  {
    values_[0] = Clamped(left);
    values_[1] = Clamped(right);
  }
  void SetWristVelocities(double left, double right) override
  {
    values_[2] = Clamped(left);
    values_[3] = Clamped(right);
  }
};

class Hands : public CommandsOf<CCI_HandBotHandsActuator>
{
public:
  using CommandsOf::CommandsOf;
  void Close(Hand hand) override { values_[hand] = 1; }
  void Open(Hand hand) override { values_[hand] = 0; }
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

}  // namespace

const DeviceCode kHandbotJointsCode(
    []
    {
      BindActuator<ChannelCommands<Head, 1>>("handbot_head", "dummy_handbot_head");
      BindActuator<ChannelCommands<Arms, 4, 0, 1>>("handbot_arms", "dummy_handbot_arms");
      BindActuator<ChannelCommands<Hands, 2, 1>>("handbot_hands", "dummy_handbot_hands");
      BindSensor<JointsSensor>("handbot_joints", "generic_handbot_joints");
    });

}  // namespace swarmanoid

// Propulsion of eyebots and of other robots with propellers: velocities to the engine on channel "eyebot_propellers":
// forward, left, up in m/s, yaw rate in rad/s. The position-controlled implementation closes its loop on the robot's
// own pose.
#include <algorithm>
#include <optional>

#include "common/control_interface/ci_robot.h"
#include "common/control_interface/eyebot/ci_eyebot_propellers_actuator.h"
#include "common/math/elementary.h"
#include "common/space/space.h"
#include "controller_host/devices/device_plugins.h"
#include "controller_host/devices/value_devices.h"

namespace swarmanoid
{
namespace
{

constexpr std::size_t kAxes = 4;

double Clamped(double value, double limit) { return std::clamp(value, -limit, limit); }

struct Limits
{
  double speed = 0;     // m/s
  double yaw_rate = 0;  // rad/s
};

// Returns the limits that the experiment gives, or those of the robot's kind.
Limits LimitsOf(const DeviceSetup& setup, std::uint32_t robot)
{
  const Propellers& row = *DescriptionOf(setup.space.GetEntity(robot).GetKind()).propellers;
  const auto given = [&](const char* name, double of_row)
  { return setup.parameters.IsGiven(name) ? setup.parameters.Number(name) : of_row; };
  return {given("max_speed", row.max_speed_m_s), given("max_yaw_rate", row.max_yaw_rate_rad_s)};
}

void PutVelocity(double* values, const Limits& limits, double forward, double left, double up, double yaw_rate)
{
  values[0] = Clamped(forward, limits.speed);
  values[1] = Clamped(left, limits.speed);
  values[2] = Clamped(up, limits.speed);
  values[3] = Clamped(yaw_rate, limits.yaw_rate);
}

class VelocityPropellers : public CommandsOf<CCI_EyeBotPropellersActuator>
{
public:
  using CommandsOf::CommandsOf;
  void SetVelocity(double forward, double left, double up, double yaw_rate) override
  {
    PutVelocity(values_, limits, forward, left, up, yaw_rate);
  }
  void SetPosition(const Vector3&, double) override
  {
    throw CCI_DeviceError(
        "dummy_eyebot_propellers take velocities only; for SetPosition choose <implementation> "
        "position_eyebot_propellers");
  }
  Limits limits;
};

class VelocityActuator : public ChannelCommands<VelocityPropellers, kAxes>
{
public:
  void Init(const DeviceSetup& setup) override
  {
    ChannelCommands::Init(setup);
    for (std::size_t k = 0; k < devices_.size(); ++k) devices_[k].limits = LimitsOf(setup, setup.robots[k]);
  }
};

// A target, kept beside the velocity: by position if `has_target` is not 0.
struct Flight
{
  double velocity[kAxes];
  double has_target;
  double x, y, z, yaw;
};
constexpr std::size_t kFlightWidth = sizeof(Flight) / sizeof(double);

class PositionPropellers : public CommandsOf<CCI_EyeBotPropellersActuator>
{
public:
  using CommandsOf::CommandsOf;
  void SetVelocity(double forward, double left, double up, double yaw_rate) override
  {
    PutVelocity(values_, limits, forward, left, up, yaw_rate);
    values_[kAxes] = 0;
  }
  void SetPosition(const Vector3& position, double yaw) override
  {
    values_[kAxes] = 1;
    for (int axis = 0; axis < 3; ++axis) values_[kAxes + 1 + static_cast<std::size_t>(axis)] = position[axis];
    values_[kAxes + 4] = yaw;
  }
  std::optional<Target> GetTarget() const override
  {
    if (values_[kAxes] == 0) return std::nullopt;
    const double* target = values_ + kAxes + 1;
    return Target{target[0], target[1], target[2], target[3]};
  }
  Limits limits;

protected:
  // The numbers are laid out as Flight.
  void ReadSettings(std::vector<double>& values) const override
  {
    if (values_[kAxes] == 0) CommandsOf::ReadSettings(values);
  }
};

// The law is v = gain * (target - position), turned into the frame of the robot and clamped. The yaw rate has the same
// law.
class PositionActuator : public ActuatorsOf<ValueActuator, PositionPropellers>
{
public:
  void Init(const DeviceSetup& setup) override
  {
    Reset(setup, kFlightWidth);
    gain_ = setup.parameters.Number("gain");
    noise_ = NoiseFrom(setup.parameters);
    MakeDevices();
    for (std::size_t k = 0; k < devices_.size(); ++k) devices_[k].limits = LimitsOf(setup, setup.robots[k]);
  }
  void Commit(const ChannelView& channel, AttributeChanges&) override
  {
    for (std::size_t k = 0; k < robots_.size(); ++k)
    {
      double* velocity = &channel.values[channel.offsets[k]];
      if (ValuesOf(k)[kAxes] != 0)
        Approach(k, velocity);
      else
        std::copy_n(ValuesOf(k), kAxes, velocity);
      if (!noise_.IsActive()) continue;
      RandomStream random = streams_.Of(k);
      for (std::size_t axis = 0; axis < kAxes; ++axis)
      {
        const double noise = noise_.Sample(random);
        if (velocity[axis] != 0) velocity[axis] += noise;
      }
    }
  }

private:
  void Approach(std::size_t k, double* velocity)
  {
    const double* target = ValuesOf(k) + kAxes + 1;
    const Pose pose = space_->GetPose(robots_[k]);
    const double yaw = YawOf(pose.orientation);
    const SinCos heading = SinCosOf(yaw);
    const double dx = target[0] - pose.position.x();
    const double dy = target[1] - pose.position.y();
    PutVelocity(velocity, devices_[k].limits, gain_ * (heading.cos * dx + heading.sin * dy),
                gain_ * (heading.cos * dy - heading.sin * dx), gain_ * (target[2] - pose.position.z()),
                gain_ * WrapAngle(target[3] - yaw));
  }

  double gain_ = 0;
  NoiseModel noise_;
};

}  // namespace

const DeviceCode kEyebotPropellersCode(
    []
    {
      BindActuator<VelocityActuator>("eyebot_propellers", "dummy_eyebot_propellers");
      BindActuator<PositionActuator>("eyebot_propellers", "position_eyebot_propellers");
    });

}  // namespace swarmanoid

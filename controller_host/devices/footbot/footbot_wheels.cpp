#include "controller_host/devices/footbot/footbot_wheels.h"

#include <algorithm>

#include "common/math/elementary.h"
#include "controller_host/devices/builtin_devices.h"
#include "controller_host/devices/device_plugins.h"

namespace swarmanoid
{
namespace
{

constexpr double kRadius = CCI_FootBotWheelsActuator::WHEEL_RADIUS_M;

}  // namespace

std::vector<ParameterSpec> DummyFootbotWheels::ParameterTable()
{
  return Joined({{.name = "max_speed",
                  .unit = "m/s",
                  .default_value = "0.3",
                  .description = "Speed of a wheel on the ground to which commands are clamped; 0.3 on the robot.",
                  .minimum = 0}},
                NoiseParameters("the speed of each wheel while it moves", "m/s"));
}

void DummyFootbotWheels::Init(const DeviceSetup& setup)
{
  limit_ = setup.parameters.Number("max_speed") / kRadius;
  wheels_.resize(setup.robots.size());
  streams_ = DeviceStreams(setup);
  noise_ = NoiseFrom(setup.parameters);
}

double DummyFootbotWheels::Clamped(double velocity) const
{
  // A NaN stays one: the host says whose it is.
  return std::clamp(velocity, -limit_, limit_);
}

void DummyFootbotWheels::Commit(const ChannelView& channel, AttributeChanges&)
{
  for (std::size_t k = 0; k < wheels_.size(); ++k)
  {
    double* values = &channel.values[channel.offsets[k]];
    values[0] = Clamped(wheels_[k].wanted[0]);
    values[1] = Clamped(wheels_[k].wanted[1]);
  }
  AddNoise(channel);
}

void DummyFootbotWheels::AddNoise(const ChannelView& channel) const
{
  if (!noise_.IsActive()) return;
  for (std::size_t k = 0; k < wheels_.size(); ++k)
  {
    RandomStream random = streams_.Of(k);
    double* values = &channel.values[channel.offsets[k]];
    for (std::size_t side = 0; side < 2; ++side)
    {
      const double noise = noise_.Sample(random) / kRadius;
      if (values[side] != 0) values[side] += noise;
    }
  }
}

void DummyFootbotWheels::SaveState(ByteWriter& state) const
{
  for (const SimulatedFootbotWheels& wheels : wheels_) state.Put(wheels.wanted);
}

void DummyFootbotWheels::LoadState(ByteReader& state)
{
  for (SimulatedFootbotWheels& wheels : wheels_) wheels.wanted = state.Get<std::array<double, 2>>();
}

std::vector<ParameterSpec> NoisyFootbotWheels::ParameterTable()
{
  return Joined(
      DummyFootbotWheels::ParameterTable(),
      {{.name = "bias_left",
        .unit = "m/s",
        .default_value = "0",
        .description = "Added to the speed of the left wheel while it moves."},
       {.name = "bias_right",
        .unit = "m/s",
        .default_value = "0",
        .description = "Added to the speed of the right wheel while it moves."},
       {.name = "factor_left", .default_value = "1", .description = "Multiplies the speed of the left wheel."},
       {.name = "factor_right", .default_value = "1", .description = "Multiplies the speed of the right wheel."}});
}

void NoisyFootbotWheels::Init(const DeviceSetup& setup)
{
  DummyFootbotWheels::Init(setup);
  bias_ = {setup.parameters.Number("bias_left") / kRadius, setup.parameters.Number("bias_right") / kRadius};
  factor_ = {setup.parameters.Number("factor_left"), setup.parameters.Number("factor_right")};
}

void NoisyFootbotWheels::Commit(const ChannelView& channel, AttributeChanges&)
{
  for (std::size_t k = 0; k < wheels_.size(); ++k)
  {
    double* values = &channel.values[channel.offsets[k]];
    for (std::size_t side = 0; side < 2; ++side)
    {
      const double wanted = Clamped(wheels_[k].wanted[side]);
      values[side] = wanted == 0 ? 0 : bias_[side] + factor_[side] * wanted;
    }
  }
  AddNoise(channel);
}

std::vector<ParameterSpec> PidFootbotWheels::ParameterTable()
{
  return Joined(DummyFootbotWheels::ParameterTable(),
                {{.name = "time_constant",
                  .unit = "s",
                  .default_value = "0.1",
                  .description = "Time in which 63 % of a step in the commanded speed is reached; 0 follows at once.",
                  .minimum = 0},
                 {.name = "max_acceleration",
                  .unit = "m/s^2",
                  .default_value = "0",
                  .description = "Largest change of a wheel's speed on the ground; 0 sets no limit.",
                  .minimum = 0}});
}

void PidFootbotWheels::Init(const DeviceSetup& setup)
{
  DummyFootbotWheels::Init(setup);
  const double tick_s = setup.space.GetTickSeconds();
  const double time_constant_s = setup.parameters.Number("time_constant");
  gain_ = time_constant_s > 0 ? 1 - Exp(-tick_s / time_constant_s) : 1;
  largest_step_ = setup.parameters.Number("max_acceleration") * tick_s / kRadius;
  velocity_.assign(setup.robots.size(), {});
}

void PidFootbotWheels::Commit(const ChannelView& channel, AttributeChanges&)
{
  for (std::size_t k = 0; k < wheels_.size(); ++k)
  {
    double* values = &channel.values[channel.offsets[k]];
    for (std::size_t side = 0; side < 2; ++side)
    {
      double step = gain_ * (Clamped(wheels_[k].wanted[side]) - velocity_[k][side]);
      if (largest_step_ > 0) step = std::clamp(step, -largest_step_, largest_step_);
      values[side] = velocity_[k][side] += step;
    }
  }
  AddNoise(channel);
}

void PidFootbotWheels::SaveState(ByteWriter& state) const
{
  DummyFootbotWheels::SaveState(state);
  state.PutArray(velocity_);
}

void PidFootbotWheels::LoadState(ByteReader& state)
{
  DummyFootbotWheels::LoadState(state);
  const auto velocity = state.GetArray<std::array<double, 2>>();
  if (velocity.size() != velocity_.size()) throw std::runtime_error("saved state: a device has other robots");
  velocity_ = velocity;
}

void RegisterFootbotWheels()
{
  PluginDescription description;
  description.label = "footbot_wheels";
  description.robots = {"footbot"};
  description.channel = "footbot_wheels";
  description.channel_width = 2;

  description.implementation = "dummy_footbot_wheels";
  description.brief = "wheels that turn at the commanded speed at once, up to max_speed";
  description.parameters = DummyFootbotWheels::ParameterTable();
  AddActuatorPlugin<DummyFootbotWheels>(description);

  description.implementation = "noisy_footbot_wheels";
  description.brief = "wheels with a bias and a factor on their speed while they move";
  description.parameters = NoisyFootbotWheels::ParameterTable();
  AddActuatorPlugin<NoisyFootbotWheels>(description);

  description.implementation = "pid_footbot_wheels";
  description.brief = "wheels that approach the commanded speed with the lag of a speed controller";
  description.parameters = PidFootbotWheels::ParameterTable();
  AddActuatorPlugin<PidFootbotWheels>(description);
}

}  // namespace swarmanoid

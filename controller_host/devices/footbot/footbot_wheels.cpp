// Wheel commands are in m/s in the interface and in rad/s on the engines' channel. The limit is applied before noise
// and bias, since the error of a motor does not know the limit. A wheel that stands gets no noise, so robots that are
// told to stand do not creep; in `argos3_footbot_wheels` factor and bias disturb both wheels while at least one of them
// turns, as in ARGoS3. Biases that are drawn once come from a stream without a tick, so they are the same after a
// checkpoint.
#include "controller_host/devices/footbot/footbot_wheels.h"

#include <algorithm>
#include <limits>
#include <string>

#include "common/math/elementary.h"
#include "common/space/space.h"
#include "controller_host/devices/device_plugins.h"

namespace swarmanoid
{
namespace
{

constexpr double kRadius = CCI_FootBotWheelsActuator::WHEEL_RADIUS_M;

}  // namespace

void DummyFootbotWheels::Init(const DeviceSetup& setup)
{
  limit_ = setup.parameters.Number("max_speed") / kRadius;
  wheels_.resize(setup.robots.size());
  streams_ = DeviceStreams(setup);
  noise_ = NoiseFrom(setup.parameters);
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

void DummyFootbotWheels::SaveState(std::size_t k, ByteWriter& state) const { state.Put(wheels_[k].wanted); }

void DummyFootbotWheels::LoadState(std::size_t k, ByteReader& state)
{
  wheels_[k].wanted = state.Get<std::array<double, 2>>();
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

void Argos3FootbotWheels::Init(const DeviceSetup& setup)
{
  DummyFootbotWheels::Init(setup);
  if (limit_ == 0) limit_ = std::numeric_limits<double>::infinity();
  factor_streams_ = DeviceStreams(setup, "factor");
  const DeviceStreams bias_streams(setup, "bias");
  constexpr const char* kSides[] = {"_left", "_right"};
  bias_.resize(wheels_.size());
  for (std::size_t side = 0; side < 2; ++side)
  {
    const auto number = [&](const std::string& name) { return setup.parameters.Number(name + kSides[side]); };
    factor_mean_[side] = number("factor_avg");
    factor_deviation_[side] = number("factor_stddev");
    for (std::size_t k = 0; k < wheels_.size(); ++k)
      bias_[k][side] = bias_streams.Once(k, side).Gaussian(number("bias_avg"), number("bias_stddev")) / kRadius;
  }
}

void Argos3FootbotWheels::Commit(const ChannelView& channel, AttributeChanges&)
{
  const bool factor_varies = factor_deviation_[0] != 0 || factor_deviation_[1] != 0;
  for (std::size_t k = 0; k < wheels_.size(); ++k)
  {
    double* values = &channel.values[channel.offsets[k]];
    for (std::size_t side = 0; side < 2; ++side) values[side] = Clamped(wheels_[k].wanted[side]);
    if (values[0] == 0 && values[1] == 0) continue;
    std::array<double, 2> factor = factor_mean_;
    if (factor_varies)
    {
      RandomStream random = factor_streams_.Of(k);
      for (std::size_t side = 0; side < 2; ++side)
        factor[side] = random.Gaussian(factor_mean_[side], factor_deviation_[side]);
    }
    for (std::size_t side = 0; side < 2; ++side) values[side] = factor[side] * (values[side] + bias_[k][side]);
  }
  AddNoise(channel);
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

void PidFootbotWheels::SaveState(std::size_t k, ByteWriter& state) const
{
  DummyFootbotWheels::SaveState(k, state);
  state.Put(velocity_[k]);
}

void PidFootbotWheels::LoadState(std::size_t k, ByteReader& state)
{
  DummyFootbotWheels::LoadState(k, state);
  velocity_[k] = state.Get<std::array<double, 2>>();
}

const DeviceCode kFootbotWheelsCode(
    []
    {
      BindActuator<DummyFootbotWheels>("footbot_wheels", "dummy_footbot_wheels");
      BindActuator<NoisyFootbotWheels>("footbot_wheels", "noisy_footbot_wheels");
      BindActuator<Argos3FootbotWheels>("footbot_wheels", "argos3_footbot_wheels");
      BindActuator<PidFootbotWheels>("footbot_wheels", "pid_footbot_wheels");
    });

}  // namespace swarmanoid

// The wheels of footbots: immediate, with systematic errors, and with the lag of a speed controller; all with noise.
// Specific: the engine drives the body from the channel "footbot_wheels", [left, right] wheel angular velocity in
// rad/s.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "common/control_interface/footbot/ci_footbot_wheels_actuator.h"
#include "controller_host/device.h"
#include "controller_host/devices/device_streams.h"
#include "controller_host/devices/noise.h"

namespace swarmanoid
{

// The controller's object: it keeps the speeds that were set.
class SimulatedFootbotWheels : public CCI_FootBotWheelsActuator
{
public:
  void SetFootBotWheelsAngularVelocity(double left, double right) override { wanted = {left, right}; }

  std::array<double, NUM_WHEELS> wanted{};  // rad/s

protected:
  void ReadSettings(std::vector<double>& values) const override
  {
    values.insert(values.end(), wanted.begin(), wanted.end());
  }
};

// The speed asked for, clamped to the fastest one. The base of the others.
class DummyFootbotWheels : public ActuatorBatch
{
public:
  void Init(const DeviceSetup& setup) override;
  SimulatedFootbotWheels* Actuator(std::size_t k) override { return &wheels_[k]; }
  void Commit(const ChannelView& channel, AttributeChanges& changes) override;
  void Expose(std::size_t k, ExposedValues& values) override { values.Add(wheels_[k].wanted); }
  void SaveState(std::size_t k, ByteWriter& state) const override;
  void LoadState(std::size_t k, ByteReader& state) override;

protected:
  double Clamped(double velocity) const
  {
    // NaN passes through, since the host reports it with the robot's name.
    return std::clamp(velocity, -limit_, limit_);
  }
  // Adds noise to each wheel that moves.
  void AddNoise(const ChannelView& channel) const;

  double limit_ = 0;  // rad/s
  std::vector<SimulatedFootbotWheels> wheels_;

private:
  DeviceStreams streams_;
  NoiseModel noise_;  // m/s on the ground
};

// v' = bias + factor * v + noise for each wheel, only while the wheel has a command other than 0. Bias and factor never
// change, which is our assumption.
class NoisyFootbotWheels : public DummyFootbotWheels
{
public:
  void Init(const DeviceSetup& setup) override;
  void Commit(const ChannelView& channel, AttributeChanges& changes) override;

private:
  std::array<double, 2> bias_{};  // rad/s
  std::array<double, 2> factor_{};
};

// v' = factor * (v + bias) for both wheels while one of them has a command other than 0. The bias of each wheel is
// drawn once and its factor in every tick, both Gaussian (differential_steering_default_actuator.cpp of ARGoS3).
class Argos3FootbotWheels : public DummyFootbotWheels
{
public:
  void Init(const DeviceSetup& setup) override;
  void Commit(const ChannelView& channel, AttributeChanges& changes) override;

private:
  std::array<double, 2> factor_mean_{}, factor_deviation_{};
  std::vector<std::array<double, 2>> bias_;  // rad/s
  DeviceStreams factor_streams_;
};

// A first-order response: the speed approaches the wanted one with a time constant, within a largest acceleration.
class PidFootbotWheels : public DummyFootbotWheels
{
public:
  void Init(const DeviceSetup& setup) override;
  void Commit(const ChannelView& channel, AttributeChanges& changes) override;
  void SaveState(std::size_t k, ByteWriter& state) const override;
  void LoadState(std::size_t k, ByteReader& state) override;

private:
  double gain_ = 1;          // share of the difference made up in one tick
  double largest_step_ = 0;  // rad/s in one tick
  std::vector<std::array<double, 2>> velocity_;
};

}  // namespace swarmanoid

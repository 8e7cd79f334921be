// The plain devices: a few numbers for each robot, carried to or from the engine (channels) or the space (attributes).
// What a controller holds is a thin object on the numbers of its robot.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "controller_host/device.h"
#include "controller_host/devices/device_streams.h"
#include "controller_host/devices/noise.h"
#include "controller_host/on_demand_sensor.h"

namespace swarmanoid
{

// The same count of numbers for each robot.
class DeviceValues
{
protected:
  void Reset(const DeviceSetup& setup, std::size_t width);
  double* ValuesOf(std::size_t k) { return &values_[k * width_]; }

  const CSwarmanoidSpace* space_ = nullptr;
  std::vector<std::uint32_t> robots_;
  DeviceStreams streams_;
  std::size_t width_ = 0;
  std::vector<double> values_;  // robot after robot
};

// Numbers that controllers set. They stay until set again, and are saved and restored.
class ValueActuator : public ActuatorBatch, protected DeviceValues
{
public:
  void Expose(std::size_t k, ExposedValues& values) override { values.Add({ValuesOf(k), width_}); }
  void SaveState(std::size_t k, ByteWriter& state) const override;
  void LoadState(std::size_t k, ByteReader& state) override;

protected:
  std::size_t Robots() const { return robots_.size(); }
};

// Sends its numbers to the engine: the first one to place first_ of the channel, the others to the places after it.
// Noise is added to numbers that are not 0, and the sum is limited to least_ … most_.
class ChannelActuator : public ValueActuator
{
public:
  void Commit(const ChannelView& channel, AttributeChanges& changes) override;

protected:
  std::size_t first_ = 0;
  NoiseModel noise_;
  double least_ = -std::numeric_limits<double>::infinity();
  double most_ = std::numeric_limits<double>::infinity();
};

// Writes its numbers into attributes of its robots, if they differ from those in the space. Noise is for attributes
// that are colours. It is added to red, green and blue of lit ones, and equal for all LEDs of a robot with one colour.
class AttributeActuator : public ValueActuator
{
public:
  void Commit(const ChannelView& channel, AttributeChanges& changes) override;

protected:
  // Binds the attributes in the order of their slots, each with all its elements. The numbers start with the values of
  // the space.
  void Bind(const DeviceSetup& setup, const std::vector<std::string>& attributes);

  NoiseModel colour_noise_;

private:
  void CommitWithNoise(AttributeChanges& changes) const;
  std::uint32_t Disturbed(std::uint32_t colour, RandomStream random) const;

  std::vector<std::uint32_t> slots_;  // robot after robot
};

// Numbers that controllers read.
class ValueSensor : public SensorBatch, protected DeviceValues
{
public:
  void Expose(std::size_t k, ExposedValues& values) override { values.Add({ValuesOf(k), width_}); }

protected:
  void AddNoise();
  void AddNoise(std::size_t k);
  void AddNoise(std::span<const std::uint32_t> ks);

  NoiseModel noise_;

private:
  std::vector<std::uint32_t> all_;  // 0, 1 …; if there is noise
  std::vector<double> samples_;
};

// Reads the channel of the engine and adds noise.
class ChannelSensor : public ValueSensor
{
public:
  void Update(const ChannelView& channel) override;
};

// A sensor that reads attributes of its robots from the space and adds noise.
class AttributeSensor : public ValueSensor
{
public:
  void Update(const ChannelView& channel) override;

protected:
  void Bind(const DeviceSetup& setup, const std::vector<std::string>& attributes);

private:
  std::vector<std::uint32_t> slots_;
};

// The controller's object for a sensor whose interface is one group of COUNT numbers.
template <class Interface, std::size_t COUNT>
class ReadingsOf : public Interface
{
public:
  explicit ReadingsOf(const double* values) : values_(values) {}
  std::span<const double, COUNT> GetAllSensorReadings() const override
  {
    return std::span<const double, COUNT>(values_, COUNT);
  }

protected:
  const double* values_;
};

// The same where they are made on demand.
template <class Interface, std::size_t COUNT>
class ReadingsOnDemand : public ReadingsOf<Interface, COUNT>
{
public:
  ReadingsOnDemand(const double* values, OnDemandSensor& batch, std::size_t k)
      : ReadingsOf<Interface, COUNT>(values), batch_(batch), k_(k)
  {
  }
  std::span<const double, COUNT> GetAllSensorReadings() const override
  {
    batch_.Want(k_);
    return ReadingsOf<Interface, COUNT>::GetAllSensorReadings();
  }

private:
  OnDemandSensor& batch_;
  std::size_t k_;
};

// The controller's object for an actuator whose columns are its numbers, in the same order.
template <class Interface>
class CommandsOf : public Interface
{
public:
  explicit CommandsOf(double* values) : values_(values) {}

protected:
  void ReadSettings(std::vector<double>& values) const override
  {
    values.insert(values.end(), values_, values_ + this->Columns().size());
  }

  double* values_;
};

// A batch of actuators or sensors that has one object of a class for each robot, made from the robot's numbers.
template <class Base, class Device>
class DevicesOf : public Base
{
protected:
  void MakeDevices()
  {
    devices_.clear();
    devices_.reserve(this->robots_.size());
    for (std::size_t k = 0; k < this->robots_.size(); ++k) devices_.emplace_back(this->ValuesOf(k));
  }
  std::vector<Device> devices_;
};

template <class Base, class Device>
class ActuatorsOf : public DevicesOf<Base, Device>
{
public:
  Device* Actuator(std::size_t k) override { return &this->devices_[k]; }
};

template <class Base, class Device>
class SensorsOf : public DevicesOf<Base, Device>
{
public:
  Device* Sensor(std::size_t k) override { return &this->devices_[k]; }
};

// A specific actuator that sends the COUNT numbers that were set, from place FIRST of the channel on. Noise is added,
// and the result is limited to 0 to MOST (0: no limit).
template <class Device, std::size_t COUNT, int MOST = 0, std::size_t FIRST = 0>
class ChannelCommands : public ActuatorsOf<ChannelActuator, Device>
{
public:
  void Init(const DeviceSetup& setup) override
  {
    this->Reset(setup, COUNT);
    this->first_ = FIRST;
    this->noise_ = NoiseFrom(setup.parameters);
    if constexpr (MOST != 0)
    {
      this->least_ = 0;
      this->most_ = MOST;
    }
    this->MakeDevices();
  }
};

// A specific sensor that hands on the COUNT numbers of its channel.
template <class Interface, std::size_t COUNT>
class ChannelReadings : public SensorsOf<ChannelSensor, ReadingsOf<Interface, COUNT>>
{
public:
  void Init(const DeviceSetup& setup) override
  {
    this->Reset(setup, COUNT);
    this->noise_ = NoiseFrom(setup.parameters);
    this->MakeDevices();
  }
};

}  // namespace swarmanoid

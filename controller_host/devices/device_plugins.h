// Small parts that the simulated devices share: registration, random numbers, noise.
#pragma once

#include <concepts>
#include <memory>
#include <string>
#include <type_traits>

#include "controller_host/device.h"
#include "controller_host/devices/device_streams.h"
#include "controller_host/devices/noise.h"
#include "controller_host/devices/value_devices.h"

namespace swarmanoid
{

// The code of the devices of one file of this folder. `bind` calls BindSensor and BindActuator; RegisterBuiltinDevices
// calls it when the devices are described.
class DeviceCode
{
public:
  explicit DeviceCode(void (*bind)());
};

// A device that asks for nothing but its own robots.
template <class Batch>
class OfOwnRobots : public Batch
{
public:
  double Reach() const override { return 0; }
};

// Bind the code of sensors and actuators that common/plugin_descriptions describes. All these actuators ask only for
// their own robots, and so do sensors that pass on values of engines or attributes. Devices that users derive from the
// same bases state their own reach.
template <class Batch>
void BindSensor(const std::string& label, const std::string& implementation)
{
  constexpr bool kOfOwnRobots = std::derived_from<Batch, ChannelSensor> || std::derived_from<Batch, AttributeSensor>;
  using Made = std::conditional_t<kOfOwnRobots, OfOwnRobots<Batch>, Batch>;
  PluginRegistry<SensorBatch>::Instance().Bind(label, implementation, [] { return std::make_unique<Made>(); });
  SetColumns(PluginKind::kSensor, label, ColumnsOf<Batch>());
}

template <class Batch>
void BindActuator(const std::string& label, const std::string& implementation)
{
  PluginRegistry<ActuatorBatch>::Instance().Bind(label, implementation,
                                                 [] { return std::make_unique<OfOwnRobots<Batch>>(); });
  SetColumns(PluginKind::kActuator, label, ColumnsOf<Batch>());
}

}  // namespace swarmanoid

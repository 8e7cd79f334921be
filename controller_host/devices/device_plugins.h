// Small parts that the simulated devices share: registration, random numbers, noise.
#pragma once

#include <memory>
#include <string>

#include "controller_host/device.h"
#include "controller_host/devices/device_streams.h"
#include "controller_host/devices/noise.h"

namespace swarmanoid
{

// Sensors and actuators that common/builtins describes.
template <class Batch>
void BindSensor(const std::string& label, const std::string& implementation)
{
  PluginRegistry<SensorBatch>::Instance().Bind(label, implementation, [] { return std::make_unique<Batch>(); });
}

template <class Batch>
void BindActuator(const std::string& label, const std::string& implementation)
{
  PluginRegistry<ActuatorBatch>::Instance().Bind(label, implementation, [] { return std::make_unique<Batch>(); });
}

}  // namespace swarmanoid

// Small parts that the simulated devices share: registration, and the objects that controllers hold.
#pragma once

#include <memory>
#include <utility>

#include "controller_host/device.h"
#include "controller_host/devices/device_streams.h"
#include "controller_host/devices/noise.h"

namespace swarmanoid
{

template <class Batch>
void AddSensorPlugin(PluginDescription description)
{
  CheckNoiseOf(PluginKind::kSensor, description);
  PluginRegistry<SensorBatch>::Instance().Add(std::move(description), [] { return std::make_unique<Batch>(); });
}

template <class Batch>
void AddActuatorPlugin(PluginDescription description)
{
  CheckNoiseOf(PluginKind::kActuator, description);
  PluginRegistry<ActuatorBatch>::Instance().Add(std::move(description), [] { return std::make_unique<Batch>(); });
}

}  // namespace swarmanoid

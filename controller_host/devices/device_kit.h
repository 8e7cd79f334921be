// Small parts that the simulated devices share: registration, and the objects that controllers hold.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "common/math/random.h"
#include "controller_host/device.h"
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

// The random numbers of one device of one robot at the tick of the space.
inline RandomStream StreamOf(const CSwarmanoidSpace& space, std::uint32_t robot, std::uint32_t device)
{
  return {space.GetExperiment().seed, robot, device, static_cast<std::uint32_t>(space.GetTick())};
}

}  // namespace swarmanoid

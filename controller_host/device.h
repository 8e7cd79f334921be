// Simulated sensors and actuators. One object serves all robots of a host that run one controller configuration: it
// computes them in one batch over flat arrays and hands each robot the small CCI_ object that its controller holds.
//
// A generic device needs the space alone. A specific one exchanges a channel of values with the engine of its robots.
#pragma once

#include <limits>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

#include "common/configuration/parameter.h"
#include "common/control_interface/ci_device.h"
#include "common/math/random.h"
#include "common/messages/tick_messages.h"
#include "common/plugins/registry.h"
#include "common/serialisation/bytes.h"
#include "controller_host/exposed_values.h"

#ifndef SWARMANOID_OWN_SOURCES
// Plug-ins mostly need these.
#include <common/space/space.h>
#include <controller_host/devices/noise.h>
#endif

namespace swarmanoid
{

class CSwarmanoidSpace;

// These functions return the name of a device type for random numbers. A sensor and an actuator of one type have
// different names.
inline std::uint64_t SensorStream(const std::string& type) { return StreamName("sensor " + type); }
inline std::uint64_t ActuatorStream(const std::string& type) { return StreamName("actuator " + type); }

// The arguments for making a batch. The references outlive the batch.
struct DeviceSetup
{
  Parameters parameters;              // of the device's element
  const CSwarmanoidSpace& space;      // this process's replica
  std::vector<std::uint32_t> robots;  // entity indices, ascending: robot k of the batch is entity robots[k]
  std::uint64_t stream = 0;           // the device's name for random numbers: SensorStream or ActuatorStream(type)
};

// The channel values of the robots of a batch, `width` doubles each; robot k stands at values[offsets[k]].
struct ChannelView
{
  std::span<double> values;
  std::span<const std::size_t> offsets;
  int width = 0;
};

// The reach of devices that ask for the whole space.
inline constexpr double kReachesEverywhere = std::numeric_limits<double>::infinity();

class SensorBatch
{
public:
  virtual ~SensorBatch() = default;
  // Makes one device for each robot of the setup. Throws ConfigurationError for a user's mistake.
  virtual void Init(const DeviceSetup& setup) = 0;
  // Returns the object given to the controller of robot k; it lives as long as the batch.
  virtual CCI_Sensor* Sensor(std::size_t k) = 0;
  // Computes the readings of all robots from the space at its tick. `channel` has the values that engines sent, for
  // specific sensors. An exception ends the run and names the device.
  virtual void Update(const ChannelView& channel) = 0;
  // Returns the distance (m, in the plane, from the origin of a robot) up to which bodies or sources can change its
  // readings. Called after Init. Anything farther away may be missing from the space of the host (docs/scaling.md).
  virtual double Reach() const { return kReachesEverywhere; }
  // Adds the readings of robot k, in memory that faults change after Update. A device that does not override it cannot
  // have faults.
  virtual void Expose(std::size_t, ExposedValues&) {}
  // Saves the state that the device of robot k keeps between ticks. Devices without state need not override it.
  virtual void SaveState(std::size_t, ByteWriter&) const {}
  // Restores the state of robot k from SaveState. Throws std::runtime_error if the data is too short.
  virtual void LoadState(std::size_t, ByteReader&) {}
  // Saves state that follows from the space alone, so that it is equal for all robots in all hosts.
  virtual void SaveCommon(ByteWriter&) const {}
  // Restores the state from SaveCommon.
  virtual void LoadCommon(ByteReader&) {}
};

class ActuatorBatch
{
public:
  virtual ~ActuatorBatch() = default;
  // Makes one device for each robot of the setup. Throws ConfigurationError for a user's mistake.
  virtual void Init(const DeviceSetup& setup) = 0;
  // Returns the object given to the controller of robot k; it lives as long as the batch.
  virtual CCI_Actuator* Actuator(std::size_t k) = 0;
  // Writes the values that the controllers set: into the channel (specific devices), or as attribute changes with
  // ascending slots (generic devices).
  virtual void Commit(const ChannelView& channel, AttributeChanges& changes) = 0;
  // Returns the distance (m, in the plane) up to which other entities can change its commands, as SensorBatch::Reach.
  virtual double Reach() const { return kReachesEverywhere; }
  // Adds the settings of robot k, in memory that faults change during Commit. A device that does not override it cannot
  // have faults.
  virtual void Expose(std::size_t, ExposedValues&) {}
  // Saves the state that the device of robot k keeps between ticks. Devices without state need not override it.
  virtual void SaveState(std::size_t, ByteWriter&) const {}
  // Restores the state of robot k from SaveState. Throws std::runtime_error if the data is too short.
  virtual void LoadState(std::size_t, ByteReader&) {}
};

template <>
PluginRegistry<SensorBatch>& PluginRegistry<SensorBatch>::Instance();
template <>
PluginRegistry<ActuatorBatch>& PluginRegistry<ActuatorBatch>::Instance();

// Adds the devices of this folder to the registries. Idempotent.
void RegisterBuiltinDevices();

// Returns the columns of the class that a batch's Sensor or Actuator returns, or nullptr if it returns the base class.
template <class Batch>
const CCI_Columns* ColumnsOf()
{
  const auto columns = []<class Device, class Owner>(Device* (Owner::*)(std::size_t)) -> const CCI_Columns*
  {
    if constexpr (requires { Device::AllColumns(); })
      return &Device::AllColumns();
    else
      return nullptr;
  };
  if constexpr (std::is_base_of_v<SensorBatch, Batch>)
    return columns(&Batch::Sensor);
  else
    return columns(&Batch::Actuator);
}

// FindColumns returns the declared columns of a device type for programs without a device. It returns nullptr if they
// are unknown or the interface declares none. The registration of a batch sets them.
const CCI_Columns* FindColumns(PluginKind kind, const std::string& label);
void SetColumns(PluginKind kind, const std::string& label, const CCI_Columns* columns);

template <class Interface, class Batch>
struct DeviceRegistration
{
  explicit DeviceRegistration(const PluginDescription& description)
  {
    constexpr auto kKind = std::is_same_v<Interface, SensorBatch> ? PluginKind::kSensor : PluginKind::kActuator;
    CheckNoiseOf(kKind, description);
    SetColumns(kKind, description.label, ColumnsOf<Batch>());
    PluginRegistry<Interface>::Instance().Add(description, [] { return std::make_unique<Batch>(); });
  }
};

}  // namespace swarmanoid

// REGISTER_SENSOR(CMySensorBatch, description) and REGISTER_ACTUATOR(...) register devices of a user's library.
#define REGISTER_SENSOR(CLASS, ...)                                                                              \
  namespace                                                                                                      \
  {                                                                                                              \
  const ::swarmanoid::DeviceRegistration<::swarmanoid::SensorBatch, CLASS> registration_of_##CLASS(__VA_ARGS__); \
  }
#define REGISTER_ACTUATOR(CLASS, ...)                                                                              \
  namespace                                                                                                        \
  {                                                                                                                \
  const ::swarmanoid::DeviceRegistration<::swarmanoid::ActuatorBatch, CLASS> registration_of_##CLASS(__VA_ARGS__); \
  }

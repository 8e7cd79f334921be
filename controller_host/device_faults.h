// DeviceFaults: changes the values of devices as <faults> says (docs/faults.md), between the devices and the
// controllers. Owned by a controller host, in its thread. Neither devices nor engines know it.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "common/experiment/experiment.h"
#include "common/math/random.h"
#include "common/serialisation/bytes.h"
#include "controller_host/exposed_values.h"

namespace swarmanoid
{

class ActuatorBatch;
class CSwarmanoidSpace;
class OnDemandSensor;
class SensorBatch;

class DeviceFaults
{
public:
  // The device of one robot: robot `k` of a batch, and number `robot` of the host. One of sensor and actuator is null.
  struct Device
  {
    SensorBatch* sensor = nullptr;
    OnDemandSensor* on_demand = nullptr;  // the sensor, if its readings are made on demand
    ActuatorBatch* actuator = nullptr;
    std::size_t k = 0;
    std::size_t robot = 0;
  };

  // The space outlives the faults.
  DeviceFaults(const CSwarmanoidSpace& space, std::size_t robots);

  // Begin, AddOff and Add describe the faults in their order: Begin a fault, the others its robots and devices. Add
  // throws ConfigurationError if the device cannot have such a fault.
  void Begin(const FaultConfiguration& fault);
  // Begins the faults that switch robots off while their batteries are empty. `is_off` tells it of a robot of the host.
  void BeginEmptyBatteries(const FaultConfiguration& fault, std::function<bool(std::size_t robot)> is_off);
  void AddOff(std::size_t robot) { rows_.back().off.push_back(robot); }
  void Add(const Device& device, std::uint32_t entity, const DeviceConfiguration& configuration);

  // Changes the readings of the tick of the space, after the sensors made them and once a tick.
  void ChangeReadings();
  // Changes the settings that actuators commit, once a tick. RestoreSettings undoes it, so that a controller finds its
  // own settings in the next tick.
  void ChangeSettings();
  void RestoreSettings();

  // Switches robots off and on at the tick of the space. Returns whether some robot was switched.
  bool SwitchRobots();
  // Returns the fault that has switched a robot off, or nullptr if the robot is on.
  const FaultConfiguration* SwitchedOff(std::size_t robot) const { return switched_off_[robot]; }
  // Returns the same as it was before the last call of SwitchRobots.
  const FaultConfiguration* SwitchedOffBefore(std::size_t robot) const { return off_before_[robot]; }

  // The state of robot k of the host goes to states[k].
  void SaveState(std::span<ByteWriter> states) const;
  void LoadState(std::span<ByteReader> states);

private:
  // How a number may be changed.
  struct Column
  {
    bool is_quantity;  // scale, bias and noise change it
    double minimum, maximum;
  };
  struct Target
  {
    Device device;
    std::uint32_t entity;
    StreamKey key;
    std::size_t columns, count;         // in columns_; the numbers that the device exposes
    std::size_t memory, memory_length;  // in memory_: numbers of stuck, drop and delay, tick after tick
  };
  struct Row
  {
    const FaultConfiguration* fault;
    std::function<bool(std::size_t)> is_off{};  // of empty batteries; otherwise the ticks of the fault count
    bool is_active = false;                     // since SwitchRobots
    std::vector<Target> sensors{}, actuators{};
    std::vector<std::size_t> off{};  // robots of the host
  };

  void Expose(const Device& device);
  // Returns the columns of the numbers that values_ has, as far as they are known.
  std::vector<Column> ColumnsOf(const Device& device) const;
  // Returns ticks of numbers that a fault remembers.
  static std::size_t RememberedTicks(const FaultConfiguration& fault);
  // Calls change(fault, target, tick) for the faults of the tick, and of the tick before their first one.
  template <class Change>
  void ForEachTarget(std::vector<Target> Row::*targets, Change change);
  // Makes `now_` from the numbers in values_, at a tick of the fault or the one before.
  void ChangeNumbers(const FaultConfiguration& fault, const Target& target, std::uint64_t tick);
  void ChangeList(const FaultConfiguration& fault, RandomStream& random);
  std::uint64_t Tick() const;

  const CSwarmanoidSpace& space_;
  std::vector<Row> rows_;
  std::vector<Column> columns_;
  std::vector<double> memory_;
  std::vector<const FaultConfiguration*> switched_off_, off_before_;  // by robot; before the last SwitchRobots
  // Scratch, and the settings to restore.
  ExposedValues values_;
  std::vector<double> now_;
  std::vector<std::uint8_t> kept_;
  std::vector<std::pair<double*, double>> settings_;
};

}  // namespace swarmanoid

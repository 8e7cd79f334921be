// BatteryReports: what the wheels, receivers and own devices of robots draw from their batteries. Only the controller
// host knows these, so it reports them to the space server, in the attribute BatterySlots::kReported. Owned by a
// controller host, in its thread.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "common/messages/assignment.h"
#include "common/messages/attribute_changes.h"
#include "common/space/battery_slots.h"

namespace swarmanoid
{

class ActuatorBatch;
class CCI_RadioSensor;
class CCI_RangeAndBearingSensor;
class CSwarmanoidSpace;
class DeviceFaults;
class PoweredDevice;
class SensorBatch;

class BatteryReports
{
public:
  // Returns nullptr if no robot of the host has an energy_battery. The space and the layout must outlive the object.
  static std::unique_ptr<BatteryReports> Of(const CSwarmanoidSpace& space, const HostLayout& layout);

  // Adds a device of a robot: number `robot` of the host, and `k` of the batch.
  void Add(std::size_t robot, SensorBatch& batch, std::size_t k);
  void Add(std::size_t robot, ActuatorBatch& batch, std::size_t k);
  // Counts the bytes that arrived, after the sensors have read them.
  void ReadReceivers();
  // Adds the reports that differ from the space to the changes of a tick, after `commands` are final. `faults` says
  // which robots are switched off; it may be null.
  void Report(std::span<const double> commands, const DeviceFaults* faults, AttributeChanges& changes);
  // Returns whether the empty battery of a robot of the host has switched it off.
  bool IsOff(std::size_t robot) const { return batteries_[robot] && batteries_[robot]->IsOff(); }
  // Returns whether the robot has a battery that switches it off.
  bool Stops(std::size_t robot) const { return batteries_[robot] && batteries_[robot]->Model().stops; }

private:
  struct Powered
  {
    const PoweredDevice* device;
    std::size_t k;
  };
  struct Robot
  {
    std::size_t wheels;  // its two angular velocities (rad/s) in the commands, or kNone
    double wheel_radius_m;
    std::vector<const CCI_RadioSensor*> radios{};
    std::vector<const CCI_RangeAndBearingSensor*> receivers{};
    std::vector<Powered> powered{};
    double bytes_received = 0;  // in this tick
  };
  static constexpr std::size_t kNone = ~std::size_t{0};

  BatteryReports(const CSwarmanoidSpace& space, const HostLayout& layout);
  double Power(std::size_t robot, std::span<const double> commands) const;
  void AddPowered(std::size_t robot, const PoweredDevice* device, std::size_t k);

  const CSwarmanoidSpace& space_;
  std::vector<std::optional<BatteryView>> batteries_;  // by robot of the host
  std::vector<Robot> robots_;
  AttributeChanges reports_;  // of all robots, in this tick
};

}  // namespace swarmanoid

// The slots of a robot with an energy_battery, after all slots of its kind, its messages and its deposits. They are
// part of the state, so its hash, journal and checkpoints have them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "common/experiment/battery_model.h"

namespace swarmanoid
{

class CSwarmanoidSpace;

struct BatterySlots
{
  static constexpr std::uint32_t kCharge = 0;    // J
  static constexpr std::uint32_t kPower = 1;     // W drawn in the last tick, set by the space server
  static constexpr std::uint32_t kReported = 2;  // W of wheels, receivers and own devices, set by the controller host;
                                                 // negative: the robot is switched off and draws nothing
  static constexpr std::uint32_t kOff = 3;       // 1: the empty battery has switched the robot off
  static constexpr std::uint32_t kCount = 4;
};

// Returns the number of these slots of an entity: BatterySlots::kCount, or 0.
std::size_t BatterySlotsOf(const Experiment& experiment, const EntityConfiguration& entity);
// Returns the initial numbers of the slots.
std::vector<double> FullBattery(const BatteryModel& model);

// The battery of a robot, by its slots in a space. The space must outlive it.
class BatteryView
{
public:
  // Returns nullopt for an entity without such a battery.
  static std::optional<BatteryView> Of(const CSwarmanoidSpace& space, std::uint32_t entity);

  const BatteryModel& Model() const { return model_; }
  std::uint32_t Slot(std::uint32_t part) const { return first_slot_ + part; }
  double Charge_J() const { return Number(BatterySlots::kCharge); }
  double Power_W() const { return Number(BatterySlots::kPower); }
  bool IsOff() const { return Number(BatterySlots::kOff) != 0; }

private:
  BatteryView(const CSwarmanoidSpace& space, const BatteryModel& model, std::uint32_t first_slot)
      : space_(&space), model_(model), first_slot_(first_slot)
  {
  }
  double Number(std::uint32_t part) const;

  const CSwarmanoidSpace* space_;
  BatteryModel model_;
  std::uint32_t first_slot_;
};

}  // namespace swarmanoid

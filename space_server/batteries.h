// Batteries: the charge of the robots with an energy_battery, and the charging stations (docs/batteries.md). Owned by
// the space server. All numbers are in the attributes of the space, so this class has no state of its own between
// ticks.
//
//   power  = idle + LEDs + grippers + sent bytes / tick, from the state, + what the controller host reported
//   charge = charge - power · tick + charging power · tick, from 0 to the capacity
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "common/experiment/battery_model.h"
#include "common/space/battery_slots.h"

namespace swarmanoid
{

class CSwarmanoidSpace;

class Batteries
{
public:
  // The space must outlive the object.
  explicit Batteries(const CSwarmanoidSpace& space);

  bool empty() const { return robots_.empty(); }
  // Remembers the packets that radios have sent before the changes of a tick are merged.
  void BeginTick();
  // Calls change(slot, value) for the batteries of the next tick, after the changes of the tick are merged.
  using Change = std::function<void(std::uint32_t slot, double value)>;
  void Advance(const Change& change);
  // Calls change(slot, value) for the batteries at the start of the experiment.
  void Reset(const Change& change) const;

private:
  struct Slots
  {
    std::uint32_t first;
    std::uint32_t count;
  };
  struct Robot
  {
    std::uint32_t entity;
    BatteryView battery;
    std::vector<Slots> lights;   // colours of LEDs and beacons
    Slots hands;                 // what grippers hold
    std::uint32_t message_slot;  // range and bearing, or kNone
    double message_bytes;
    std::uint32_t radio_slot;   // or kNone
    double packets_before = 0;  // sent by its radio
  };
  struct Station
  {
    std::uint32_t entity;
    std::uint32_t power_slot;
    std::uint32_t limit_slot;  // or kNone
    bool is_disc;
    double half_x, half_y;  // m; discs: radius in half_x
  };
  static constexpr std::uint32_t kNone = ~0U;

  void AddRobot(std::uint32_t entity, const BatteryView& battery);
  void AddStation(std::uint32_t entity);
  bool IsOn(const Station& station, std::uint32_t robot) const;
  // Computes charging_w_ from the positions of the robots.
  void Charge();
  double CountNotZero(const Slots& slots) const;
  // Returns the power that a robot would draw in the tick.
  double Demand(const Robot& robot) const;
  void Advance(const Robot& robot, double charging_w, const Change& change) const;

  const CSwarmanoidSpace& space_;
  std::vector<Robot> robots_;
  std::vector<Station> stations_;
  std::vector<double> charging_w_;       // by robot
  std::vector<std::size_t> on_station_;  // scratch: the robots on one station
};

}  // namespace swarmanoid

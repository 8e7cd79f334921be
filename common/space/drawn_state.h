// The parts of the state that renderers show as shapes, beside the bodies: fields on the floor, the wind, charging
// stations and the charge of batteries. Made once for a space, which must outlive it. Plain values, no thread.
#pragma once

#include <cstdint>
#include <vector>

#include "common/messages/drawing.h"
#include "common/space/wind.h"

namespace swarmanoid
{

class CSwarmanoidSpace;

class DrawnState
{
public:
  // Implicit, so that functions that draw once take the space itself.
  DrawnState(const CSwarmanoidSpace& space);

  const CSwarmanoidSpace& Space() const { return space_; }
  // Adds shapes for the present tick:
  // - the fields on the floor (drawn_fields.h)
  // - an arrow of the wind in the corner at the origin, with the speed (m/s) over the middle of the arena. The arrow is
  //   as long as a fifth of the arena's shorter side at the fastest usual speed.
  // - a bolt on each charging station that has power
  // - a bar over each robot with an energy_battery: its charged part is green, from half on yellow, from a fifth on
  // red.
  //   Experiments with more than kMostBars of these robots have no bars.
  void Draw(Drawing& drawing) const;
  // Returns whether shapes follow poses, attributes or the clock, beyond the fields on the floor.
  bool Changes() const { return wind_.IsDeclared() || !stations_.empty() || !batteries_.empty(); }

  static constexpr std::size_t kMostBars = 1000;

private:
  struct Station
  {
    std::uint32_t entity;
    std::uint32_t power_slot;
    double radius_m;  // of a circle in it
  };
  struct Battery
  {
    std::uint32_t robot;
    std::uint32_t charge_slot;
    double capacity_j;
    double height_m;      // of the bar, above the robot's position
    double half_width_m;  // of the bar
  };

  void DrawWind(Drawing& drawing) const;
  void DrawStations(Drawing& drawing) const;
  void DrawBatteries(Drawing& drawing) const;

  const CSwarmanoidSpace& space_;
  Wind wind_;
  std::vector<Station> stations_;
  std::vector<Battery> batteries_;
};

}  // namespace swarmanoid

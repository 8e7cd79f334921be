// Wind: the velocity of the air over the arena, as <wind> declares it (docs/flying.md). A constant wind carries a
// frozen field of gusts along. The field has the spectra of Dryden for low altitudes, and is a function of place and
// time, so no process keeps a state of it.
#pragma once

#include <array>
#include <vector>

#include "common/experiment/experiment.h"
#include "common/math/pose.h"

namespace swarmanoid
{

// Dryden's deviations and lengths at a height (MIL-F-8785C, 3.7.3.4), of gusts along the wind, across and upwards.
struct DrydenGusts
{
  double across_m_s = 0;  // deviation along the wind and across
  double upward_m_s = 0;  // deviation upwards
  double across_m = 0;    // length along the wind and across
  double upward_m = 0;    // length upwards

  // `wind_at_20_feet_m_s`: the speed that scales the deviations. The height is taken as 3.048 to 304.8 m (10 to 1000
  // feet), where the formulas hold.
  static DrydenGusts At(double height_m, double wind_at_20_feet_m_s);
};

class Wind
{
public:
  // Calm air, if the experiment has no <wind>.
  explicit Wind(const Experiment& experiment);

  // Returns the velocity (m/s) of the air at a place, at a time (s) of the run.
  Vector3 At(const Vector3& place, double time_s) const;
  bool IsDeclared() const { return is_declared_; }

private:
  // One part of a component, with an equal share of its variance.
  struct Wave
  {
    double per_metre = 0;  // rad/m
    double phase = 0;      // rad
  };
  static constexpr int kWaves = 64;  // of each component

  bool is_declared_ = false;
  Vector3 mean_ = Vector3::Zero();
  double speed_ = 0;                   // m/s, of the horizontal part of the mean
  Vector2 direction_{1, 0};            // of that part
  std::array<double, 3> amplitude_{};  // m/s, of each wave: along, across, upwards
  std::array<std::vector<Wave>, 3> waves_;
};

}  // namespace swarmanoid

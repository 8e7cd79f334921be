// The bodies of a plane: outlines, poses, velocities, turrets and mirrors, one array a property. The stages of a step
// (plane_step.h) read and write these arrays.
//
// Lengths are in metres, angles in radians, times in seconds. `now` and `before` are padded for the vector loops.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "common/math/zeroed_vector.h"
#include "engine_worker/engines/kinematics2d/collision_model.h"
#include "engine_worker/engines/kinematics2d/motion.h"
#include "engine_worker/engines/kinematics2d/narrow_phase.h"

namespace swarmanoid::kinematics2d
{

inline constexpr std::uint32_t kNobody = ~0U;

// Bodies that get new numbers as a whole. Runs keep their order.
struct Run
{
  std::uint32_t from, to, count;
};

// Gives memory back that far more bodies took before.
template <class Values>
void Trim(Values& values)
{
  if (values.capacity() > 2 * values.size()) values.shrink_to_fit();
}

// Moves the values of runs, in place. Values of bodies between the runs are left over, for the caller to set; those
// from `count` on are `behind`.
template <class Values>
void MoveRuns(std::span<const Run> runs, std::size_t count, std::size_t size, typename Values::value_type behind,
              Values& values)
{
  values.resize(std::max(values.size(), size), behind);
  const auto at = [&](std::uint32_t place) { return values.begin() + static_cast<std::ptrdiff_t>(place); };
  // Runs that go to the front move from the first one on, the others from the last one on: none is overwritten.
  for (const Run& run : runs)
    if (run.to < run.from) std::copy_n(at(run.from), run.count, at(run.to));
  for (std::size_t k = runs.size(); k-- > 0;)
    if (runs[k].to > runs[k].from)
      std::copy_backward(at(runs[k].from), at(runs[k].from + runs[k].count), at(runs[k].to + runs[k].count));
  values.resize(size, behind);
  std::fill(at(static_cast<std::uint32_t>(count)), values.end(), behind);
  Trim(values);
}

// A turret that turns against its body.
struct Turret
{
  std::uint32_t body;
  double rate;    // rad/s
  double before;  // angle when the substep began
};

// A body that another engine moves: it pushes and is not pushed.
struct Follower
{
  std::uint32_t body;
  Pose2 from, goal;  // of the tick
  Pose2 other;       // where the substep began, or where it ended: see Bodies::SwapFollowers
};

struct Bodies
{
  // The outlines. Static shapes stand at the origin of the plane.
  std::vector<CollisionModel> models, statics;
  double median_core = 0;     // of the bodies at the start
  double smallest_limit = 1;  // the smallest LimitOf of these bodies

  std::size_t count = 0;
  std::vector<std::uint32_t> model;
  std::vector<std::uint8_t> is_follower, is_present;
  std::vector<double> inverse_limit;  // 1 / LimitOf
  TwistStore twists;                  // as commanded
  PoseStore now;
  PoseStore before;  // where the substep began
  // Where the motion of the substep ended, before collisions. The static shapes come after the bodies.
  std::vector<Placed> placed;

  ZeroedVector<double> turret_angle, turret_sin, turret_sin_before;
  std::vector<double> turret_cos, turret_cos_before;  // empty while no turret was ever turned: all are 1
  ZeroedVector<double> turret_way;                    // rad in this substep
  std::vector<Turret> turrets;                        // the turning ones, by body
  std::vector<Follower> followers;                    // by body

  // The arc that the centre drove forward and the turn in the tick, collisions included.
  bool keeps_travel = false;
  ZeroedVector<double> travel_forward, travel_turn;

  std::uint32_t Add(std::uint32_t model_number, const Pose2& pose, bool follower);
  // Sizes all arrays for `count` bodies, and fills what lies behind them.
  void MakeRoom();
  // Gives the bodies new numbers. The caller sets the values of bodies between the runs.
  void Renumber(std::span<const Run> runs, std::size_t new_count);

  void SetTurretRate(std::uint32_t body, double rate);
  void SetTurretAngle(std::uint32_t body, double angle);
  // Requires that the body has a turning turret.
  const Turret& TurretOf(std::uint32_t body) const;
  double TurretRate(std::uint32_t body) const;

  const CollisionModel& ModelOf(std::uint32_t body) const { return models[model[body]]; }
  double RadiusOf(std::uint32_t body) const { return ModelOf(body).bounding_radius; }
  std::vector<double> Radii() const;
  // A body of this model goes at most so far (m) in a substep.
  double LimitOf(const CollisionModel& outline) const;
  bool IsFollower(std::uint32_t body) const { return is_follower[body] != 0; }
  bool IsStatic(std::uint32_t body) const { return body >= count; }

  double TurretCos(std::uint32_t body) const { return turret_cos.empty() ? 1 : turret_cos[body]; }
  Placed PlacedNow(std::uint32_t body) const { return PlacedAt(body, now, TurretCos(body), turret_sin[body]); }
  Placed PlacedBefore(std::uint32_t body) const
  {
    const double cos = turret_cos_before.empty() ? 1 : turret_cos_before[body];
    return PlacedAt(body, before, cos, turret_sin_before[body]);
  }
  std::uint32_t NumberOf(const Placed& body) const { return static_cast<std::uint32_t>(&body - placed.data()); }

  // Exchanges the places of followers in `before`: where the substep began, and where it ends. A collision counts the
  // former. A body that looks for room finds a follower where it ends, since it goes there in any case.
  void SwapFollowers();

private:
  Placed PlacedAt(std::uint32_t body, const PoseStore& poses, double turned_cos, double turned_sin) const
  {
    const Rotor heading{poses.z[body], poses.w[body]};
    return {poses.x[body], poses.y[body], CosOf(heading), SinOf(heading), turned_cos, turned_sin, &ModelOf(body)};
  }
};

// Returns the radius of the core of an outline: of a circle about the origin that it fills, but not less than a part of
// all.
double CoreOf(const CollisionModel& outline);

}  // namespace swarmanoid::kinematics2d

// Problem: a body that goes too far in one substep passes through another one, or comes to its far side.
//
// Method: the core of an outline is a circle about its origin that it fills. If no body goes further than half of its
// core's radius (kWayInCore), two bodies that meet head-on cannot pass through each other. The body with the largest
// way against that limit sets the number of substeps for all.
//
// Invariants: only maxima are taken, so that order, threads and regions change no bit. In a substep no body gets
// further than `reach` from where it began: the longest way, and what a push may add.
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "common/math/lanes.h"
#include "engine_worker/engines/kinematics2d/plane_step.h"
#include "engine_worker/engines/kinematics2d/step_constants.h"

namespace swarmanoid::kinematics2d
{

LongestWay FindLongestWay(const Bodies& bodies, const Groups& groups, double seconds)
{
  const TwistStore& twists = groups.Twists(bodies);
  DoubleLanes most_ratio{}, most_speed{};
  for (std::size_t k = 0; k < bodies.count; k += kDoubleLanes)
  {
    const DoubleLanes forward = LoadLanes(&twists.forward[k]);
    const DoubleLanes left = LoadLanes(&twists.left[k]);
    const DoubleLanes inverse_limit = LoadLanes(&bodies.inverse_limit[k]);
    const DoubleLanes speed = forward * forward + left * left;
    const DoubleLanes ratio = speed * (inverse_limit * inverse_limit);
    most_ratio = ratio > most_ratio ? ratio : most_ratio;
    most_speed = speed > most_speed ? speed : most_speed;
  }
  LongestWay longest;
  for (std::size_t lane = 0; lane < kDoubleLanes; ++lane)
  {
    longest.limits = std::max(longest.limits, most_ratio[lane]);
    longest.metres = std::max(longest.metres, most_speed[lane]);
  }
  longest.limits = std::sqrt(longest.limits) * seconds;
  longest.metres = std::sqrt(longest.metres) * seconds;

  // Members of groups go about their prey; followers go wherever they are told.
  const auto consider = [&](double metres, std::uint32_t body)
  {
    longest.limits = std::max(longest.limits, metres / bodies.LimitOf(bodies.ModelOf(body)));
    longest.metres = std::max(longest.metres, metres);
  };
  for (const Grip& grip : groups.grips)
  {
    const Twist group = groups.with_groups.Get(grip.prey);
    const double speed =
        std::sqrt(group.forward * group.forward + group.left * group.left) + std::fabs(group.turn) * grip.Arm();
    consider(speed * seconds, grip.body);
  }
  for (const Follower& follower : bodies.followers)
  {
    const double dx = follower.goal.x - follower.from.x;
    const double dy = follower.goal.y - follower.from.y;
    consider(std::sqrt(dx * dx + dy * dy), follower.body);
  }
  return longest;
}

int ChooseSubsteps(const LongestWay& way, double seconds, int steps, const Bodies& bodies, StepLengths& lengths)
{
  if (!(way.limits <= kMostSubsteps))
    throw std::runtime_error("a body is told to move " + std::to_string(way.metres) + " m in " +
                             std::to_string(seconds) + " s; the kinematic engine follows up to " +
                             std::to_string(kMostSubsteps * bodies.smallest_limit) + " m in that time");
  const int needed = static_cast<int>(std::ceil(way.limits / steps));
  const int substeps = steps * std::max(needed, 1);
  lengths.reach = way.metres / substeps + kSlowestSeparation;
  lengths.contact_margin = std::min(kContactMargin, 2 * way.metres / substeps + kSlowestSeparation);
  return substeps;
}

}  // namespace swarmanoid::kinematics2d

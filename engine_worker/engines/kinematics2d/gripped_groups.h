// Gripped groups. A robot that grips a prey moves with it as one rigid whole, and several robots may grip one prey. The
// prey leads the group: contacts and limits act on leaders alone. A body without grips leads itself.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "engine_worker/engines/kinematics2d/plane_bodies.h"

namespace swarmanoid::kinematics2d
{

struct Grip
{
  std::uint32_t body = 0;  // the one that grips
  std::uint32_t prey = 0;
  Pose2 relative;  // of the body in the frame of the prey

  double Arm() const { return std::sqrt(relative.x * relative.x + relative.y * relative.y); }
};

struct Groups
{
  std::vector<Grip> grips;            // by prey, then body
  std::vector<std::uint32_t> starts;  // of each group in `grips`, and the end
  // There is one more entry than bodies, for the static world.
  std::vector<std::uint32_t> leader;  // of each body
  std::vector<double> mobility;       // of each leader, the inverse of a weight; 0 for those that nothing pushes
  TwistStore with_groups;             // twists of the bodies with those of groups filled in; used while there are any

  // Follows from `grips` and the bodies; to be called when either changes.
  void Rebuild(const Bodies& bodies);
  const Grip* FindGrip(std::uint32_t body) const;
  std::span<const Grip> GripsOf(std::uint32_t prey) const;
  // Calls act(grips) for each group.
  template <class Act>
  void ForEach(const Act& act) const
  {
    for (std::size_t g = 0; g + 1 < starts.size(); ++g)
      act(std::span<const Grip>(&grips[starts[g]], starts[g + 1] - starts[g]));
  }

  // Returns the leader of a body or a static shape.
  std::uint32_t LeaderOf(std::uint32_t body) const
  {
    return leader[std::min(body, static_cast<std::uint32_t>(leader.size() - 1))];
  }
  // The twists that leaders have.
  const TwistStore& Twists(const Bodies& bodies) const { return grips.empty() ? bodies.twists : with_groups; }
};

// Returns whether grip a comes before grip b.
bool IsBefore(const Grip& a, const Grip& b);

// Fills in Groups::with_groups: a stage at the start of a tick.
void FindGroupTwists(const Bodies& bodies, Groups& groups);

}  // namespace swarmanoid::kinematics2d

// CollisionModels: the bodies of all entities in the form in which their engines collide them, for sensors, queries and
// renderers. The result follows from the descriptions of the engines and the state alone, so it is equal in every
// process. All processes have these descriptions; the engines' code is not needed.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "common/experiment/collision_body.h"
#include "common/math/pose.h"

namespace swarmanoid
{

class CSwarmanoidSpace;

class CollisionModels
{
public:
  // The space must outlive the object.
  explicit CollisionModels(const CSwarmanoidSpace& space);

  // Sets `bodies` to the bodies of an entity in its frame, as the engine that moves it collides them now. It is the
  // plain body if no engine has the entity, or the engine describes none.
  void BodiesOf(std::uint32_t entity, std::vector<CollisionBody>& bodies) const;
  // Returns the movable entities with a hull or with bodies that extend beyond the plain one, such as arms, ascending.
  // For all others, sensors and queries use the plain body.
  std::span<const std::uint32_t> Articulated() const { return articulated_; }
  bool IsArticulated(std::uint32_t entity) const;

private:
  const CSwarmanoidSpace& space_;
  std::vector<int> engine_of_;  // -1: none
  std::vector<std::uint32_t> articulated_;
};

// Works as SegmentHit of common/space/shape.h, for the first hit of the bodies of an entity at a pose.
std::optional<double> SegmentHit(std::span<const CollisionBody> bodies, const Pose& pose, const Vector3& from,
                                 const Vector3& to);
// Returns how far a body reaches from the origin of its entity at most, m.
double ReachOf(const CollisionBody& body);

}  // namespace swarmanoid

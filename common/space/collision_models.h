// CollisionModels: the bodies of all entities as their engines collide them, for those who ask what is in the way:
// sensors, queries, renderers. What they tell follows from the descriptions of the engines and the state alone, so it
// is the same in every process. Engines are described in all processes; their code is not needed.
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
  // The space outlives it.
  explicit CollisionModels(const CSwarmanoidSpace& space);

  // The bodies of an entity as the engine that moves it collides them now, in its frame; its plain body if no engine
  // has it, or the engine tells nothing. `bodies` is cleared first.
  void BodiesOf(std::uint32_t entity, std::vector<CollisionBody>& bodies) const;
  // Movable entities with bodies that reach beyond the plain one, such as arms, and those with a hull, ascending. Of
  // all others the plain body is what sensors and queries go by.
  std::span<const std::uint32_t> Articulated() const { return articulated_; }
  bool IsArticulated(std::uint32_t entity) const;

private:
  const CSwarmanoidSpace& space_;
  std::vector<int> engine_of_;  // -1: none
  std::vector<std::uint32_t> articulated_;
};

// As SegmentHit of common/space/shape.h, of the bodies of an entity at a pose: the first one that is met.
std::optional<double> SegmentHit(std::span<const CollisionBody> bodies, const Pose& pose, const Vector3& from,
                                 const Vector3& to);
// How far a body reaches from the origin of its entity at most, m.
double ReachOf(const CollisionBody& body);

}  // namespace swarmanoid

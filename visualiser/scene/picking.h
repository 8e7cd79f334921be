// Finds the entity at a click.
#pragma once

#include <optional>

#include "common/experiment/experiment.h"
#include "common/math/pose.h"
#include "visualiser/scene/camera.h"

namespace swarmanoid
{

class CSwarmanoidSpace;

struct Pick
{
  std::uint32_t entity = 0;
  Vector3 point = Vector3::Zero();
};

// Returns the first body on a ray. Robots count as a little larger than their bodies, so that small ones can be hit.
// From outside, the ray passes through walls around the arena.
std::optional<Pick> PickEntity(const CSwarmanoidSpace& space, const Ray& ray);

// Returns whether a wall or block is at the edge of the arena and tall enough to hide what is behind it.
bool IsBoundaryWall(const EntityConfiguration& entity, const Vector3& arena_size);
// Returns whether the wall is between an eye and the middle of the arena, and must be shown as glass.
bool HidesArena(const EntityConfiguration& wall, const Vector3& arena_size, const Vector3& eye);
// Returns how much of a wall (m, from below) is drawn solid: less for a wall that hides the arena.
float SolidHeight(const EntityConfiguration& wall, const Vector3& arena_size, const Vector3& eye);

}  // namespace swarmanoid

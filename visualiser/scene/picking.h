// Which entity a click meets.
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

// The first body on a ray. Robots are a little larger than their bodies, so that small ones can be hit; walls around
// the arena are looked through from outside.
std::optional<Pick> PickEntity(const CSwarmanoidSpace& space, const Ray& ray);

// Whether a wall or block stands at the edge of the arena and is tall enough to hide what is behind it.
bool IsBoundaryWall(const EntityConfiguration& entity, const Vector3& arena_size);
// Whether it stands between an eye and the middle of the arena, and is to be shown as glass.
bool HidesArena(const EntityConfiguration& wall, const Vector3& arena_size, const Vector3& eye);
// How much of a wall (m, from below) is drawn solid: less of one that hides the arena.
float SolidHeight(const EntityConfiguration& wall, const Vector3& arena_size, const Vector3& eye);

}  // namespace swarmanoid

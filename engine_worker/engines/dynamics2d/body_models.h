// The rigid bodies that entities become in dynamics2d: outlines, masses, friction.
#pragma once

#include <optional>

#include "common/space/entity.h"
#include "engine_worker/engines/dynamics2d/dynamics2d_parameters.h"
#include "engine_worker/engines/dynamics2d/dynamics2d_world.h"

namespace swarmanoid::dynamics2d
{

// The body of an entity that the engine moves, or of a mirror (`motion` kKinematic). Throws ConfigurationError if it
// is too small for the solver.
BodyModel MovableModel(const CSwarmanoidSpaceEntity& entity, EMotion motion, const PlaneFrame& plane,
                       const Dynamics2dParameters& parameters);

struct FixedBody
{
  BodyModel model;
  PlanePose pose;
};
// Returns the body of something fixed; nullopt where the plane does not cut it.
std::optional<FixedBody> FixedModel(const CSwarmanoidSpaceEntity& entity, const PlaneFrame& plane,
                                    const Dynamics2dParameters& parameters);

// An immovable polygon (m, in the plane) of something that has no contact parameters of its own.
BodyModel StaticModel(std::vector<Vector2> polygon, const Dynamics2dParameters& parameters);

// The outline of a mirrored block as it stands now, in the frame of its pose on the plane; empty for other kinds, and
// where the plane does not cut it or cuts less than the solver can hold.
std::vector<Vector2> MirrorOutline(const CSwarmanoidSpaceEntity& entity, const PlaneFrame& plane);

// Returns true while a mirror's body reaches the plane.
bool ReachesPlane(const CSwarmanoidSpaceEntity& entity, const PlaneFrame& plane);

}  // namespace swarmanoid::dynamics2d

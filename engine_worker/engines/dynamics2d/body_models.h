// The rigid bodies that entities become in dynamics2d: outlines, masses, friction.
#pragma once

#include <optional>

#include "common/space/entity.h"
#include "engine_worker/engines/dynamics2d/dynamics2d_parameters.h"
#include "engine_worker/engines/dynamics2d/dynamics2d_world.h"

namespace swarmanoid::dynamics2d
{

// Distance between the wheels of a footbot and their radius (m), as in the ARGoS3 model.
inline constexpr double kInterWheelDistance = 0.14;
inline constexpr double kWheelRadius = 0.029112741;

// Lights, sounds and floor markings have no body.
bool HasBody(EntityKind kind);

// The body of an entity that the engine moves, or of a mirror (`motion` kKinematic). Throws ConfigurationError where it
// is too small for the solver.
BodyModel MovableModel(const CSwarmanoidSpaceEntity& entity, EMotion motion, const PlaneFrame& plane,
                       const Dynamics2dParameters& parameters);

// The body of something fixed, in the frame of the plane; nullopt where the plane does not cut it.
std::optional<BodyModel> FixedModel(const CSwarmanoidSpaceEntity& entity, const PlaneFrame& plane,
                                    const Dynamics2dParameters& parameters);

// An immovable polygon (m, in the plane) of something that has no contact parameters of its own.
BodyModel StaticModel(std::vector<Vector2> polygon, const Dynamics2dParameters& parameters);

// The outline of a mirrored block as it stands now, in the frame of its pose on the plane; empty for other kinds, and
// where the plane does not cut it or cuts less than the solver can hold.
std::vector<Vector2> MirrorOutline(const CSwarmanoidSpaceEntity& entity, const PlaneFrame& plane);

// True while a mirror's body reaches the plane.
bool ReachesPlane(const CSwarmanoidSpaceEntity& entity, const PlaneFrame& plane);

}  // namespace swarmanoid::dynamics2d

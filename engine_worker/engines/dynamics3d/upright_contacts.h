// Contacts of two upright prisms that stand side by side: boxes and cylinders on a common floor.
#pragma once

#include <ode/ode.h>

#include <span>

#include "common/math/pose.h"

namespace swarmanoid::dynamics3d
{

// A point of a patch belongs to a contact if its gap is at most this wide (m), or if the gap closes within the step.
// Bodies at rest on a floor lean by less.
inline constexpr double kPatchGap = 1e-4;
// Bodies within 0.5 degrees count as upright, and faces as flat.
inline constexpr double kFlatCosine = 0.99996;

// Returns the widest gap (m) of a point that belongs to a contact with this normal, which points into the first body.
// `way` is how far the first body moves against the second one within the step.
inline double PatchGap(const Vector3& normal, const Vector3& way)
{
  const double approach = -normal.dot(way);
  return kPatchGap + (approach > 0 ? approach : 0);
}

// Finds the contacts of two boxes or cylinders that stand upright in the frame of the engine, side by side. Works as
// Collide (collide.h). Returns -1 for other pairs, also for one body on top of the other.
int CollideUprightPrisms(dGeomID a, dGeomID b, const Vector3& way, std::span<dContactGeom> contacts);

}  // namespace swarmanoid::dynamics3d

// Contacts of boxes and cylinders with planes. A body that lies flat gets all points of its face, so that it does not
// rock. ODE's own routines leave out the points that are not in the plane yet.
#pragma once

#include <ode/ode.h>

#include <span>

#include "common/math/pose.h"

namespace swarmanoid::dynamics3d
{

// These functions work as Collide (collide.h).
int CollideBoxWithPlane(dGeomID box, dGeomID plane, const Vector3& way, std::span<dContactGeom> contacts);
int CollideCylinderWithPlane(dGeomID cylinder, dGeomID plane, const Vector3& way, std::span<dContactGeom> contacts);

}  // namespace swarmanoid::dynamics3d

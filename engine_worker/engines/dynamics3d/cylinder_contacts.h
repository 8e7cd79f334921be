// Contacts of two cylinders side by side that lean too much for upright_contacts.h. ODE leaves two
// cylinders to a general convex algorithm that gives one contact at an arbitrary height, which tips robots over.
#pragma once

#include <ode/ode.h>

#include <span>

#include "common/math/pose.h"

namespace swarmanoid::dynamics3d
{

// Fills up to two contacts at the ends of the common height, if the axes are parallel within 20 degrees. Works as
// Collide (collide.h). Returns -1 for cylinders in other positions (also one above the other), which ODE must handle.
int CollideParallelCylinders(dGeomID a, dGeomID b, const Vector3& way, std::span<dContactGeom> contacts);

}  // namespace swarmanoid::dynamics3d

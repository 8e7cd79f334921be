// Contacts of two cylinders that stand side by side, such as the bodies of two robots. ODE leaves this pair to a
// general convex algorithm that gives one contact at an arbitrary height, which tips robots over.
#pragma once

#include <ode/ode.h>

#include <span>

namespace swarmanoid::dynamics3d
{

// Finds contacts of two cylinders that stand side by side, such as the bodies of two robots. ODE's general convex
// algorithm would give one contact at an arbitrary height, which tips robots over. Fills up to two contacts at the ends
// of the common height, if the axes are parallel within 20 degrees. Returns their number, or -1 for cylinders in other
// positions (also one above the other), which ODE must handle.
int CollideParallelCylinders(dGeomID a, dGeomID b, std::span<dContactGeom> contacts);

// Contacts of a cylinder with a plane: where its rims are deepest, and four points of a rim that lies flat. Returns
// their number. ODE's own routine leaves a cylinder that stands upright with one contact at times, and it wanders off.
int CollideCylinderWithPlane(dGeomID cylinder, dGeomID plane, std::span<dContactGeom> contacts);

}  // namespace swarmanoid::dynamics3d

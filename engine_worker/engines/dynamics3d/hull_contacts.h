// Contacts of a convex hull (a geom of HullShape, whose Solid knows it) with planes, boxes, cylinders, spheres,
// capsules, rays and other hulls.
//
// Two bodies with flat faces are separated by the axis of least overlap among the normals of their faces and the
// products of their edges (S. Gottschalk, M. C. Lin, D. Manocha, "OBBTree", 1996). Edges that make no face of the
// Minkowski difference are left out (D. Gregorius, "The separating axis test between convex polyhedra", GDC 2013). If a
// face decides, the other body's face is clipped to it. So a body on something flat rests on all its corners.
#pragma once

#include <ode/ode.h>

#include <span>

#include "common/math/pose.h"

namespace swarmanoid::dynamics3d
{

bool HullMeets(int geom_class);
// Works as Collide (collide.h) for a geom of a class that HullMeets. `contacts` must not be empty.
int CollideHull(dGeomID hull, dGeomID other, const Vector3& way, std::span<dContactGeom> contacts);

}  // namespace swarmanoid::dynamics3d

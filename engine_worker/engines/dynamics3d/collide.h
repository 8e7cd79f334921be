// Collide: the contacts of two geoms. ODE's dCollide finds most of them. Our own code handles the pairs that must rest
// on several points at once: convex hulls with all but terrain, boxes and cylinders side by side or on planes,
// parallel cylinders.
#pragma once

#include <ode/ode.h>

#include <memory>
#include <span>
#include <vector>

#include "common/mesh/convex_hull.h"

namespace swarmanoid::dynamics3d
{

// A hull in ODE's form, about its centre of mass. The Solid of each geom made from it must keep it alive.
class HullShape
{
public:
  explicit HullShape(const ConvexHull& hull);
  HullShape(const HullShape&) = delete;
  HullShape& operator=(const HullShape&) = delete;

  const ConvexHull& Hull() const { return hull_; }   // in the frame of its geoms
  const Vector3& Centre() const { return centre_; }  // their origin, in the frame of the hull that was given
  dGeomID MakeGeom() const;                          // in no space

private:
  ConvexHull hull_;
  Vector3 centre_;
  std::vector<dReal> corners_;
  std::vector<dReal> planes_;
  std::vector<unsigned> faces_;
};

// Returns a contact of two geoms. `normal` points into the first one. `depth` in m.
inline dContactGeom ContactAt(const Vector3& point, const Vector3& normal, double depth, dGeomID first, dGeomID second)
{
  dContactGeom contact{};
  for (int k = 0; k < 3; ++k)
  {
    contact.pos[k] = point[k];
    contact.normal[k] = normal[k];
  }
  contact.depth = depth;
  contact.g1 = first;
  contact.g2 = second;
  contact.side1 = contact.side2 = -1;
  return contact;
}

// Works as dCollide: returns the number of contacts, at most the size of `contacts`. Normals point into the first geom.
// `way` is how far (m) the first geom moves against the second one within the step. Bodies that touch also get those
// points of their contact that do not touch yet, with a depth of 0 or less, if the gap there is narrower (PatchGap).
int Collide(dGeomID first, dGeomID second, std::span<dContactGeom> contacts, const Vector3& way = Vector3::Zero());

}  // namespace swarmanoid::dynamics3d

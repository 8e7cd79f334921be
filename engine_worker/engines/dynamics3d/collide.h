// Collide: the contacts of two geoms. ODE's dCollide finds most of them. Our own code handles the pairs that must rest
// on several points at once: convex hulls with all but terrain, parallel cylinders, cylinders on planes.
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

// Works as dCollide: returns the number of contacts, at most the size of `contacts`. Normals point into the first geom.
int Collide(dGeomID first, dGeomID second, std::span<dContactGeom> contacts);

}  // namespace swarmanoid::dynamics3d

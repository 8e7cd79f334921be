// Where two geoms touch: ODE's dCollide, and our own code where a body is to come to rest on several points at once:
// convex hulls with all but terrain, parallel cylinders, cylinders on planes.
#pragma once

#include <ode/ode.h>

#include <memory>
#include <span>
#include <vector>

#include "common/mesh/convex_hull.h"

namespace swarmanoid::dynamics3d
{

// A hull as ODE wants it, about its centre of mass; for the geoms made from it, whose Solid keeps it.
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

// As dCollide: the number of contacts, whose normals point into the first geom; at most as many as there is room for.
int Collide(dGeomID first, dGeomID second, std::span<dContactGeom> contacts);

}  // namespace swarmanoid::dynamics3d

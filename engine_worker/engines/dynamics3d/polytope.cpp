#include "engine_worker/engines/dynamics3d/polytope.h"

#include <cmath>

#include "common/math/elementary.h"

namespace swarmanoid::dynamics3d
{
namespace
{

// Returns the box from -1 to 1 on each axis.
const ConvexHull& UnitBox()
{
  static const ConvexHull box = []
  {
    std::vector<Vector3> corners;
    for (unsigned k = 0; k < 8; ++k)
      corners.emplace_back((k & 1) != 0 ? 1 : -1, (k & 2) != 0 ? 1 : -1, (k & 4) != 0 ? 1 : -1);
    return HullOf(corners);
  }();
  return box;
}

// Returns the prism around the cylinder of radius 1 from z = -1 to 1, with a side towards x.
const ConvexHull& UnitPrism()
{
  static const ConvexHull prism = []
  {
    constexpr double kHalfSide = kPi / kPrismSides;
    const double radius = 1 / SinCosOf(kHalfSide).cos;
    std::vector<Vector3> corners;
    for (std::size_t k = 0; k < kPrismSides; ++k)
    {
      const SinCos angle = SinCosOf(kHalfSide * (2 * static_cast<double>(k) + 1));
      for (const double z : {-1.0, 1.0}) corners.emplace_back(radius * angle.cos, radius * angle.sin, z);
    }
    return HullOf(corners);
  }();
  return prism;
}

Vector3 PositionOf(dGeomID geom)
{
  const dReal* p = dGeomGetPosition(geom);
  return {p[0], p[1], p[2]};
}

}  // namespace

Eigen::Matrix3d AxesOf(dGeomID geom)
{
  const dReal* r = dGeomGetRotation(geom);
  Eigen::Matrix3d axes;
  axes << r[0], r[1], r[2], r[4], r[5], r[6], r[8], r[9], r[10];
  return axes;
}

void Polytope::SetHull(const ConvexHull& hull, dGeomID geom)
{
  Place(hull, Vector3::Ones(), AxesOf(geom), PositionOf(geom));
}

void Polytope::SetBox(dGeomID box)
{
  dVector3 sides;
  dGeomBoxGetLengths(box, sides);
  Place(UnitBox(), Vector3(sides[0], sides[1], sides[2]) / 2, AxesOf(box), PositionOf(box));
}

void Polytope::SetCylinder(dGeomID cylinder, const Vector3& towards)
{
  dReal radius = 0;
  dReal length = 0;
  dGeomCylinderGetParams(cylinder, &radius, &length);
  Eigen::Matrix3d axes = AxesOf(cylinder);
  const Vector3 axis = axes.col(2);
  const Vector3 across = towards - axis * axis.dot(towards);
  const double distance = std::sqrt(across.squaredNorm());
  if (distance > 1e-9)
  {
    axes.col(0) = across / distance;
    axes.col(1) = axis.cross(axes.col(0));
  }
  Place(UnitPrism(), Vector3(radius, radius, length / 2), axes, PositionOf(cylinder));
}

// Scales that are unequal turn the normals of no box and of no prism.
void Polytope::Place(const ConvexHull& shape, const Vector3& scale, const Eigen::Matrix3d& axes, const Vector3& origin)
{
  topology_ = &shape;
  corners_.clear();
  normals_.clear();
  distances_.clear();
  for (const Vector3& corner : shape.corners) corners_.emplace_back(origin + axes * corner.cwiseProduct(scale));
  for (const ConvexHull::Face& face : shape.faces)
  {
    const Vector3 normal = axes * face.normal;
    normals_.push_back(normal);
    double farthest = normal.dot(corners_[face.corners[0]]);
    for (const std::uint32_t corner : face.corners) farthest = std::max(farthest, normal.dot(corners_[corner]));
    distances_.push_back(farthest);
  }
  centre_ = origin + axes * shape.centre.cwiseProduct(scale);
}

double Polytope::Reach(const Vector3& direction, std::size_t& corner) const
{
  corner = 0;
  double farthest = direction.dot(corners_[0]);
  for (std::size_t k = 1; k < corners_.size(); ++k)
  {
    const double here = direction.dot(corners_[k]);
    if (here <= farthest) continue;
    farthest = here;
    corner = k;
  }
  return farthest;
}

std::size_t Polytope::FaceAgainst(const Vector3& direction) const
{
  std::size_t face = 0;
  for (std::size_t k = 1; k < normals_.size(); ++k)
    if (direction.dot(normals_[k]) < direction.dot(normals_[face])) face = k;
  return face;
}

}  // namespace swarmanoid::dynamics3d

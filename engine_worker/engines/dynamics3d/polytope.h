// Polytope: a body with flat faces at its place in the frame of the engine, for hull_contacts.cpp. Its memory is used
// again and again.
#pragma once

#include <ode/ode.h>

#include "common/mesh/convex_hull.h"

namespace swarmanoid::dynamics3d
{

class Polytope
{
public:
  void SetHull(const ConvexHull& hull, dGeomID geom);
  void SetBox(dGeomID box);
  // Becomes a prism around a cylinder. The middle of each side touches the cylinder, and one side faces `towards`.
  void SetCylinder(dGeomID cylinder, const Vector3& towards);

  const std::vector<Vector3>& Corners() const { return corners_; }
  const std::vector<Vector3>& Normals() const { return normals_; }
  const ConvexHull& Topology() const { return *topology_; }
  const Vector3& Centre() const { return centre_; }
  // Returns the distance of the plane of a face from the origin, along the face's normal.
  double Distance(std::size_t face) const { return distances_[face]; }
  // The farthest distance of a corner along a direction, and which corner it is.
  double Reach(const Vector3& direction, std::size_t& corner) const;
  // Returns the face whose normal is most opposite to a direction.
  std::size_t FaceAgainst(const Vector3& direction) const;

private:
  void Place(const ConvexHull& shape, const Vector3& scale, const Eigen::Matrix3d& axes, const Vector3& origin);

  const ConvexHull* topology_ = nullptr;
  std::vector<Vector3> corners_;
  std::vector<Vector3> normals_;
  std::vector<double> distances_;
  Vector3 centre_ = Vector3::Zero();
};

inline constexpr std::size_t kPrismSides = 16;

// Returns the rotation of a geom.
Eigen::Matrix3d AxesOf(dGeomID geom);

}  // namespace swarmanoid::dynamics3d

// Computes the convex hull of points, with its mass properties. An entity that collides as a mesh has such a body.
// Every process makes it while the experiment is read, with the same bits.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

#include "common/math/pose.h"

namespace swarmanoid
{

inline constexpr std::size_t kMostHullCorners = 64;  // larger hulls are replaced by simpler ones inside them

struct ConvexHull
{
  struct Face
  {
    std::vector<std::uint32_t> corners;  // three or more, counter-clockwise as seen from outside
    Vector3 normal;                      // outwards, of length 1
    double distance = 0;                 // m, from the origin along the normal: no corner is farther out
  };
  struct Edge
  {
    std::array<std::uint32_t, 2> corners;
    std::array<std::uint32_t, 2> faces;
  };

  std::vector<Vector3> corners;  // m
  std::vector<Face> faces;
  std::vector<Edge> edges;
  double volume = 0;                                  // m³
  Vector3 centre = Vector3::Zero();                   // the centre of mass at even density
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  // about the centre, at 1 kg/m³: kg m²

  // Returns how deep a point is below the nearest face, in m; negative outside.
  double DepthOf(const Vector3& point) const;
};

// Returns the hull. Faces that are even to a hundred-thousandth of the size are merged by the library qhull (C. B.
// Barber, D. P. Dobkin, H. Huhdanpaa, "The Quickhull algorithm for convex hulls", 1996). Volume, centre and inertia are
// exact integrals over the tetrahedra between the faces and a point (D. Eberly, "Polyhedral mass properties", 2002).
// The covariance of a tetrahedron is from J. Blow and A. J. Binstock, "How to find the inertia tensor of a 3D solid
// body represented by a triangle mesh", 2004. Throws std::invalid_argument with the mistake for too few points, points
// in one plane, or points that are not finite.
ConvexHull HullOf(std::span<const Vector3> points);

}  // namespace swarmanoid

// Contacts of two upright prisms that stand side by side: boxes and cylinders on a common floor.
#pragma once

#include <ode/ode.h>

#include <array>
#include <cstddef>
#include <optional>
#include <span>

#include "common/math/pose.h"

namespace swarmanoid::dynamics3d
{

// A point of a patch belongs to a contact if its gap is at most this wide (m), or if the gap closes within the step.
// Bodies at rest on a floor lean by less.
inline constexpr double kPatchGap = 1e-4;
// Bodies within 0.5 degrees count as upright, and faces as flat.
inline constexpr double kFlatCosine = 0.99996;

// Returns the widest gap (m) of a point that belongs to a contact with this normal, which points into the first body.
// `way` is how far the first body moves against the second one within the step.
inline double PatchGap(const Vector3& normal, const Vector3& way)
{
  const double approach = -normal.dot(way);
  return kPatchGap + (approach > 0 ? approach : 0);
}

// A prism that stands upright: its outline in the plane, and its height.
struct Prism
{
  using Corners = std::array<Vector2, 4>;  // counterclockwise

  Vector2 centre = Vector2::Zero();  // of the outline, at the height that AtHeight set
  double middle = 0;                 // m, height of the body's centre
  double half_height = 0;
  Vector2 slope = Vector2::Zero();                             // how far the outline moves per metre of height
  double radius = 0;                                           // 0: a box
  Vector2 half_x = Vector2::Zero(), half_y = Vector2::Zero();  // of a box, from its centre to the middles of two sides

  void AtHeight(double height) { centre += slope * (height - middle); }
  Corners CornersOfBox() const
  {
    return {centre - half_x - half_y, centre + half_x - half_y, centre + half_x + half_y, centre - half_x + half_y};
  }
};

// Returns nothing for a geom that is no box or cylinder within 0.5 degrees of upright.
std::optional<Prism> PrismOf(dGeomID geom);

struct PlanePoint
{
  Vector2 point = Vector2::Zero();
  double depth = 0;  // m; negative: a gap
};

// Where two outlines meet. The normal points into the first one.
struct PlaneContact
{
  Vector2 normal = Vector2::Zero();
  std::array<PlanePoint, 2> points;
  std::size_t count = 0;
};

// Returns where two outlines meet, or are nearest to each other; no points if the middles of two circles are one.
PlaneContact Meet(const Prism& a, const Prism& b);

// Finds the contacts of two boxes or cylinders that stand upright in the frame of the engine, side by side. Works as
// Collide (collide.h). Returns -1 for other pairs, also for one body on top of the other.
int CollideUprightPrisms(dGeomID a, dGeomID b, const Vector3& way, std::span<dContactGeom> contacts);

}  // namespace swarmanoid::dynamics3d

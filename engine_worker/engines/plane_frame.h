// PlaneFrame: where the plane of a two-dimensional engine lies in the space. Maps poses both ways and cuts boxes. Used
// by kinematics2d and dynamics2d, in their engine's process.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "common/configuration/parameter.h"
#include "common/math/pose.h"
#include "common/space/entity.h"

namespace swarmanoid
{

enum class PlaneAxis
{
  kX,
  kY,
  kZ
};

// A pose within the plane: metres along its axes u and v, radians from u towards v.
struct PlanePose
{
  double u = 0;
  double v = 0;
  double heading = 0;
};

// The part of a space pose that a plane pose lacks: the signed distance from the plane (m), and the lean, which is
// applied before the heading. Both are zero and identity for an entity that stands upright on the plane.
struct PlaneStance
{
  double height = 0;
  Quaternion lean = Quaternion::Identity();
};

inline constexpr std::size_t kMostCutCorners = 8;  // of a polygon that the engines of planes collide

class PlaneFrame
{
public:
  // Returns the plane perpendicular to an axis, at a signed distance (m) from the origin. Its axes (u, v, normal) are,
  // right-handed: z: (x, y, z), x: (y, z, x), y: (z, x, y).
  PlaneFrame(PlaneAxis axis, double distance);
  // Makes any plane from a frame: the frame's x and y are u and v, and its z is the normal.
  explicit PlaneFrame(const Pose& frame) : frame_(frame), inverse_(frame.Inverse()) {}

  const Pose& Frame() const { return frame_; }

  PlanePose ToPlane(const Pose& pose) const;
  PlaneStance StanceOf(const Pose& pose) const;
  // ToSpace(ToPlane(p), StanceOf(p)) is p, but for rounding.
  Pose ToSpace(const PlanePose& pose, const PlaneStance& stance = {}) const;

  // Returns the convex polygon, counter-clockwise in (u, v), in which the plane cuts a box with edges `size` about the
  // centre `pose`; empty if it does not. A box that only rests on the plane is cut by it too.
  std::vector<Vector2> CutBox(const Pose& pose, const Vector3& size) const;
  // Returns the cut of the plane with the box or the hull of an entity with its origin at `pose`. For a hull it is a
  // polygon within the cut, with at most kMostCutCorners corners.
  std::vector<Vector2> CutBody(const CSwarmanoidSpaceEntity& entity, const Pose& pose) const;
  // Returns true if the plane cuts the upright cylinder or robot that is `height` metres high and has its base at
  // `pose`.
  bool CutsUpright(const Pose& pose, double height) const;

private:
  std::vector<Vector2> Cut(const Pose& pose, std::span<const Vector3> corners,
                           std::span<const std::array<std::uint32_t, 2>> edges) const;

  Pose frame_;
  Pose inverse_;
};

// Returns the plane that the parameters describe. They are the same for all two-dimensional engines (PlaneParameters,
// common/plugin_descriptions).
PlaneFrame PlaneFrom(const Parameters& parameters);

}  // namespace swarmanoid

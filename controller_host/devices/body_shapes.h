// The bodies that sensors see: upright cylinders and boxes in the frame of their entity, and exact rays and segments
// against them. Used by all generic sensors of a controller host.
#pragma once

#include <limits>
#include <vector>

#include "common/space/space.h"

namespace swarmanoid
{

inline constexpr double kNoHit = std::numeric_limits<double>::infinity();

// A solid in the frame of its entity: a cylinder around the z axis or a box, from `low` to `high` along z.
struct BodyShape
{
  enum class Kind : std::uint8_t
  {
    kNone,  // lights, sounds, patches: nothing to bump into
    kCylinder,
    kBox
  };

  Kind kind = Kind::kNone;
  double radius = 0;  // m: of the cylinder, or of the circle around the box in its xy plane
  double half_x = 0;  // m, boxes
  double half_y = 0;
  double low = 0;  // m
  double high = 0;

  // The distance (in units of `direction`) at which a ray that starts at `origin` enters the body, both in its frame; 0
  // from inside. kNoHit beyond `limit`.
  double RayHit(const Vector3& origin, const Vector3& direction, double limit) const;
  // Radius of the sphere around the point (0, 0, (low + high) / 2).
  double SphereRadius() const;
};

BodyShape ShapeOf(const CSwarmanoidSpaceEntity& entity);
// Of all entities of a space, in entity order.
std::vector<BodyShape> ShapesOf(const CSwarmanoidSpace& space);

// Rotation about z alone: the plane through the body's axes stays horizontal.
inline bool IsUpright(const PoseArrays& poses, std::size_t entity)
{
  return poses.qx[entity] == 0 && poses.qy[entity] == 0;
}

// Cosine and sine of the heading of an upright entity.
struct Heading
{
  double cos;
  double sin;
};
inline Heading HeadingOf(const PoseArrays& poses, std::size_t entity)
{
  const double z = poses.qz[entity];
  const double w = poses.qw[entity];
  return {w * w - z * z, 2 * w * z};
}

}  // namespace swarmanoid

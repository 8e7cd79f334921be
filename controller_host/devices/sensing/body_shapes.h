// The bodies that sensors see: the simple shapes of common/space/shape.h with what sensors ask of them again and again.
#pragma once

#include <vector>

#include "common/space/shape.h"
#include "common/space/space.h"

namespace swarmanoid
{

struct BodyShape : Shape
{
  double radius = 0;  // m: of the cylinder, or of the circle around the box in its xy plane
  double low = 0;     // m: extent along z in the frame of the entity
  double high = 0;
};

// The same in short, for searches over many bodies.
struct BodyExtent
{
  float radius = 0;
  float low = 0;
  float high = 0;
  Shape::Kind kind = Shape::Kind::kNone;
};

BodyShape BodyShapeOf(const EntityConfiguration& entity);
// Of all entities of a space, in entity order.
std::vector<BodyShape> BodiesOf(const CSwarmanoidSpace& space);

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

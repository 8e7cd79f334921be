// The bodies that sensors see: the simple shapes of common/space/shape.h with what sensors ask of them again and again.
#pragma once

#include <vector>

#include "common/experiment/experiment.h"
#include "common/space/pose_arrays.h"
#include "common/space/shape.h"

namespace swarmanoid
{

class CSwarmanoidSpace;

// A body in short, for searches over many.
struct BodyExtent
{
  float radius = 0;
  float low = 0;
  float high = 0;
  Shape::Kind kind = Shape::Kind::kNone;
};

struct BodyShape : Shape
{
  double radius = 0;  // m: of the cylinder, or of the circle around the box in its xy plane
  double low = 0;     // m: extent along z in the frame of the entity
  double high = 0;
  BodyExtent extent{};

  void FindExtent();  // of what it is now
};

BodyShape BodyShapeOf(const EntityConfiguration& entity);

// The bodies of all entities of a space, in entity order. Equal bodies are stored once, so that those of a swarm stay
// in the cache.
class BodyShapes
{
public:
  explicit BodyShapes(const CSwarmanoidSpace& space);

  const BodyShape& operator[](std::size_t entity) const { return shapes_[shape_of_[entity]]; }
  // Gives an entity a body that no other has, which may be changed by the result.
  BodyShape& MakeOwn(std::size_t entity);
  BodyShape& OwnOf(std::size_t entity) { return shapes_[shape_of_[entity]]; }

private:
  std::vector<BodyShape> shapes_;
  std::vector<std::uint32_t> shape_of_;  // of each entity
};

// Returns true if the rotation is about z alone, so that the plane through the body's axes stays horizontal.
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

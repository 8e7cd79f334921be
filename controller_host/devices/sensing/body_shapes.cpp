#include "controller_host/devices/sensing/body_shapes.h"

namespace swarmanoid
{

BodyShape BodyShapeOf(const EntityConfiguration& entity)
{
  BodyShape body{ShapeOf(entity)};
  const Vector3& half = body.half_size;
  body.radius = body.kind == Shape::Kind::kBox ? __builtin_sqrt(half.x() * half.x() + half.y() * half.y()) : half.x();
  body.low = body.centre.z() - half.z();
  body.high = body.centre.z() + half.z();
  return body;
}

std::vector<BodyShape> BodiesOf(const CSwarmanoidSpace& space)
{
  std::vector<BodyShape> bodies;
  for (const EntityConfiguration& entity : space.GetExperiment().entities) bodies.push_back(BodyShapeOf(entity));
  return bodies;
}

}  // namespace swarmanoid

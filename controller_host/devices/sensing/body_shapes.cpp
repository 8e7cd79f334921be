#include "controller_host/devices/sensing/body_shapes.h"

#include <array>
#include <map>
#include <utility>
#include "common/space/space.h"

namespace swarmanoid
{

BodyShape BodyShapeOf(const EntityConfiguration& entity)
{
  BodyShape body{ShapeOf(entity)};
  const Vector3& half = body.half_size;
  body.radius = body.kind == Shape::Kind::kBox ? __builtin_sqrt(half.x() * half.x() + half.y() * half.y()) : half.x();
  body.low = body.centre.z() - half.z();
  body.high = body.centre.z() + half.z();
  body.FindExtent();
  return body;
}

void BodyShape::FindExtent()
{
  extent = {static_cast<float>(radius), static_cast<float>(low), static_cast<float>(high), kind};
}

BodyShapes::BodyShapes(const CSwarmanoidSpace& space)
{
  // All that bodies differ by.
  using Measures = std::pair<Shape::Kind, std::array<double, 6>>;
  std::map<Measures, std::uint32_t> known;
  for (const EntityConfiguration& entity : space.GetExperiment().entities)
  {
    const BodyShape body = BodyShapeOf(entity);
    const Vector3& centre = body.centre;
    const Vector3& half = body.half_size;
    const auto [found, is_new] =
        known.try_emplace({body.kind, {centre.x(), centre.y(), centre.z(), half.x(), half.y(), half.z()}},
                          static_cast<std::uint32_t>(shapes_.size()));
    if (is_new) shapes_.push_back(body);
    shape_of_.push_back(found->second);
  }
}

BodyShape& BodyShapes::MakeOwn(std::size_t entity)
{
  shapes_.push_back((*this)[entity]);
  shape_of_[entity] = static_cast<std::uint32_t>(shapes_.size() - 1);
  return shapes_.back();
}

}  // namespace swarmanoid

// The simple body of an entity for queries: an upright cylinder or a box in the entity's frame. Sensors, occlusion and
// renderers use it; the engines have their own collision models.
#pragma once

#include <optional>

#include "common/experiment/experiment.h"
#include "common/math/pose.h"

namespace swarmanoid
{

struct Shape
{
  enum class Kind
  {
    kNone,      // for lights and patches: no body
    kCylinder,  // radius and half height about the z axis
    kBox
  };

  Kind kind = Kind::kNone;
  Vector3 centre = Vector3::Zero();     // in the entity's frame, metres
  Vector3 half_size = Vector3::Zero();  // cylinder: radius, radius, half height
};

Shape ShapeOf(const EntityConfiguration& configuration);
// Returns the radius (m) of the sphere about the shape's centre that contains the shape.
double BoundingRadius(const Shape& shape);

// Returns the fraction 0..1 of the way from `from` to `to` (space coordinates) at which the segment enters the shape; 0
// if it starts inside, nullopt if it misses. Exact up to rounding.
std::optional<double> SegmentHit(const Shape& shape, const Pose& pose, const Vector3& from, const Vector3& to);

}  // namespace swarmanoid

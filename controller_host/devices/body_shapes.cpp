#include "controller_host/devices/body_shapes.h"

#include <algorithm>

namespace swarmanoid
{
namespace
{

// The part of a ray that lies within a convex body.
struct Interval
{
  double enter = 0;
  double leave = 0;

  void Clip(double enter_here, double leave_here)
  {
    enter = std::max(enter, enter_here);
    leave = std::min(leave, leave_here);
  }
  void ClipSlab(double origin, double direction, double low, double high)
  {
    if (direction == 0)
    {
      if (origin < low || origin > high) leave = -1;
      return;
    }
    const double a = (low - origin) / direction;
    const double b = (high - origin) / direction;
    Clip(std::min(a, b), std::max(a, b));
  }
};

}  // namespace

double BodyShape::RayHit(const Vector3& origin, const Vector3& direction, double limit) const
{
  if (kind == Kind::kNone) return kNoHit;
  Interval inside{0, limit};
  inside.ClipSlab(origin.z(), direction.z(), low, high);
  if (kind == Kind::kBox)
  {
    inside.ClipSlab(origin.x(), direction.x(), -half_x, half_x);
    inside.ClipSlab(origin.y(), direction.y(), -half_y, half_y);
  }
  else
  {
    const double a = direction.x() * direction.x() + direction.y() * direction.y();
    const double b = origin.x() * direction.x() + origin.y() * direction.y();
    const double c = origin.x() * origin.x() + origin.y() * origin.y() - radius * radius;
    if (a == 0)
    {
      if (c > 0) return kNoHit;
    }
    else
    {
      const double discriminant = b * b - a * c;
      if (discriminant < 0) return kNoHit;
      const double root = __builtin_sqrt(discriminant);
      inside.Clip((-b - root) / a, (-b + root) / a);
    }
  }
  return inside.enter <= inside.leave ? inside.enter : kNoHit;
}

double BodyShape::SphereRadius() const
{
  const double half_height = (high - low) / 2;
  return __builtin_sqrt(radius * radius + half_height * half_height);
}

BodyShape ShapeOf(const CSwarmanoidSpaceEntity& entity)
{
  const Vector3& size = entity.GetSize();
  BodyShape shape;
  switch (entity.GetKind())
  {
    case EntityKind::kFootbot:
    case EntityKind::kEyebot:
    case EntityKind::kCylindricPrey:
      shape.kind = BodyShape::Kind::kCylinder;
      shape.radius = size.x();
      shape.high = size.z();
      break;
    case EntityKind::kHandbot:
    case EntityKind::kBlock:
    case EntityKind::kWall:
    {
      const bool around_centre = entity.GetKind() != EntityKind::kHandbot;
      shape.kind = BodyShape::Kind::kBox;
      shape.half_x = size.x() / 2;
      shape.half_y = size.y() / 2;
      shape.radius = __builtin_sqrt(shape.half_x * shape.half_x + shape.half_y * shape.half_y);
      shape.low = around_centre ? -size.z() / 2 : 0;
      shape.high = around_centre ? size.z() / 2 : size.z();
      break;
    }
    default:
      break;
  }
  return shape;
}

std::vector<BodyShape> ShapesOf(const CSwarmanoidSpace& space)
{
  std::vector<BodyShape> shapes;
  shapes.reserve(space.Size());
  for (std::size_t e = 0; e < space.Size(); ++e) shapes.push_back(ShapeOf(space.GetEntity(e)));
  return shapes;
}

}  // namespace swarmanoid

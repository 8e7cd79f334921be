// A segment hits an upright cylinder or a box where the part inside all its bounds begins. Each bound shortens the
// segment from both ends: pairs of parallel planes by the slab method (T. L. Kay and J. T. Kajiya, "Ray tracing complex
// scenes", SIGGRAPH 1986), and a circle by the roots of its quadratic equation.
//
// Invariant: a segment that begins inside a body hits it at 0.
#include "common/space/shape.h"

#include <algorithm>
#include <cmath>

namespace swarmanoid
{
namespace
{

// Shortens a segment to the part between two bounds on one axis. Returns false if no part is left.
bool ClipSlab(double start, double step, double low, double high, double& enter, double& leave)
{
  if (step == 0) return start >= low && start <= high;
  double first = (low - start) / step;
  double last = (high - start) / step;
  if (first > last) std::swap(first, last);
  enter = std::max(enter, first);
  leave = std::min(leave, last);
  return enter <= leave;
}

// Shortens a segment to the part inside the circle about the z axis.
bool ClipCircle(const Vector3& start, const Vector3& step, double radius, double& enter, double& leave)
{
  const double a = step.x() * step.x() + step.y() * step.y();
  const double b = start.x() * step.x() + start.y() * step.y();
  const double c = start.x() * start.x() + start.y() * start.y() - radius * radius;
  if (a == 0) return c <= 0;
  const double discriminant = b * b - a * c;
  if (discriminant < 0) return false;
  const double root = std::sqrt(discriminant);
  enter = std::max(enter, (-b - root) / a);
  leave = std::min(leave, (-b + root) / a);
  return enter <= leave;
}

}  // namespace

Shape ShapeOf(const EntityConfiguration& configuration)
{
  const EntityKindDescription& kind = DescriptionOf(configuration.kind);
  const Vector3& size = configuration.size;
  const Vector3 centre = kind.origin == BodyOrigin::kBase ? Vector3(0, 0, size.z() / 2) : Vector3::Zero();
  switch (kind.form)
  {
    case BodyForm::kCylinder:
      return {Shape::Kind::kCylinder, centre, {size.x(), size.x(), size.z() / 2}};
    case BodyForm::kBox:
      return {Shape::Kind::kBox, centre, size / 2};
    case BodyForm::kNone:
      break;
  }
  return {};
}

double BoundingRadius(const Shape& shape)
{
  if (shape.kind == Shape::Kind::kCylinder)
    return std::sqrt(shape.half_size.x() * shape.half_size.x() + shape.half_size.z() * shape.half_size.z());
  return shape.half_size.norm();
}

std::optional<double> SegmentHit(const Shape& shape, const Pose& pose, const Vector3& from, const Vector3& to)
{
  if (shape.kind == Shape::Kind::kNone) return std::nullopt;
  const Quaternion inverse = pose.orientation.conjugate();
  const Vector3 start = inverse * (from - pose.position) - shape.centre;
  const Vector3 step = inverse * (to - from);
  double enter = 0;
  double leave = 1;
  const Vector3& half = shape.half_size;
  if (!ClipSlab(start.z(), step.z(), -half.z(), half.z(), enter, leave)) return std::nullopt;
  const bool hit = shape.kind == Shape::Kind::kCylinder
                       ? ClipCircle(start, step, half.x(), enter, leave)
                       : ClipSlab(start.x(), step.x(), -half.x(), half.x(), enter, leave) &&
                             ClipSlab(start.y(), step.y(), -half.y(), half.y(), enter, leave);
  if (!hit) return std::nullopt;
  return enter;
}

}  // namespace swarmanoid

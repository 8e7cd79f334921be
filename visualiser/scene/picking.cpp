// A click is a ray from the eye, and the nearest body that it hits is chosen. Robots are a little larger for this than
// they are, since they are small on the screen. A wall between the eye and the middle of the arena is drawn low or cut
// off, so that it hides nothing; such a wall must not catch clicks either. The same rules decide both, so all windows
// agree on what is behind a wall.
#include "visualiser/scene/picking.h"

#include <algorithm>

#include "common/space/shape.h"
#include "common/space/space.h"

namespace swarmanoid
{
namespace
{

constexpr double kFarthest = 1e4;      // m
constexpr double kRobotMargin = 0.01;  // m
constexpr double kTall = 0.25;         // m: lower walls hide nothing …
constexpr double kTallPart = 0.08;     // … or in a small arena, lower than this part of its size
// The height that stays solid of a wall that hides the arena, and of other walls, m.
constexpr float kKerb = 0.04F;
constexpr float kCutHeight = 0.35F;
constexpr float kCutPart = 0.07F;  // relative to the arena's size, if that is more

}  // namespace

bool IsBoundaryWall(const EntityConfiguration& entity, const Vector3& arena_size)
{
  if (!IsFreeBox(entity.kind)) return false;
  if (entity.movable || entity.size.z() < std::min(kTall, kTallPart * arena_size.head<2>().maxCoeff())) return false;
  const double thickness = std::min(entity.size.x(), entity.size.y());
  const double length = std::max(entity.size.x(), entity.size.y());
  if (length < 4 * thickness) return false;
  // The wall must be near a side of the arena: within half a thickness and 2 % of the arena's size.
  const Vector3& at = entity.pose.position;
  const auto near_side = [&](double place, double size)
  { return std::min(std::abs(place), std::abs(size - place)) <= thickness / 2 + 0.02 * size; };
  return near_side(at.x(), arena_size.x()) || near_side(at.y(), arena_size.y());
}

bool HidesArena(const EntityConfiguration& wall, const Vector3& arena_size, const Vector3& eye)
{
  const Vector3 along = wall.pose.orientation * (wall.size.x() < wall.size.y() ? Vector3::UnitX() : Vector3::UnitY());
  const double inside = (arena_size / 2 - wall.pose.position).dot(along);
  const double outside = (eye - wall.pose.position).dot(along);
  return inside * outside < 0;
}

float SolidHeight(const EntityConfiguration& wall, const Vector3& arena_size, const Vector3& eye)
{
  if (HidesArena(wall, arena_size, eye)) return kKerb;
  return std::max(kCutHeight, kCutPart * static_cast<float>(arena_size.head<2>().maxCoeff()));
}

std::optional<Pick> PickEntity(const CSwarmanoidSpace& space, const Ray& ray)
{
  const Vector3& arena = space.GetExperiment().arena_size;
  const Vector3 end = ray.origin + kFarthest * ray.direction;
  std::optional<Pick> pick;
  double nearest = 2;
  for (std::size_t e = 0; e < space.Size(); ++e)
  {
    const EntityConfiguration& configuration = space.GetEntity(e).GetConfiguration();
    Shape shape = ShapeOf(configuration);
    if (shape.kind == Shape::Kind::kNone) continue;
    if (IsRobot(configuration.kind)) shape.half_size += Vector3::Constant(kRobotMargin);
    if (IsBoundaryWall(configuration, arena) && HidesArena(configuration, arena, ray.origin)) continue;
    const std::optional<double> hit = SegmentHit(shape, space.GetPose(e), ray.origin, end);
    if (!hit || *hit >= nearest) continue;
    nearest = *hit;
    pick = Pick{static_cast<std::uint32_t>(e), ray.origin + *hit * (end - ray.origin)};
  }
  return pick;
}

}  // namespace swarmanoid

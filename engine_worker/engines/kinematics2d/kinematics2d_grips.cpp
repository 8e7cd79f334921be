// Grippers of the kinematic engine: which object a gripper takes, and when it lets go. gripped_groups.h moves those
// that hold one another.
#include <algorithm>
#include <cmath>
#include <limits>

#include "common/math/elementary.h"
#include "common/space/space.h"
#include "engine_worker/engines/kinematics2d/kinematics2d_engine.h"

namespace swarmanoid
{
namespace
{

using namespace kinematics2d;

// A gripper closes at half of its way, and holds what its front is this near to (metres).
constexpr double kGripThreshold = 0.5;
constexpr double kGripRange = 0.02;
constexpr double kOpenAperture = kPi / 2;

}  // namespace

bool Kinematics2dEngine::Hold(std::uint32_t robot, std::uint32_t object)
{
  const std::uint32_t body = BodyOf(robot);
  const std::uint32_t held = BodyOf(object);
  const std::vector<Grip>& grips = world_.Grips();
  if (world_.FindGrip(held) != nullptr || world_.FindGrip(body) != nullptr ||
      std::any_of(grips.begin(), grips.end(), [body](const Grip& grip) { return grip.prey == body; }))
    return false;
  world_.AddGrip(body, held);
  return true;
}

void Kinematics2dEngine::UseGrippers(const ChannelBlock& block, std::span<const double> values)
{
  near_preys_.Forget();
  for (std::size_t k = 0; k < block.entities.size(); ++k)
  {
    CheckCommand(values[k], block.entities[k], block);
    const double closed = std::clamp(values[k], 0.0, 1.0);
    Footbot& footbot = FootbotOf(BodyOf(block.entities[k]));
    footbot.aperture = (1 - closed) * kOpenAperture;
    const bool gripping = world_.FindGrip(footbot.body) != nullptr;
    if (closed > kGripThreshold && !gripping) GripNearest(footbot.body);
    if (closed <= kGripThreshold && gripping) world_.RemoveGrip(footbot.body);
  }
}

// Returns the distance (m) from a point of the plane to a body of one circle or one polygon, negative inside.
double Kinematics2dEngine::GapTo(std::uint32_t body, double x, double y) const
{
  const CollisionModel& model = world_.ModelOf(body);
  const double dx = world_.Poses().x[body] - x;
  const double dy = world_.Poses().y[body] - y;
  if (model.polygons.empty()) return std::sqrt(dx * dx + dy * dy) - model.bounding_radius;
  const Placed placed = world_.PlacedAt(body);
  return DistanceTo(model.polygons.front(), -(placed.cos * dx + placed.sin * dy), placed.sin * dx - placed.cos * dy);
}

void Kinematics2dEngine::GripNearest(std::uint32_t body)
{
  const Placed robot = world_.PlacedAt(body);
  const double front_x = robot.x + kFootbotGripperReach * (robot.cos * robot.turret_cos - robot.sin * robot.turret_sin);
  const double front_y = robot.y + kFootbotGripperReach * (robot.sin * robot.turret_cos + robot.cos * robot.turret_sin);
  double nearest = kGripRange;
  std::uint32_t found = body;
  const auto origin = [this](std::size_t k) -> Vector3
  {
    const std::uint32_t prey = preys_[k];
    if (is_elsewhere_[prey] != 0 || !space_->IsPresent(layout_->owned[prey]))
      return Vector3::Constant(std::numeric_limits<double>::quiet_NaN());
    return {world_.Poses().x[prey], world_.Poses().y[prey], 0};
  };
  for (const std::uint32_t k : near_preys_.Near(space_->GetExperiment(), {front_x, front_y, 0}, nearest, origin))
  {
    const std::uint32_t prey = preys_[k];
    const double gap = GapTo(prey, front_x, front_y);
    if (gap >= nearest) continue;
    nearest = gap;
    found = prey;
  }
  if (found != body) world_.AddGrip(body, found);
}

}  // namespace swarmanoid

// Problem: grippers take bodies, and a turret turns what its gripper holds.
//
// Method: a gripper takes the nearest body within reach of the middle of its front. A grip says where the axis of the
// turret, or the end of a rod, is on the held body, and at which angle; the solver has a joint for it
// (group_solver.cpp).
//
// Invariant: grips form trees.
#include <algorithm>
#include <cmath>

#include "common/math/elementary.h"
#include "engine_worker/engines/dynamics2d/dynamics2d_world.h"

namespace swarmanoid::dynamics2d
{
namespace
{

// Returns the distance of a point from the outline of a model, in the model's frame; negative inside.
double OutlineDistance(const BodyModel& model, const Vector2& point)
{
  if (model.radius > 0) return std::sqrt(point.squaredNorm()) - model.radius;
  return DistanceTo(std::span(model.polygon), point);
}

}  // namespace

// Headings come without whole turns: the turns that the bodies had made are taken from the angle of the grip.
void Dynamics2dWorld::CountTurns(Body& body)
{
  const double angle = bodies_[Index(body.gripped)].state.angle - body.state.angle - body.grip.reference_angle;
  if (std::abs(angle) > kPi) body.grip.reference_angle += angle - WrapAngle(angle);
}

bool Dynamics2dWorld::LeadsTo(int from, int to) const
{
  for (int body = from; body != kNoBody; body = bodies_[Index(body)].gripped)
    if (body == to) return true;
  return false;
}

int Dynamics2dWorld::FindGrippable(int number) const
{
  const Body& body = bodies_[Index(number)];
  const std::uint32_t group = groups_.GroupOf(in_moving_[Index(number)]);
  if (group == ContactGroups::kAlone) return kNoBody;  // no body is near
  const BodyState& state = body.state;
  const SinCos turret = SinCosOf(state.angle + body.turret_angle);
  const double reach = body.model.grips_by_rod ? body.model.radius : kGripperReach;
  const double grip_distance = body.model.grips_by_rod ? kRodGripDistance : settings_.grip_distance;
  const double x = state.x + reach * turret.cos;
  const double y = state.y + reach * turret.sin;

  int best = kNoBody;
  double best_distance = grip_distance;
  for (const std::uint32_t k : groups_.Bodies(group))
  {
    const int candidate = static_cast<int>(moving_[k]);
    const Body& other = bodies_[moving_[k]];
    const double dx = x - other.state.x;
    const double dy = y - other.state.y;
    const double farthest = other.radius + grip_distance;
    if (dx * dx + dy * dy > farthest * farthest || !other.solid || !other.model.grippable || LeadsTo(candidate, number))
      continue;
    const SinCos heading = SinCosOf(other.state.angle);
    const Vector2 point(heading.cos * dx + heading.sin * dy, heading.cos * dy - heading.sin * dx);
    const double distance = OutlineDistance(other.model, point);
    if (distance > best_distance || (distance == best_distance && best != kNoBody)) continue;
    best = candidate;
    best_distance = distance;
  }
  return best;
}

void Dynamics2dWorld::Grip(int number, int target)
{
  Body& body = bodies_[Index(number)];
  const BodyState& own = body.state;
  const BodyState& held = bodies_[Index(target)].state;
  double x = own.x - held.x;  // the axis of the turret, or the outer end of a rod
  double y = own.y - held.y;
  if (body.model.grips_by_rod && !body.model.has_turret_motor)
  {
    const SinCos turret = SinCosOf(own.angle + body.turret_angle);
    x += body.model.radius * turret.cos;
    y += body.model.radius * turret.sin;
  }
  const SinCos heading = SinCosOf(held.angle);
  body.grip.anchor_x = heading.cos * x + heading.sin * y;
  body.grip.anchor_y = heading.cos * y - heading.sin * x;
  const double difference = held.angle - own.angle;
  body.grip.reference_angle = body.model.has_turret_motor ? difference - body.turret_angle : difference;
  body.grip_forces = {};
  body.gripped = target;
  body.held_angle.reset();
  const std::uint32_t group = groups_.GroupOf(in_moving_[Index(number)]);
  if (group == ContactGroups::kAlone || group != groups_.GroupOf(in_moving_[Index(target)])) must_find_groups_ = true;
}

void Dynamics2dWorld::Release(int number)
{
  Body& body = bodies_[Index(number)];
  if (body.gripped == kNoBody) return;
  body.turret_angle = TurretAngleOf(number);
  body.gripped = kNoBody;
  body.grip_forces = {};
  body.held_angle.reset();
}

int Dynamics2dWorld::GripCount() const
{
  return static_cast<int>(
      std::count_if(bodies_.begin(), bodies_.end(), [](const Body& body) { return body.gripped != kNoBody; }));
}

}  // namespace swarmanoid::dynamics2d

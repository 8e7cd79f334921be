// Problem: most bodies of a sparse swarm meet no other one in a tick, and Box2D spends as much time on them as on a
// pile.
//
// Method: when a tick begins, each body gets an outline and the way that it can go by itself. Bodies whose outlines and
// ways are apart (separation_test.h) are isolated: they leave Box2D, and dynamics2d_step.cpp moves them in closed form.
// If a solved body was pushed farther than was allowed for, all isolated bodies return at once.
//
// Invariants: the set follows from the state at the start of the tick. A body is isolated at a larger gap than that at
// which it stays isolated, so that few change sides. Source: docs/engines.md, "Bodies that meet nobody".
#include <algorithm>
#include <cmath>

#include "common/math/elementary.h"
#include "engine_worker/engines/dynamics2d/dynamics2d_world.h"

namespace swarmanoid::dynamics2d
{
namespace
{

// Solved bodies may be pushed by this much (m) farther than they move by themselves.
constexpr double kPushed = 0.02;
// If a body goes faster than this (m/s), all bodies are solved: the cells around it would hold too many.
constexpr double kFastestIsolated = 2;

double Length(double x, double y) { return std::sqrt(x * x + y * y); }

constexpr double kGripperMiddle = kGripperReach - kGripperSide / 2;
const double kGripperRadius = std::sqrt(0.5) * kGripperSide;

double RadiusOf(const BodyModel& model)
{
  double radius = model.radius;
  for (const Vector2& corner : model.polygon) radius = std::max(radius, std::sqrt(corner.squaredNorm()));
  if (model.has_gripper) radius = std::max(radius, Length(kGripperReach, kGripperSide / 2));
  return radius;
}

// The distance from the origin to the point that turning moves farthest.
double ArmOf(const BodyModel& model) { return model.has_gripper ? Length(kGripperReach, kGripperSide / 2) : 0; }

StaticOutline OutlineIn(const BodyModel& model, double x, double y, double angle)
{
  if (model.radius > 0) return {{{x, y}}, model.radius};
  StaticOutline outline;
  const SinCos heading = SinCosOf(angle);
  for (const Vector2& corner : model.polygon)
    outline.corners.emplace_back(x + heading.cos * corner.x() - heading.sin * corner.y(),
                                 y + heading.sin * corner.x() + heading.cos * corner.y());
  return outline;
}

}  // namespace

void Dynamics2dWorld::ConfigureIsolation()
{
  isolation_is_configured_ = true;
  moving_.clear();
  outlines_.clear();
  std::vector<StaticOutline> statics;
  for (std::size_t i = 0; i < bodies_.size(); ++i)
  {
    const Body& body = bodies_[i];
    const BodyState state = StateOf(body);
    const double x = state.x / kUnitsPerMetre;
    const double y = state.y / kUnitsPerMetre;
    if (body.model.motion == EMotion::kStatic)
    {
      statics.push_back(OutlineIn(body.model, x, y, state.angle));
      continue;
    }
    moving_.push_back(static_cast<std::uint32_t>(i));
    Outline(body, tick_, outlines_.emplace_back());
  }
  isolation_.Configure(outlines_, std::move(statics), kFastestIsolated * tick_ + settings_.grip_distance);
}

bool Dynamics2dWorld::CanBeIsolated(const Body& body) const
{
  return body.model.motion == EMotion::kDynamic && body.solid && body.gripped == kNoBody && !body.is_gripped;
}

void Dynamics2dWorld::MarkGripped()
{
  for (Body& body : bodies_) body.is_gripped = false;
  for (const Body& body : bodies_)
    if (body.gripped != kNoBody) bodies_[Index(body.gripped)].is_gripped = true;
}

void Dynamics2dWorld::BeginTick(double seconds)
{
  if (seconds != tick_) isolation_is_configured_ = false;
  tick_ = seconds;
  if (!isolation_is_configured_) ConfigureIsolation();
  MarkGripped();

  for (std::size_t k = 0; k < moving_.size(); ++k) Outline(bodies_[moving_[k]], seconds, outlines_[k]);
  isolation_.Find(outlines_, kPushed + settings_.grip_distance, nearness_);

  isolated_.clear();
  solved_.clear();
  ways_.clear();
  for (std::size_t k = 0; k < moving_.size(); ++k)
  {
    Body& body = bodies_[moving_[k]];
    const bool was_isolated = body.b2 == nullptr;
    const bool is_far = nearness_[k] == Nearness::kFar || (was_isolated && nearness_[k] == Nearness::kClose);
    if (is_far && CanBeIsolated(body))
    {
      if (!was_isolated) Isolate(body);
      isolated_.push_back(moving_[k]);
      continue;
    }
    if (was_isolated) BuildBody(body);
    if (body.model.motion != EMotion::kDynamic) continue;
    solved_.push_back(moving_[k]);
    ways_.push_back(WayFrom(body, outlines_[k].whole.way));
  }
}

Dynamics2dWorld::Way Dynamics2dWorld::WayFrom(const Body& body, double metres)
{
  const BodyState state = StateOf(body);
  return {state.x, state.y, state.angle, (metres + kPushed) * kUnitsPerMetre};
}

// Sets the outline of a body at its position, and how far the body can move by itself within `seconds`.
void Dynamics2dWorld::Outline(const Body& body, double seconds, MovingOutline& outline) const
{
  const BodyModel& model = body.model;
  const BodyState state = StateOf(body);
  outline.present = body.solid;
  double speed = Length(state.vx, state.vy) / kUnitsPerMetre;
  double turn = std::abs(static_cast<double>(state.turn));
  if (model.motion == EMotion::kDynamic)
  {
    speed = std::max(speed, Length(body.drive.forward, body.drive.left));
    turn = std::max(turn, std::abs(body.drive.turn)) + std::abs(body.turret_speed);
  }
  const double x = state.x / kUnitsPerMetre;
  const double y = state.y / kUnitsPerMetre;
  const double way = speed * seconds;
  const double swept = way + turn * seconds * ArmOf(model);
  outline.whole = {x, y, RadiusOf(model), swept};
  outline.part_count = model.has_gripper && model.radius > 0 ? 2 : 0;
  if (outline.part_count == 0) return;
  const SinCos front = SinCosOf(state.angle + TurretAngleOf(static_cast<int>(&body - bodies_.data())));
  outline.parts = {{{x, y, model.radius, way},
                    {x + kGripperMiddle * front.cos, y + kGripperMiddle * front.sin, kGripperRadius, swept}}};
}

void Dynamics2dWorld::Isolate(Body& body)
{
  body.start = StateOf(body);
  world_->DestroyBody(body.b2);  // and its joint
  LeaveOut(body);
}

void Dynamics2dWorld::LeaveOut(Body& body)
{
  body.b2 = nullptr;
  body.ground = nullptr;
  body.gripper = nullptr;
  body.joint = nullptr;
}

void Dynamics2dWorld::EndIsolation(int number)
{
  Body& body = bodies_[Index(number)];
  if (body.b2 != nullptr) return;
  BuildBody(body);
  std::erase(isolated_, Index(number));
  const auto place = std::ranges::lower_bound(solved_, Index(number));
  ways_.insert(ways_.begin() + (place - solved_.begin()), WayFrom(body, 0));
  solved_.insert(place, static_cast<std::uint32_t>(number));
}

bool Dynamics2dWorld::IsAnyTooFar(double seconds) const
{
  for (std::size_t i = 0; i < solved_.size(); ++i)
  {
    const Body& body = bodies_[solved_[i]];
    const BodyState state = StateOf(body);
    const Way& way = ways_[i];
    const double arm = ArmOf(body.model) * kUnitsPerMetre;
    const double gone = Length(state.x - way.x, state.y - way.y) + arm * std::abs(state.angle - way.angle);
    const double next = Length(state.vx, state.vy) + arm * std::abs(state.turn);
    if (gone + seconds * next > way.most) return true;
  }
  return false;
}

}  // namespace swarmanoid::dynamics2d

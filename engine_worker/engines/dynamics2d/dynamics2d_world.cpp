// Problem: keep bodies so that a saved state gives the bits of a run that never stopped.
//
// Method: a state is only the bits below. The solver also remembers the forces of contacts and grips, from which a step
// begins. Rebuild drops them, in every run at the same ticks, and a state is saved there.
//
// Invariant: groups follow from the bodies alone.
#include "engine_worker/engines/dynamics2d/dynamics2d_world.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "common/math/elementary.h"
#include "engine_worker/engines/dynamics2d/remote_groups.h"

namespace swarmanoid::dynamics2d
{

Dynamics2dWorld::Dynamics2dWorld(const WorldSettings& settings)
    : settings_(settings),
      settings_of_solver_{settings.velocity_iterations, settings.position_iterations, settings.turret_torque, 0}
{
}
Dynamics2dWorld::~Dynamics2dWorld() = default;

int Dynamics2dWorld::AddBody(BodyModel model, const PlanePose& pose)
{
  Body& body = bodies_.emplace_back();
  body.model = std::move(model);
  body.state.x = pose.u;
  body.state.y = pose.v;
  body.state.angle = pose.heading;
  // Box2D sees polygons with single precision: those of walls are given around their middles.
  if (body.model.motion == EMotion::kStatic && !body.model.polygon.empty())
  {
    Vector2 middle = Vector2::Zero();
    for (const Vector2& corner : body.model.polygon) middle += corner;
    middle /= static_cast<double>(body.model.polygon.size());
    for (Vector2& corner : body.model.polygon) corner -= middle;
    const SinCos heading = SinCosOf(pose.heading);
    body.state.x += heading.cos * middle.x() - heading.sin * middle.y();
    body.state.y += heading.sin * middle.x() + heading.cos * middle.y();
  }
  UpdateShape(body);
  return static_cast<int>(bodies_.size()) - 1;
}

void Dynamics2dWorld::Build()
{
  isolated_.clear();
  groups_ = ContactGroups();
  run_of_group_.clear();
  order_.clear();
  separation_is_configured_ = false;
  contacts_.clear();
  contact_count_ = 0;
  contacts_of_.assign(bodies_.size(), {0, 0});
  for (Body& body : bodies_)
  {
    body.ground = {};
    body.grip_forces = {};
  }
}

void Dynamics2dWorld::UseRegions(RegionTeam& team, unsigned threads)
{
  remote_ = std::make_unique<RemoteGroups>(team, threads);
}

void Dynamics2dWorld::UseThreads(unsigned threads, WorkerPool* pool)
{
  if (pool == nullptr && threads > 1) own_pool_ = std::make_unique<WorkerPool>(threads);
  pool_ = pool != nullptr ? pool : own_pool_.get();
}

void Dynamics2dWorld::Place(int number, const PlanePose& pose)
{
  Body& body = bodies_[Index(number)];
  body.state.x = pose.u;
  body.state.y = pose.v;
  body.state.angle = pose.heading;
  if (body.model.motion == EMotion::kKinematic) return;
  for (Body& other : bodies_)
    if (other.gripped == number || (other.gripped != kNoBody && &other == &body)) CountTurns(other);
}

void Dynamics2dWorld::SetVelocity(int number, const PlaneVelocity& velocity)
{
  BodyState& state = bodies_[Index(number)].state;
  state.vx = velocity.u;
  state.vy = velocity.v;
  state.turn = velocity.turn;
}

void Dynamics2dWorld::SetOutline(int number, const std::vector<Vector2>& polygon, double tolerance)
{
  Body& body = bodies_[Index(number)];
  const std::vector<Vector2>& outline = body.model.polygon;
  const auto same = [=](const Vector2& a, const Vector2& b) { return (a - b).squaredNorm() <= tolerance * tolerance; };
  if (std::equal(outline.begin(), outline.end(), polygon.begin(), polygon.end(), same)) return;
  body.model.polygon = polygon;
  UpdateShape(body);
  separation_is_configured_ = false;
}

void Dynamics2dWorld::Rebuild()
{
  WrapAngles();
  Build();
}

// Angles grow with every turn and lose precision; here they come back to -pi..pi, and the grips' angles with them.
void Dynamics2dWorld::WrapAngles()
{
  const auto wrap = [](double angle) { return std::abs(angle) > kPi ? WrapAngle(angle) : angle; };
  for (Body& body : bodies_)
  {
    if (body.gripped == kNoBody) continue;
    const double own = body.state.angle;
    const double other = bodies_[Index(body.gripped)].state.angle;
    const double joint = other - own - body.grip.reference_angle;
    if (wrap(own) == own && wrap(other) == other && std::abs(joint) <= kPi) continue;
    body.grip.reference_angle = wrap(other) - wrap(own) - WrapAngle(joint);
  }
  for (Body& body : bodies_) body.state.angle = wrap(body.state.angle);
}

void Dynamics2dWorld::SaveState(ByteWriter& state) const
{
  state.Put(static_cast<std::uint64_t>(bodies_.size()));
  for (const Body& body : bodies_)
  {
    if (body.model.motion == EMotion::kStatic) continue;
    PutMotion(body, state);
    PutGrip(body, state);
  }
}

void Dynamics2dWorld::LoadState(ByteReader& state)
{
  if (state.Get<std::uint64_t>() != bodies_.size())
    throw std::runtime_error("saved state of dynamics2d: it is of an experiment with another number of bodies");
  for (Body& body : bodies_)
  {
    if (body.model.motion == EMotion::kStatic) continue;
    GetMotion(body, state);
    GetGrip(body, state);
    if (body.gripped != kNoBody && (body.gripped < 0 || body.gripped >= static_cast<int>(bodies_.size()) ||
                                    bodies_[Index(body.gripped)].model.motion != EMotion::kDynamic))
      throw std::runtime_error("saved state of dynamics2d: a robot holds a body that it cannot hold");
  }
  Build();
}

}  // namespace swarmanoid::dynamics2d

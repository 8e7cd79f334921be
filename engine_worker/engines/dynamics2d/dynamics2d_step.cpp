// Problem: bodies strive for a velocity against the ground with limited force, while contacts and grips hold them.
//
// Method: groups and isolated bodies move independently of each other, so any thread may step any of them. In a group,
// each body has a motor joint to the ground. Its error is set so that it asks for the wanted velocity: Box2D
// solves it together with contacts and grips, so a body that cannot move stands still. An isolated body has nothing
// else to solve: its velocity comes as near to the wanted one as force and torque allow, in closed form, and then moves
// it as Box2D would.
//
// Friction under a face opposes the slip at each of its points, so that sliding and turning share one limit: nearly an
// ellipsoid (Howe and Cutkosky, "Practical force-motion models for sliding manipulation", 1996). A body that slides
// gives way to the smallest push across, and to the smallest torque.
//
// Invariant: what single precision takes from a step, or adds to it, is carried on to the next one.
#include <algorithm>
#include <atomic>
#include <cmath>

#include "common/math/elementary.h"
#include "engine_worker/engines/dynamics2d/dynamics2d_world.h"
#include "engine_worker/engines/dynamics2d/remote_groups.h"

namespace swarmanoid::dynamics2d
{
namespace
{

// A remainder beyond this goes to Box2D's position.
constexpr double kLargestRemainder = 1e-4;  // decimetres
constexpr double kSlip = 1e-3;              // m/s: slower than this a body on the ground is taken to stand
constexpr std::size_t kChunk = 64;          // isolated bodies that a thread takes at once
constexpr std::size_t kLeastShared = 32;    // bodies; with fewer, waking threads takes longer

double SpeedOf(double x, double y) { return std::sqrt(x * x + y * y); }

}  // namespace

void Dynamics2dWorld::Advance(int steps)
{
  if (must_find_groups_) FindGroups();
  KeepStarts();
  const double seconds = tick_ / steps;
  RunGroups(seconds, steps, isolated_);
  while (MergeGroups(seconds, steps)) RunGroups(seconds, steps, {});
}

void Dynamics2dWorld::KeepStarts()
{
  starts_.clear();
  for (const std::uint32_t number : moving_)
  {
    Body& body = bodies_[number];
    body.measures = {};
    starts_.push_back({StateOf(body), body.remainder_x, body.remainder_y, body.turret_angle, body.held_angle});
  }
}

// Gives a body that is in no world the state in which it began the tick.
void Dynamics2dWorld::ReturnToStart(std::size_t moving)
{
  Body& body = bodies_[moving_[moving]];
  const TickStart& start = starts_[moving];
  body.start = start.state;
  body.remainder_x = start.remainder_x;
  body.remainder_y = start.remainder_y;
  body.turret_angle = start.turret_angle;
  body.held_angle = start.held_angle;
  body.measures = {};
}

// Makes the steps that are left of all groups, and all steps of the bodies `isolated`.
void Dynamics2dWorld::RunGroups(double seconds, int steps, std::span<const std::uint32_t> isolated)
{
  if (remote_ == nullptr) return RunHere(seconds, steps, isolated);
  RunWithRegions(seconds, steps, [&] { RunHere(seconds, steps, isolated); });
}

void Dynamics2dWorld::RunHere(double seconds, int steps, std::span<const std::uint32_t> isolated)
{
  // The largest groups come first, and isolated bodies last, so that the threads end at about the same time.
  const std::size_t tasks = order_.size() + (isolated.size() + kChunk - 1) / kChunk;
  const auto work = [&](std::size_t task)
  {
    if (task < order_.size()) return RunGroup(WorldOf(order_[task]), seconds, steps);
    const std::size_t begin = (task - order_.size()) * kChunk;
    for (const std::uint32_t number : isolated.subspan(begin, std::min(kChunk, isolated.size() - begin)))
    {
      Body& body = bodies_[number];
      for (int step = 0; step < steps; ++step)
      {
        const PlanePose before = body.half_axle > 0 ? PoseOf(static_cast<int>(number)) : PlanePose();
        AdvanceIsolated(body, seconds);
        AddWheelWays(body, before);
      }
    }
  };
  WorkerPool* const pool = IfItShares(pool_);
  if (pool == nullptr || tasks < 2 || moving_.size() < kLeastShared)
  {
    for (std::size_t task = 0; task < tasks; ++task) work(task);
    return;
  }
  std::atomic<std::size_t> next = 0;
  pool->Run(
      [&](unsigned)
      {
        for (std::size_t task = next.fetch_add(1); task < tasks; task = next.fetch_add(1)) work(task);
      });
}

void Dynamics2dWorld::RunGroup(GroupWorld& world, double seconds, int steps)
{
  if (world.remote) return;
  for (; world.steps_done < steps; ++world.steps_done)
  {
    if (world.goes_too_far && !are_all_in_one_) return;
    StepGroup(world, seconds, steps);
  }
}

void Dynamics2dWorld::StepGroup(GroupWorld& world, double seconds, int steps)
{
  world.before.clear();
  for (const std::uint32_t number : world.dynamic)
  {
    Body& body = bodies_[number];
    ApplyDrive(body, seconds);
    if (body.gripper != nullptr) ApplyTurret(body, seconds, world.last_step);
    world.before.push_back(
        {body.b2->GetPosition(), body.half_axle > 0 ? PoseOf(static_cast<int>(number)) : PlanePose()});
  }
  world.box2d->Step(static_cast<float>(seconds), settings_.velocity_iterations, settings_.position_iterations);
  world.last_step = seconds;
  for (std::size_t i = 0; i < world.dynamic.size(); ++i)
  {
    Body& body = bodies_[world.dynamic[i]];
    if (body.solid) KeepRemainder(body, world.before[i].position, seconds);
    AddWheelWays(body, world.before[i].pose);
    world.goes_too_far = world.goes_too_far || IsTooFar(body, world.ways[i], seconds);
    if (!measures_loads_ || body.joint == nullptr) continue;
    const TurretLoad load = LoadOf(body, seconds);
    body.measures.load.force_x += load.force_x / steps;
    body.measures.load.force_y += load.force_y / steps;
    body.measures.load.torque += load.torque / steps;
  }
}

void Dynamics2dWorld::AddWheelWays(Body& body, const PlanePose& before)
{
  if (body.half_axle <= 0) return;
  const PlanePose after = PoseOf(static_cast<int>(&body - bodies_.data()));
  const double turn = after.heading - before.heading;
  const SinCos middle = SinCosOf(before.heading + turn / 2);
  const double forward = middle.cos * (after.u - before.u) + middle.sin * (after.v - before.v);
  body.measures.left_arc += forward - turn * body.half_axle;
  body.measures.right_arc += forward + turn * body.half_axle;
}

// Box2D moves by x += h v in single precision.
void Dynamics2dWorld::KeepRemainder(Body& body, const b2Vec2& before, double seconds) const
{
  const auto h = static_cast<float>(seconds);
  const auto lost = [&](float x, float v)
  {
    const float moved = x + h * v;
    return x + seconds * v - moved;
  };
  const b2Vec2 velocity = body.b2->GetLinearVelocity();
  body.remainder_x += lost(before.x, velocity.x);
  body.remainder_y += lost(before.y, velocity.y);
  if (std::max(std::abs(body.remainder_x), std::abs(body.remainder_y)) < kLargestRemainder) return;
  const b2Vec2 now = body.b2->GetPosition();
  SetPosition(body, now.x + body.remainder_x, now.y + body.remainder_y, body.b2->GetAngle());
}

// Returns the velocity along the chord of the arc of a step of `seconds`, in units per second.
PlaneVelocity Dynamics2dWorld::WantedVelocity(const Body& body, double seconds) const
{
  const double turn = body.drive.turn * seconds;
  if (body.drive.forward == 0 && body.drive.left == 0) return {0, 0, body.drive.turn};
  const SinCos middle = SinCosOf(StateOf(body).angle + turn / 2);
  const double shortening = std::abs(turn) > 1e-6 ? Sin(turn / 2) / (turn / 2) : 1;
  const double scale = shortening * kUnitsPerMetre;
  return {scale * (middle.cos * body.drive.forward - middle.sin * body.drive.left),
          scale * (middle.sin * body.drive.forward + middle.cos * body.drive.left), body.drive.turn};
}

void Dynamics2dWorld::ApplyDrive(Body& body, double seconds)
{
  const PlaneVelocity wanted = WantedVelocity(body, seconds);
  const double ahead = seconds / kDriveGain;
  const b2Vec2 position = body.b2->GetWorldCenter();
  body.ground->SetLinearOffset(
      {static_cast<float>(position.x + ahead * wanted.u), static_cast<float>(position.y + ahead * wanted.v)});
  body.ground->SetAngularOffset(static_cast<float>(body.b2->GetAngle() + ahead * wanted.turn));
  if (!body.model.lies || body.model.ground_force <= 0) return;
  const FrictionShares shares = SharesOf(body.model, StateOf(body));
  body.ground->SetMaxForce(static_cast<float>(shares.sliding * body.model.ground_force * kForceUnits));
  body.ground->SetMaxTorque(static_cast<float>(shares.turning * body.model.ground_torque * kTorqueUnits));
}

Dynamics2dWorld::FrictionShares Dynamics2dWorld::SharesOf(const BodyModel& model, const BodyState& state)
{
  const double x = state.vx / kUnitsPerMetre;
  const double y = state.vy / kUnitsPerMetre;
  const double turn = state.turn * model.ground_torque / model.ground_force;
  const double slip = std::sqrt(x * x + y * y + turn * turn);
  if (slip <= kSlip) return {1, 1};
  return {std::sqrt(x * x + y * y) / slip, std::abs(turn) / slip};
}

// Follows Box2D's order: first the velocities, then x += h v, within its limits for a step.
void Dynamics2dWorld::AdvanceIsolated(Body& body, double seconds) const
{
  const BodyModel& model = body.model;
  BodyState& state = body.start;
  const PlaneVelocity wanted = WantedVelocity(body, seconds);
  FrictionShares shares{1, 1};
  if (model.lies && model.ground_force > 0) shares = SharesOf(model, state);

  const double most_turn = seconds * shares.turning * model.ground_torque / model.inertia;
  const double turn = std::clamp(wanted.turn, state.turn - most_turn, state.turn + most_turn);
  double change_x = wanted.u - state.vx;
  double change_y = wanted.v - state.vy;
  const double change = SpeedOf(change_x, change_y);
  const double most = seconds * shares.sliding * model.ground_force / model.mass * kUnitsPerMetre;
  if (change > most)
  {
    change_x *= most / change;
    change_y *= most / change;
  }
  double vx = state.vx + change_x;
  double vy = state.vy + change_y;
  const double way = seconds * SpeedOf(vx, vy);
  if (way > b2_maxTranslation)
  {
    vx *= b2_maxTranslation / way;
    vy *= b2_maxTranslation / way;
  }
  state.vx = static_cast<float>(vx);
  state.vy = static_cast<float>(vy);
  state.turn = static_cast<float>(std::clamp<double>(turn, -b2_maxRotation / seconds, b2_maxRotation / seconds));
  SetPosition(body, state.x + body.remainder_x + seconds * state.vx, state.y + body.remainder_y + seconds * state.vy,
              static_cast<float>(state.angle + seconds * state.turn));
  if (body.turret_speed != 0) body.turret_angle = WrapAngle(body.turret_angle + body.turret_speed * seconds);
}

}  // namespace swarmanoid::dynamics2d

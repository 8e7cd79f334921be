// Problem: move all bodies through a tick, most of which touch nothing.
//
// Method: groups and isolated bodies move independently of each other, so any thread may move any of them. The solver
// moves groups (group_solver.cpp, with the law of the ground). An isolated body has nothing but the ground. One that
// rests and shall rest stays. One that can follow its commands is at their velocity after the first step of the tick,
// and the chords of all steps of an arc have the chord of the tick as their sum. Others are moved step by step.
//
// Derivation: in a step of h, a body with the turn w covers the chord h v sinc(w h / 2) in the direction of the middle
// of the step. From step to step the wanted velocity turns by w h, so that its change is v sinc(w h / 2) 2 sin(w h / 2)
// at most. If the ground can give this, and the change to the first chord, the body follows all chords. They are those
// of one circle: the sum is T v sinc(w T / 2) in the direction of the middle of the tick T, and the last chord is the
// velocity at its end.
//
// Invariant: the solver gives the same motion, to rounding, to a body of a group that nothing touches.
#include <algorithm>
#include <cmath>

#include "common/math/elementary.h"
#include "engine_worker/engines/dynamics2d/dynamics2d_world.h"
#include "engine_worker/engines/dynamics2d/remote_groups.h"

namespace swarmanoid::dynamics2d
{
namespace
{

constexpr std::size_t kChunk = 64;        // isolated bodies that a thread takes at once
constexpr std::size_t kLeastShared = 32;  // bodies; with fewer, waking threads takes longer

// The law of the ground (group_solver.cpp), and x += h v, within the limits for a step.
void AdvanceByStep(Body& body, double seconds, const ChordOfStep& chord)
{
  const BodyModel& model = body.model;
  BodyState& state = body.state;
  double wanted_x = 0;
  double wanted_y = 0;
  const SinCos heading =
      body.drive.forward != 0 || body.drive.left != 0 || body.half_axle > 0 ? SinCosOf(state.angle) : SinCos{0, 1};
  if (body.drive.forward != 0 || body.drive.left != 0)
  {
    const double c = chord.shortening * (heading.cos * chord.cos - heading.sin * chord.sin);
    const double s = chord.shortening * (heading.sin * chord.cos + heading.cos * chord.sin);
    wanted_x = c * body.drive.forward - s * body.drive.left;
    wanted_y = s * body.drive.forward + c * body.drive.left;
  }
  FrictionShares shares{1, 1};
  if (model.lies && model.ground_force > 0) shares = SharesOf(model, state.vx, state.vy, state.turn);

  const double most_turn = seconds * shares.turning * model.ground_torque / model.inertia;
  double change_x = wanted_x - state.vx;
  double change_y = wanted_y - state.vy;
  const double change = Length(change_x, change_y);
  const double most = seconds * shares.sliding * model.ground_force / model.mass;
  if (change > most)
  {
    change_x *= most / change;
    change_y *= most / change;
  }
  state.vx += change_x;
  state.vy += change_y;
  state.turn = std::clamp(body.drive.turn, state.turn - most_turn, state.turn + most_turn);
  const double way = seconds * Length(state.vx, state.vy);
  if (way > kLongestStep)
  {
    state.vx *= kLongestStep / way;
    state.vy *= kLongestStep / way;
  }
  state.turn = std::clamp(state.turn, -kLargestTurn / seconds, kLargestTurn / seconds);
  state.x += seconds * state.vx;
  state.y += seconds * state.vy;
  state.angle += seconds * state.turn;
  if (body.half_axle <= 0) return;
  const SinCos half = SinCosOf(seconds * state.turn / 2);
  const double c = heading.cos * half.cos - heading.sin * half.sin;
  const double s = heading.sin * half.cos + heading.cos * half.sin;
  const double forward = seconds * (c * state.vx + s * state.vy);
  const double turned = seconds * state.turn * body.half_axle;
  body.measures.left_arc += forward - turned;
  body.measures.right_arc += forward + turned;
}

// Makes all steps at once, if the body can follow its commands in each. Returns false if it cannot.
bool FollowsArc(Body& body, double seconds, int steps)
{
  const BodyModel& model = body.model;
  const Twist& drive = body.drive;
  BodyState& state = body.state;
  const double most_turn = seconds * model.ground_torque;
  if (std::abs(drive.turn - state.turn) * model.inertia > most_turn) return false;
  const double speed = Length(drive.forward, drive.left);
  const double most = seconds * model.ground_force / model.mass;
  if (speed * seconds > kLongestStep || std::abs(drive.turn) * seconds > kLargestTurn) return false;
  if (speed * std::abs(drive.turn) * seconds > most) return false;

  const double whole = drive.turn * seconds * steps;
  const SinCos& heading = body.heading;
  const ChordOfStep step = ChordOf(drive.turn * seconds);
  const auto velocity_at = [&](double cos, double sin, double& x, double& y)
  {
    x = step.shortening * (cos * drive.forward - sin * drive.left);
    y = step.shortening * (sin * drive.forward + cos * drive.left);
  };
  double x = 0;
  double y = 0;
  velocity_at(heading.cos * step.cos - heading.sin * step.sin, heading.sin * step.cos + heading.cos * step.sin, x, y);
  const double change_x = x - state.vx;
  const double change_y = y - state.vy;
  if (change_x * change_x + change_y * change_y > most * most) return false;

  if (drive.turn == 0)
  {
    state.vx = x;
    state.vy = y;
    state.x += seconds * steps * x;
    state.y += seconds * steps * y;
    state.turn = 0;
  }
  else
  {
    const ChordOfStep tick = ChordOf(whole);
    const double way = seconds * steps * tick.shortening;
    const double c = heading.cos * tick.cos - heading.sin * tick.sin;
    const double s = heading.sin * tick.cos + heading.cos * tick.sin;
    state.x += way * (c * drive.forward - s * drive.left);
    state.y += way * (s * drive.forward + c * drive.left);
    // The last chord is half a step before the end: that of the middle of the tick, and then back from its end.
    const double back_cos = tick.cos * step.cos + tick.sin * step.sin;
    const double back_sin = tick.sin * step.cos - tick.cos * step.sin;
    velocity_at(c * back_cos - s * back_sin, s * back_cos + c * back_sin, state.vx, state.vy);
    state.turn = drive.turn;
    state.angle += whole;
  }
  if (body.half_axle > 0)
  {
    const double forward = seconds * steps * step.shortening * drive.forward;
    const double turned = whole * body.half_axle;
    body.measures.left_arc += forward - turned;
    body.measures.right_arc += forward + turned;
  }
  return true;
}

void AdvanceIsolated(Body& body, double seconds, int steps)
{
  if (body.turret_speed != 0)
    for (int step = 0; step < steps; ++step)
      body.turret_angle = WrapAngle(body.turret_angle + body.turret_speed * seconds);
  const BodyState& state = body.state;
  const Twist& drive = body.drive;
  const bool shall_rest = drive.forward == 0 && drive.left == 0 && drive.turn == 0;
  if (shall_rest && state.vx == 0 && state.vy == 0 && state.turn == 0) return;
  if (!body.model.lies && FollowsArc(body, seconds, steps)) return;
  const ChordOfStep chord = ChordOf(drive.turn * seconds);
  for (int step = 0; step < steps; ++step) AdvanceByStep(body, seconds, chord);
}

}  // namespace

void Dynamics2dWorld::Advance(int steps)
{
  if (must_find_groups_) FindGroups();
  KeepStarts();
  const double seconds = tick_ / steps;
  RunGroups(seconds, steps, isolated_);
  while (MergeGroups(seconds, steps)) RunGroups(seconds, steps, {});
  KeepContacts();
}

void Dynamics2dWorld::KeepStarts()
{
  starts_.clear();
  for (const std::uint32_t number : moving_)
  {
    Body& body = bodies_[number];
    body.measures = {};
    starts_.push_back({body.state, body.ground, body.grip_forces, body.turret_angle, body.held_angle});
  }
}

// Gives a body the state in which it began the tick.
void Dynamics2dWorld::ReturnToStart(std::size_t moving)
{
  Body& body = bodies_[moving_[moving]];
  const TickStart& start = starts_[moving];
  body.state = start.state;
  body.heading = SinCosOf(start.state.angle);
  body.ground = start.ground;
  body.grip_forces = start.grip_forces;
  body.turret_angle = start.turret_angle;
  body.held_angle = start.held_angle;
  body.measures = {};
}

// Makes the steps that are left of all groups, and all steps of the bodies `isolated`.
void Dynamics2dWorld::RunGroups(double seconds, int steps, std::span<const std::uint32_t> isolated)
{
  if (remote_ == nullptr || !remote_->AreReady()) return RunHere(seconds, steps, isolated, true);
  remote_->ForgetLoads();
  for (const std::uint32_t group : order_)
  {
    GroupRun& run = *runs_[run_of_group_[group]];
    if (run.steps_done < steps) remote_->Add(run);
  }
  remote_->Run(bodies_, settings_of_solver_, seconds, steps, [&] { RunHere(seconds, steps, isolated, false); });
}

void Dynamics2dWorld::RunHere(double seconds, int steps, std::span<const std::uint32_t> isolated, bool with_groups)
{
  // The largest groups come first, and isolated bodies last, so that the threads end at about the same time.
  const std::size_t groups = with_groups ? order_.size() : 0;
  const std::size_t tasks = groups + (isolated.size() + kChunk - 1) / kChunk;
  const auto work = [&](std::size_t task)
  {
    if (task < groups)
    {
      GroupRun& run = *runs_[run_of_group_[order_[task]]];
      if (run.steps_done < steps) SolveGroup(bodies_, run, settings_of_solver_, seconds, steps);
      return;
    }
    const std::size_t begin = (task - groups) * kChunk;
    for (const std::uint32_t number : isolated.subspan(begin, std::min(kChunk, isolated.size() - begin)))
      AdvanceIsolated(bodies_[number], seconds, steps);
  };
  WorkerPool* const pool = IfItShares(pool_);
  if (pool == nullptr || tasks < 2 || moving_.size() < kLeastShared)
  {
    for (std::size_t task = 0; task < tasks; ++task) work(task);
    return;
  }
  OneByOne(*pool, tasks, [&](std::size_t task, unsigned) { work(task); });
}

// Lists the contacts of all groups for the next tick.
void Dynamics2dWorld::KeepContacts()
{
  for (const Contact& contact : contacts_) contacts_of_[contact.a] = {0, 0};
  contacts_.clear();
  contact_count_ = 0;
  for (std::size_t group = 0; group < groups_.Count(); ++group)
    for (const Contact& contact : runs_[run_of_group_[group]]->contacts)
    {
      ContactRange& range = contacts_of_[contact.a];
      if (range.count == 0) range.first = static_cast<std::uint32_t>(contacts_.size());
      ++range.count;
      contact_count_ += contact.touches;
      contacts_.push_back(contact);
    }
}

}  // namespace swarmanoid::dynamics2d

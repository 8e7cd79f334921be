// Problem: solve each contact group by itself, so that its motion depends on no other group, thread or process. Do not
// spend the solver's time on the many bodies of a sparse swarm that meet no other one in a tick.
//
// Method: when a tick begins, each body gets an outline and the way that it can go by itself. Bodies whose outlines and
// ways are near form groups (contact_groups.h), and grips join groups. The solver makes all steps of a group at once,
// with the static bodies near it. The other bodies are isolated: dynamics2d_step.cpp moves them in closed form. A group
// stops if the solver is about to push a body farther than was allowed for. When all have ended, it goes on if the body
// can meet no other group in the steps that are left. Otherwise it becomes one with those that it can meet, and the new
// group begins the tick again.
//
// Invariant: groups follow from the states of the bodies and their grips. Source: docs/engines.md, its section on
// contact groups.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/math/elementary.h"
#include "engine_worker/engines/dynamics2d/dynamics2d_world.h"
#include "engine_worker/engines/dynamics2d/remote_groups.h"

namespace swarmanoid::dynamics2d
{
namespace
{

// Solved bodies may be pushed by this much (m) farther than they move by themselves.
constexpr double kPushed = 0.02;
// Polygons collide this far (m) around them, and both of a pair may have that skin.
constexpr double kSkin = 2 * kPolygonSkin;
// If a body goes faster than this (m/s), all bodies are one group: the cells around it would hold too many.
constexpr double kFastest = 2;

StaticOutline OutlineInPlane(const Body& body)
{
  const BodyState& state = body.state;
  if (body.model.radius > 0) return {{{state.x, state.y}}, body.model.radius};
  StaticOutline outline;
  const SinCos heading = SinCosOf(state.angle);
  for (const Corner& corner : body.corners)
    outline.corners.emplace_back(state.x + heading.cos * corner.x - heading.sin * corner.y,
                                 state.y + heading.sin * corner.x + heading.cos * corner.y);
  return outline;
}

}  // namespace

void Dynamics2dWorld::ConfigureSeparation()
{
  separation_is_configured_ = true;
  moving_.clear();
  fixed_.clear();
  outlines_.clear();
  is_pushable_.clear();
  in_moving_.assign(bodies_.size(), 0);
  std::vector<StaticOutline> statics;
  for (std::size_t i = 0; i < bodies_.size(); ++i)
  {
    Body& body = bodies_[i];
    if (body.model.motion == EMotion::kStatic)
    {
      body.heading = SinCosOf(body.state.angle);
      fixed_.push_back(static_cast<std::uint32_t>(i));
      statics.push_back(OutlineInPlane(body));
      continue;
    }
    in_moving_[i] = static_cast<std::uint32_t>(moving_.size());
    moving_.push_back(static_cast<std::uint32_t>(i));
    is_pushable_.push_back(body.model.motion == EMotion::kDynamic ? 1 : 0);
    Outline(body, tick_, outlines_.emplace_back());
  }
  no_groups_.assign(moving_.size(), ContactGroups::kAlone);
  separation_.Configure(outlines_, std::move(statics), kFastest * tick_ + settings_.grip_distance);
}

void Dynamics2dWorld::BeginTick(double seconds)
{
  if (seconds != tick_) separation_is_configured_ = false;
  tick_ = seconds;
  FindGroups();
}

// Finds the groups of the tick.
void Dynamics2dWorld::FindGroups()
{
  must_find_groups_ = false;
  if (!separation_is_configured_) ConfigureSeparation();
  ForEach(moving_.size(), [&](std::size_t k) { Outline(bodies_[moving_[k]], tick_, outlines_[k]); });
  links_.clear();
  for (std::size_t k = 0; k < moving_.size(); ++k)
  {
    const Body& body = bodies_[moving_[k]];
    if (body.gripped != kNoBody) links_.push_back({static_cast<std::uint32_t>(k), in_moving_[Index(body.gripped)]});
  }
  SearchGroups();
  ListIsolated();
  free_runs_.resize(runs_.size());
  std::iota(free_runs_.rbegin(), free_runs_.rend(), 0U);
  run_of_group_.clear();
  for (std::size_t group = 0; group < groups_.Count(); ++group) BeginRun(group);
  SortGroups();
}

void Dynamics2dWorld::SearchGroups()
{
  const double margin = kSkin + settings_.grip_distance;
  const double pushed = kPushed + kSkin;
  are_all_in_one_ = !separation_.FindPairs(outlines_, std::max(margin, 2 * pushed), pairs_);
  if (are_all_in_one_)
    groups_.FindOne(is_pushable_, static_cast<std::uint32_t>(fixed_.size()));
  else
    groups_.Find({margin, 0, pushed, pairs_, links_, is_pushable_, no_groups_});
}

void Dynamics2dWorld::ListIsolated()
{
  isolated_.clear();
  for (std::size_t k = 0; k < moving_.size(); ++k)
    if (groups_.GroupOf(static_cast<std::uint32_t>(k)) == ContactGroups::kAlone && is_pushable_[k] != 0)
      isolated_.push_back(moving_[k]);
}

// Gives the next group a run from the start of the tick, and the contacts of the last tick.
void Dynamics2dWorld::BeginRun(std::size_t group)
{
  if (free_runs_.empty())
  {
    free_runs_.push_back(static_cast<std::uint32_t>(runs_.size()));
    runs_.push_back(std::make_unique<GroupRun>());
  }
  run_of_group_.push_back(free_runs_.back());
  free_runs_.pop_back();
  GroupRun& run = *runs_[run_of_group_.back()];
  run.bodies.clear();
  run.ways.clear();
  run.fixed.clear();
  run.contacts.clear();
  run.steps_done = 0;
  run.goes_too_far = false;
  run.is_bounded = !are_all_in_one_;
  for (const std::uint32_t k : groups_.Bodies(group))
  {
    const Body& body = bodies_[moving_[k]];
    run.bodies.push_back(moving_[k]);
    const double pushed = is_pushable_[k] != 0 ? kPushed : 0;
    run.ways.push_back({body.state.x, body.state.y, body.state.angle, outlines_[k].whole.way + pushed});
    const ContactRange range = contacts_of_[moving_[k]];
    const auto first = contacts_.begin() + range.first;
    run.contacts.insert(run.contacts.end(), first, first + range.count);
  }
  for (const std::uint32_t number : groups_.Fixed(group)) run.fixed.push_back(fixed_[number]);
}

// Joins groups in the middle of a tick. A group that stopped, since a body goes too far, may meet others in the steps
// that are left. It goes on if it meets none. If it does, the new group begins the tick again. Returns false if all
// groups have made all steps.
bool Dynamics2dWorld::MergeGroups(double step_seconds, int steps)
{
  bool is_any_left = false;
  for (std::size_t group = 0; group < groups_.Count(); ++group)
    is_any_left = is_any_left || runs_[run_of_group_[group]]->steps_done < steps;
  if (!is_any_left) return false;

  links_.clear();
  run_of_moving_.assign(moving_.size(), kNoRun);
  for (std::size_t group = 0; group < groups_.Count(); ++group)
  {
    const std::span<const std::uint32_t> bodies = groups_.Bodies(group);
    for (std::size_t i = 1; i < bodies.size(); ++i) links_.push_back({bodies[i - 1], bodies[i]});
    for (const std::uint32_t k : bodies) run_of_moving_[k] = run_of_group_[group];
    const int left = steps - runs_[run_of_group_[group]]->steps_done;
    for (std::size_t i = 0; left > 0 && i < bodies.size(); ++i) LetGoOn(bodies[i], left * step_seconds);
  }
  SearchGroups();
  // A group that has grown begins again. The runs of its parts are free when all its bodies are back at their starts.
  run_before_.clear();
  for (std::size_t group = 0; group < groups_.Count(); ++group)
  {
    const std::span<const std::uint32_t> bodies = groups_.Bodies(group);
    const std::uint32_t run = run_of_moving_[bodies.front()];
    const bool goes_on = run != kNoRun && runs_[run]->bodies.size() == bodies.size();
    run_before_.push_back(goes_on ? run : kNoRun);
    if (goes_on) continue;
    for (const std::uint32_t k : bodies)
    {
      ReturnToStart(k);
      const std::uint32_t part = run_of_moving_[k];
      if (part == kNoRun || runs_[part]->bodies.empty()) continue;
      runs_[part]->bodies.clear();
      free_runs_.push_back(part);
    }
  }
  run_of_group_.clear();
  for (std::size_t group = 0; group < groups_.Count(); ++group)
    if (run_before_[group] == kNoRun)
      BeginRun(group);
    else
      GoOn(group, run_before_[group]);
  SortGroups();
  return true;
}

// Lets a group go on with the ways that LetGoOn has set.
void Dynamics2dWorld::GoOn(std::size_t group, std::uint32_t number)
{
  run_of_group_.push_back(number);
  GroupRun& run = *runs_[number];
  run.goes_too_far = false;
  const std::span<const std::uint32_t> bodies = groups_.Bodies(group);
  for (std::size_t i = 0; i < bodies.size(); ++i)
    run.ways[i].most = outlines_[bodies[i]].whole.way + (is_pushable_[bodies[i]] != 0 ? kPushed : 0);
  run.fixed.clear();
  for (const std::uint32_t fixed : groups_.Fixed(group)) run.fixed.push_back(fixed_[fixed]);
}

// Allows a body of a group that stopped to go on for `seconds`. The way from the start of the tick grows, since the
// other groups may be at any of their steps.
void Dynamics2dWorld::LetGoOn(std::uint32_t moving, double seconds)
{
  Body& body = bodies_[moving_[moving]];
  MovingOutline ahead;
  Outline(body, seconds, ahead);
  const BodyState& now = body.state;
  const BodyState& start = starts_[moving].state;
  const double gone = Length(now.x - start.x, now.y - start.y);
  const double turned = body.arm * std::abs(now.angle - start.angle);
  MovingOutline& outline = outlines_[moving];
  outline.whole.way = std::max(outline.whole.way, gone + turned + ahead.whole.way);
  outline.parts[0].way = std::max(outline.parts[0].way, gone + ahead.parts[0].way);
  outline.parts[1].way = std::max(outline.parts[1].way, gone + turned + ahead.parts[1].way);
}

// Lists the groups in the order in which they are dealt out, the largest first.
void Dynamics2dWorld::SortGroups()
{
  order_.resize(groups_.Count());
  std::iota(order_.begin(), order_.end(), 0U);
  std::ranges::sort(order_,
                    [&](std::uint32_t a, std::uint32_t b)
                    {
                      const std::size_t size_a = groups_.Bodies(a).size();
                      const std::size_t size_b = groups_.Bodies(b).size();
                      return size_a > size_b || (size_a == size_b && a < b);
                    });
}

// Sets the heading of a body, its outline at its position, and how far the body can move by itself within `seconds`.
void Dynamics2dWorld::Outline(Body& body, double seconds, MovingOutline& outline) const
{
  const BodyModel& model = body.model;
  const BodyState& state = body.state;
  body.heading = SinCosOf(state.angle);
  outline.present = body.solid;
  double speed = Length(state.vx, state.vy);
  double turn = std::abs(state.turn);
  if (model.motion == EMotion::kDynamic)
  {
    speed = std::max(speed, Length(body.drive.forward, body.drive.left));
    turn = std::max(turn, std::abs(body.drive.turn)) + std::abs(body.turret_speed);
  }
  const double way = speed * seconds;
  const double swept = way + turn * seconds * body.arm;
  outline.whole = {state.x, state.y, body.radius, swept};
  outline.part_count = model.has_gripper && model.radius > 0 ? 2 : 0;
  if (outline.part_count == 0) return;
  const double turret_angle = TurretAngleOf(static_cast<int>(&body - bodies_.data()));
  SinCos front = body.heading;
  if (turret_angle != 0) front = SinCosOf(state.angle + turret_angle);
  outline.parts = {
      {{state.x, state.y, model.radius, way},
       {state.x + kGripperMiddle * front.cos, state.y + kGripperMiddle * front.sin, kGripperRadius, swept}}};
}

}  // namespace swarmanoid::dynamics2d

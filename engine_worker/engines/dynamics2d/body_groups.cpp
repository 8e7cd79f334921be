// Problem: solve each contact group by itself, so that its motion depends on no other group, thread or process. Do not
// spend the solver's time on the many bodies of a sparse swarm that meet no other one in a tick.
//
// Method: when a tick begins, each body gets an outline and the way that it can go by itself. Bodies whose outlines and
// ways are near form groups (contact_groups.h), and grips join groups. Each group has a world of Box2D with its bodies
// and the static bodies near them, which makes all steps of the tick at once. The other bodies are isolated:
// dynamics2d_step.cpp moves them in closed form. A group stops if the solver is about to push a body farther than was
// allowed for. When all have ended, it goes on if the body can meet no other group in the steps that are left.
// Otherwise it becomes one with those that it can meet, and the new group begins the tick again.
//
// A group takes over the world that has most of its bodies, unless another group has more of them there: impulses that
// Box2D remembers stay, and a large group does not pay for each body that comes or goes. Bodies that come are made from
// their states, in the order of the entities.
//
// Invariants: groups and worlds follow from the states and the groups before, and Rebuild forgets the groups. A body is
// isolated at a larger gap than that at which it stays isolated, so that few change sides. Source: docs/engines.md, its
// section on contact groups.
#include <algorithm>
#include <cmath>
#include <functional>
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
// Box2D lets bodies touch that are this far (m) apart: polygons have a skin.
constexpr double kSkin = 0.002;
// A pair that has a world keeps it at a gap that is larger by this much (m).
constexpr double kBand = 0.005;
// If a body goes faster than this (m/s), all bodies are one group: the cells around it would hold too many.
constexpr double kFastest = 2;

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
    const Body& body = bodies_[i];
    if (body.model.motion == EMotion::kStatic)
    {
      const BodyState& state = body.start;
      fixed_.push_back(static_cast<std::uint32_t>(i));
      statics.push_back(OutlineIn(body.model, state.x / kUnitsPerMetre, state.y / kUnitsPerMetre, state.angle));
      continue;
    }
    in_moving_[i] = static_cast<std::uint32_t>(moving_.size());
    moving_.push_back(static_cast<std::uint32_t>(i));
    is_pushable_.push_back(body.model.motion == EMotion::kDynamic ? 1 : 0);
    Outline(body, tick_, outlines_.emplace_back());
  }
  separation_.Configure(outlines_, std::move(statics), kFastest * tick_ + settings_.grip_distance);
}

void Dynamics2dWorld::BeginTick(double seconds)
{
  if (seconds != tick_) separation_is_configured_ = false;
  tick_ = seconds;
  FindGroups();
}

// Finds the groups of the tick, and puts their bodies into worlds.
void Dynamics2dWorld::FindGroups()
{
  must_find_groups_ = false;
  starts_.clear();
  if (!separation_is_configured_) ConfigureSeparation();
  ForEach(moving_.size(), [&](std::size_t k) { Outline(bodies_[moving_[k]], tick_, outlines_[k]); });
  links_.clear();
  world_before_.clear();
  for (std::size_t k = 0; k < moving_.size(); ++k)
  {
    const Body& body = bodies_[moving_[k]];
    world_before_.push_back(body.world);
    if (body.gripped != kNoBody) links_.push_back({static_cast<std::uint32_t>(k), in_moving_[Index(body.gripped)]});
  }
  SearchGroups();
  PlaceGroups();
  for (std::size_t group = 0; group < groups_.Count(); ++group) WorldOf(group).steps_done = 0;
}

// Joins groups in the middle of a tick. A group that stopped, since a body goes too far, may meet others in the steps
// that are left. It goes on if it meets none. If it does, the new group begins the tick again. Returns false if all
// groups have made all steps.
bool Dynamics2dWorld::MergeGroups(double step_seconds, int steps)
{
  bool is_any_left = false;
  links_.clear();
  for (std::size_t group = 0; group < groups_.Count(); ++group)
  {
    const std::span<const std::uint32_t> bodies = groups_.Bodies(group);
    for (std::size_t i = 1; i < bodies.size(); ++i) links_.push_back({bodies[i - 1], bodies[i]});
    const int left = steps - WorldOf(group).steps_done;
    if (left == 0) continue;
    is_any_left = true;
    for (const std::uint32_t k : bodies) LetGoOn(k, left * step_seconds);
  }
  if (!is_any_left) return false;

  for (std::size_t k = 0; k < moving_.size(); ++k) world_before_[k] = bodies_[moving_[k]].world;
  SearchGroups();
  links_.clear();
  for (std::size_t group = 0; group < groups_.Count(); ++group)
  {
    const std::span<const std::uint32_t> bodies = groups_.Bodies(group);
    const std::uint32_t world = world_before_[bodies.front()];
    if (world != ContactGroups::kAlone && worlds_[world]->size == bodies.size()) continue;
    for (const std::uint32_t k : bodies)
    {
      Body& body = bodies_[moving_[k]];
      if (body.world != ContactGroups::kAlone) TakeOut(body);
      ReturnToStart(k);
      world_before_[k] = ContactGroups::kAlone;
      if (body.gripped != kNoBody) links_.push_back({k, in_moving_[Index(body.gripped)]});
    }
  }
  PlaceGroups();
  return true;
}

// Allows a body of a group that stopped to go on for `seconds`. The way from the start of the tick grows, since the
// other groups may be at any of their steps.
void Dynamics2dWorld::LetGoOn(std::uint32_t moving, double seconds)
{
  const Body& body = bodies_[moving_[moving]];
  MovingOutline ahead;
  Outline(body, seconds, ahead);
  const BodyState now = StateOf(body);
  const BodyState& start = starts_[moving].state;
  const double gone = Length(now.x - start.x, now.y - start.y) / kUnitsPerMetre;
  const double turned = ArmOf(body.model) * std::abs(now.angle - start.angle);
  MovingOutline& outline = outlines_[moving];
  outline.whole.way = std::max(outline.whole.way, gone + turned + ahead.whole.way);
  outline.parts[0].way = std::max(outline.parts[0].way, gone + ahead.parts[0].way);
  outline.parts[1].way = std::max(outline.parts[1].way, gone + turned + ahead.parts[1].way);
}

void Dynamics2dWorld::SearchGroups()
{
  const double margin = kSkin + settings_.grip_distance;
  const double pushed = kPushed + kSkin;
  const double limit = std::max(margin + kBand, 2 * pushed);
  are_all_in_one_ = !separation_.FindPairs(outlines_, limit, pairs_);
  if (are_all_in_one_)
    groups_.FindOne(is_pushable_, static_cast<std::uint32_t>(fixed_.size()));
  else
    groups_.Find({margin, kBand, pushed, pairs_, links_, is_pushable_, world_before_});
}

// Puts the bodies of groups_ into worlds, and notes how far they may get.
void Dynamics2dWorld::PlaceGroups()
{
  AssignWorlds();
  MoveToWorlds();
  UpdateFixed();
  for (const BodyLink& link : links_)
  {
    Body& body = bodies_[moving_[link.first]];
    if (body.is_joined) continue;
    BuildGrip(body);
    TurnGripper(body);
  }

  isolated_.clear();
  for (std::size_t k = 0; k < moving_.size(); ++k)
    if (groups_.GroupOf(static_cast<std::uint32_t>(k)) == ContactGroups::kAlone && is_pushable_[k] != 0)
      isolated_.push_back(moving_[k]);
  for (std::size_t group = 0; group < groups_.Count(); ++group)
  {
    GroupWorld& world = WorldOf(group);
    world.size = groups_.Bodies(group).size();
    world.dynamic.clear();
    world.ways.clear();
    world.goes_too_far = false;
    for (const std::uint32_t k : groups_.Bodies(group))
    {
      if (is_pushable_[k] == 0) continue;
      const BodyState state = starts_.empty() ? StateOf(bodies_[moving_[k]]) : starts_[k].state;
      world.dynamic.push_back(moving_[k]);
      world.ways.push_back({state.x, state.y, state.angle, (outlines_[k].whole.way + kPushed) * kUnitsPerMetre});
    }
  }
}

// Chooses the world of each group.
void Dynamics2dWorld::AssignWorlds()
{
  world_of_group_.assign(groups_.Count(), ContactGroups::kAlone);
  claims_.assign(worlds_.size(), {ContactGroups::kAlone, 0});
  votes_.assign(worlds_.size(), 0);
  for (std::size_t group = 0; group < groups_.Count(); ++group)
  {
    std::uint32_t best = ContactGroups::kAlone;
    for (const std::uint32_t k : groups_.Bodies(group))
    {
      const std::uint32_t world = world_before_[k];
      if (world == ContactGroups::kAlone) continue;
      ++votes_[world];
      if (best == ContactGroups::kAlone || votes_[world] > votes_[best]) best = world;
    }
    if (best != ContactGroups::kAlone && votes_[best] > claims_[best].bodies)
      claims_[best] = {static_cast<std::uint32_t>(group), votes_[best]};
    for (const std::uint32_t k : groups_.Bodies(group))
      if (world_before_[k] != ContactGroups::kAlone) votes_[world_before_[k]] = 0;
  }
  for (std::size_t world = 0; world < claims_.size(); ++world)
    if (claims_[world].bodies > 0) world_of_group_[claims_[world].group] = static_cast<std::uint32_t>(world);
}

void Dynamics2dWorld::MoveToWorlds()
{
  // All bodies leave before others come, and worlds without a group end.
  changed_.clear();
  for (std::size_t k = 0; k < moving_.size(); ++k)
  {
    const std::uint32_t group = groups_.GroupOf(static_cast<std::uint32_t>(k));
    const std::uint32_t world = group == ContactGroups::kAlone ? ContactGroups::kAlone : world_of_group_[group];
    Body& body = bodies_[moving_[k]];
    if (body.world == world && world != ContactGroups::kAlone) continue;
    if (body.world != ContactGroups::kAlone) TakeOut(body);
    if (group != ContactGroups::kAlone) changed_.push_back(static_cast<std::uint32_t>(k));
  }
  for (std::uint32_t world = 0; world < claims_.size(); ++world)
  {
    if (claims_[world].bodies > 0 || !worlds_[world]->IsOpen()) continue;
    CloseWorld(world);
    free_worlds_.push_back(world);
  }
  OpenWorlds();
  for (const std::uint32_t k : changed_)
  {
    Body& body = bodies_[moving_[k]];
    body.world = world_of_group_[groups_.GroupOf(k)];
    body.b2 = BuildIn(*worlds_[body.world], moving_[k]);
  }
}

// Opens a world for each group that has none.
void Dynamics2dWorld::OpenWorlds()
{
  const bool are_remote = remote_ != nullptr && remote_->AreReady();
  if (are_remote)
  {
    remote_->ForgetLoads();
    for (std::size_t group = 0; group < groups_.Count(); ++group)
      if (world_of_group_[group] != ContactGroups::kAlone && WorldOf(group).remote)
        remote_->AddLoad(WorldOf(group).remote->region, groups_.Bodies(group).size());
  }
  SortGroups();
  for (const std::uint32_t group : order_)
  {
    std::uint32_t& world = world_of_group_[group];
    if (world != ContactGroups::kAlone) continue;
    if (free_worlds_.empty())
    {
      free_worlds_.push_back(static_cast<std::uint32_t>(worlds_.size()));
      worlds_.push_back(std::make_unique<GroupWorld>());
    }
    world = free_worlds_.back();
    free_worlds_.pop_back();
    if (are_remote)
      worlds_[world]->OpenIn(remote_->ChooseRegion(groups_.Bodies(group).size()));
    else
      worlds_[world]->Open();
  }
}

// Lists the groups in the order in which they are dealt out, the largest first.
void Dynamics2dWorld::SortGroups()
{
  order_.resize(groups_.Count());
  std::iota(order_.begin(), order_.end(), 0U);
  std::ranges::stable_sort(order_, std::ranges::greater(),
                           [&](std::uint32_t group) { return groups_.Bodies(group).size(); });
}

void Dynamics2dWorld::CloseWorld(std::uint32_t number)
{
  GroupWorld& world = *worlds_[number];
  if (world.remote) remote_->Close(world.remote->region, number);
  world.Close();
}

// Ends all worlds. The states of their bodies were saved before.
void Dynamics2dWorld::CloseWorlds()
{
  free_worlds_.clear();
  for (std::uint32_t world = 0; world < worlds_.size(); ++world)
  {
    CloseWorld(world);
    free_worlds_.push_back(world);
  }
}

// Gives each group the static bodies that are near it, and takes away the bodies that no longer are.
void Dynamics2dWorld::UpdateFixed()
{
  for (std::size_t group = 0; group < groups_.Count(); ++group)
  {
    GroupWorld& world = WorldOf(group);
    const std::span<const std::uint32_t> wanted = groups_.Fixed(group);
    const auto body_of = [&](std::uint32_t number) { return fixed_[number]; };
    if (std::ranges::equal(world.fixed, wanted, {}, &GroupWorld::Fixed::body, body_of)) continue;
    std::erase_if(world.fixed,
                  [&](const GroupWorld::Fixed& fixed)
                  {
                    if (std::ranges::binary_search(wanted, fixed.body, {}, body_of)) return false;
                    if (world.remote)
                      Order(world, EGroupOrder::kTakeOut, fixed.body);
                    else
                      world.box2d->DestroyBody(fixed.b2);
                    return true;
                  });
    const std::size_t kept = world.fixed.size();
    for (const std::uint32_t number : wanted)
    {
      const auto known = std::span(world.fixed).first(kept);
      if (std::ranges::binary_search(known, fixed_[number], {}, &GroupWorld::Fixed::body)) continue;
      world.fixed.push_back({fixed_[number], BuildIn(world, fixed_[number])});
    }
    std::ranges::sort(world.fixed, {}, &GroupWorld::Fixed::body);
  }
}

// Takes a body out of its world, with its joints.
void Dynamics2dWorld::TakeOut(Body& body)
{
  body.start = StateOf(body);
  GroupWorld& world = *worlds_[body.world];
  if (world.remote)
    Order(world, EGroupOrder::kTakeOut, static_cast<std::uint32_t>(&body - bodies_.data()));
  else
    world.box2d->DestroyBody(body.b2);
  LeaveOut(body);
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

void Dynamics2dWorld::LeaveOut(Body& body)
{
  body.world = ContactGroups::kAlone;
  body.b2 = nullptr;
  body.ground = nullptr;
  body.gripper = nullptr;
  body.joint = nullptr;
  body.is_joined = false;
}

bool Dynamics2dWorld::IsTooFar(const Body& body, const GroupWorld::Way& way, double seconds) const
{
  const BodyState state = StateOf(body);
  const double arm = ArmOf(body.model) * kUnitsPerMetre;
  const double gone = Length(state.x - way.x, state.y - way.y) + arm * std::abs(state.angle - way.angle);
  const double next = Length(state.vx, state.vy) + arm * std::abs(state.turn);
  return gone + seconds * next > way.most;
}

}  // namespace swarmanoid::dynamics2d

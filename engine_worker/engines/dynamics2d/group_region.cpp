// Executes the orders for groups and writes the results. Dynamics2dWorld does the work, by the same functions as in an
// engine that is not split.
#include "engine_worker/engines/dynamics2d/group_region.h"

#include <algorithm>
#include <cmath>

namespace swarmanoid::dynamics2d
{
namespace
{

constexpr std::uint32_t kMostThreads = 64;
constexpr std::int32_t kMostPasses = 1000000;

template <class Members>
auto PlaceOf(Members& members, std::uint32_t number)
{
  return std::ranges::lower_bound(members, number, {}, [](const auto& member) { return member.number; });
}

std::vector<Vector2> GetPolygon(ByteReader& orders)
{
  std::vector<Vector2> polygon(orders.Get<std::uint8_t>());
  if (polygon.size() > b2_maxPolygonVertices || (!polygon.empty() && polygon.size() < 3))
    RefuseGroup("an outline has too many or too few corners");
  for (Vector2& corner : polygon)
  {
    corner.x() = orders.Get<double>();
    corner.y() = orders.Get<double>();
  }
  return polygon;
}

BodyModel GetModel(ByteReader& orders)
{
  BodyModel model;
  const auto motion = orders.Get<std::uint8_t>();
  if (motion > static_cast<int>(EMotion::kStatic)) RefuseGroup("a body moves in an unknown way");
  model.motion = static_cast<EMotion>(motion);
  for (bool* const flag : {&model.lies, &model.has_gripper, &model.has_turret_motor, &model.grips_by_rod})
    *flag = orders.Get<std::uint8_t>() != 0;
  for (double* const value : {&model.radius, &model.mass, &model.inertia, &model.friction, &model.restitution,
                              &model.ground_force, &model.ground_torque})
    *value = orders.Get<double>();
  model.polygon = GetPolygon(orders);
  if ((model.radius > 0) != model.polygon.empty()) RefuseGroup("a body has no outline, or two");
  return model;
}

}  // namespace

GroupReplica::GroupReplica(const RegionSettings& settings)
    : world_({settings.velocity_iterations, settings.position_iterations, settings.turret_torque, 0})
{
  world_.measures_loads_ = settings.measures_loads != 0;
  world_.worlds_.push_back(std::make_unique<GroupWorld>());
  world_.world_of_group_ = {0};
  Group().Open();
}

void GroupReplica::Execute(std::span<const char> bytes)
{
  ByteReader orders(bytes);
  while (!orders.AtEnd())
  {
    const auto order = orders.Get<EGroupOrder>();
    if (order == EGroupOrder::kSteps)
    {
      MakeSteps(orders);
      continue;
    }
    const auto number = orders.Get<std::uint32_t>();
    if (order == EGroupOrder::kBuild)
      BuildBody(number, orders);
    else if (order == EGroupOrder::kTakeOut)
      TakeOut(number);
    else
      Change(order, number, orders);
  }
}

// Returns the number in world_ of a body. A body that was not known yet gets one.
std::uint32_t GroupReplica::OwnNumber(std::uint32_t number)
{
  const auto place = PlaceOf(known_, number);
  if (place != known_.end() && place->number == number) return place->own;
  const auto own = static_cast<std::uint32_t>(world_.bodies_.size());
  known_.insert(place, {number, own});
  world_.bodies_.emplace_back();
  return own;
}

void GroupReplica::ReadGrip(Dynamics2dWorld::Body& body, ByteReader& orders)
{
  Dynamics2dWorld::GetGrip(body, orders);
  if (body.gripped < kNoBody) RefuseGroup("a body holds a body that does not exist");
  if (body.gripped != kNoBody) body.gripped = static_cast<int>(OwnNumber(static_cast<std::uint32_t>(body.gripped)));
}

void GroupReplica::BuildBody(std::uint32_t number, ByteReader& orders)
{
  const std::uint32_t own = OwnNumber(number);
  if (world_.bodies_[own].b2 != nullptr) RefuseGroup("a body comes twice");
  Dynamics2dWorld::Body body;
  body.model = GetModel(orders);
  Dynamics2dWorld::GetMotion(body, orders);
  ReadGrip(body, orders);
  body.half_axle = orders.Get<double>();
  body.ordered = orders.Get<Dynamics2dWorld::Command>();
  body.drive = body.ordered.drive;
  body.turret_speed = body.ordered.turret_speed;
  body.world = 0;
  world_.bodies_[own] = std::move(body);
  world_.bodies_[own].b2 = world_.BuildIn(Group(), own);
  if (world_.bodies_[own].model.motion != EMotion::kStatic) moving_.insert(PlaceOf(moving_, number), {number, own});
}

void GroupReplica::TakeOut(std::uint32_t number)
{
  Dynamics2dWorld::Body& body = world_.bodies_[OwnNumber(number)];
  if (body.b2 == nullptr) RefuseGroup("a body leaves that is not there");
  world_.TakeOut(body);
  const auto place = PlaceOf(moving_, number);
  if (place != moving_.end() && place->number == number) moving_.erase(place);
}

void GroupReplica::Change(EGroupOrder order, std::uint32_t number, ByteReader& orders)
{
  const std::uint32_t own = OwnNumber(number);
  if (world_.bodies_[own].b2 == nullptr) RefuseGroup("a body changes that is not there");
  const std::vector<Vector2> polygon = order == EGroupOrder::kSetOutline ? GetPolygon(orders) : std::vector<Vector2>();
  Dynamics2dWorld::GetMotion(world_.bodies_[own], orders);
  Dynamics2dWorld::Body grip;
  ReadGrip(grip, orders);
  Dynamics2dWorld::Body& body = world_.bodies_[own];
  body.gripped = grip.gripped;
  body.grip = grip.grip;
  const Dynamics2dWorld::BodyState& to = body.start;
  switch (order)
  {
    case EGroupOrder::kPlace:
      if (b2Vec2(to.x, to.y) != body.b2->GetPosition() || to.angle != body.b2->GetAngle())
        body.b2->SetTransform({to.x, to.y}, to.angle);
      return;
    case EGroupOrder::kSetVelocity:
      body.b2->SetLinearVelocity({to.vx, to.vy});
      body.b2->SetAngularVelocity(to.turn);
      return;
    case EGroupOrder::kSetSolid:
      return body.b2->SetEnabled(body.solid);
    case EGroupOrder::kSetOutline:
      if (body.model.polygon.empty() || polygon.empty()) RefuseGroup("a body without corners gets other ones");
      return world_.SetPolygon(body, polygon);
    case EGroupOrder::kGrip:
      if (body.gripped == kNoBody || world_.bodies_[static_cast<std::size_t>(body.gripped)].b2 == nullptr)
        RefuseGroup("a body grips a body that is not there");
      return world_.BuildGrip(body);
    case EGroupOrder::kEndGrip:
      if (body.joint == nullptr) RefuseGroup("a body ends a grip that does not exist");
      return world_.EndGrip(body);
    case EGroupOrder::kTurnGripper:
      return world_.TurnGripper(body);
    case EGroupOrder::kBuild:
    case EGroupOrder::kTakeOut:
    case EGroupOrder::kSteps:
      break;
  }
  RefuseGroup("an order is unknown");
}

void GroupReplica::MakeSteps(ByteReader& orders)
{
  const auto seconds = orders.Get<double>();
  const auto steps = orders.Get<std::int32_t>();
  GroupWorld& group = Group();
  group.steps_done = orders.Get<std::int32_t>();
  group.goes_too_far = false;
  world_.are_all_in_one_ = orders.Get<std::uint8_t>() != 0;
  const bool begins = group.steps_done == 0;
  if (!(seconds > 0) || steps < 1 || group.steps_done < 0) RefuseGroup("a tick has no steps");
  group.dynamic.clear();
  for (const Member& member : moving_)
    if (world_.bodies_[member.own].model.motion == EMotion::kDynamic) group.dynamic.push_back(member.own);
  if (orders.Get<std::uint32_t>() != group.dynamic.size() || (!begins && group.ways.size() != group.dynamic.size()))
    RefuseGroup("a group has other bodies");
  group.ways.resize(group.dynamic.size());
  for (std::size_t i = 0; i < group.dynamic.size(); ++i)
  {
    Dynamics2dWorld::Body& body = world_.bodies_[group.dynamic[i]];
    if (begins)
    {
      const Dynamics2dWorld::BodyState state = Dynamics2dWorld::StateOf(body);
      group.ways[i] = {state.x, state.y, state.angle, 0};
      body.measures = {};
    }
    group.ways[i].most = orders.Get<double>();
    if (orders.Get<std::uint8_t>() == 0) continue;
    const auto command = orders.Get<Dynamics2dWorld::Command>();
    body.drive = command.drive;
    body.turret_speed = command.turret_speed;
  }
  world_.RunGroup(group, seconds, steps);
}

void GroupReplica::PutResult(ByteWriter& result) const
{
  const GroupWorld& group = *world_.worlds_.front();
  result.Put(static_cast<std::int32_t>(group.steps_done));
  result.Put(static_cast<std::uint8_t>(group.goes_too_far ? 1 : 0));
  result.Put(static_cast<std::int32_t>(world_.ContactCount()));
  for (const Member& member : moving_)
  {
    const Dynamics2dWorld::Body& body = world_.bodies_[member.own];
    Dynamics2dWorld::PutMotion(body, result);
    world_.PutMeasures(body, result);
  }
}

void GroupRegion::ReadSettings(ByteReader& task)
{
  groups_.clear();
  settings_ = task.Get<RegionSettings>();
  const auto is_sound = [](std::int32_t passes) { return passes >= 1 && passes <= kMostPasses; };
  if (!is_sound(settings_.velocity_iterations) || !is_sound(settings_.position_iterations) || settings_.threads < 1 ||
      settings_.threads > kMostThreads)
    RefuseGroup("the settings are not sound");
  if (settings_.threads == 1)
    pool_.reset();
  else if (pool_ == nullptr || pool_->Threads() != settings_.threads)
    pool_ = std::make_unique<WorkerPool>(settings_.threads);
}

void GroupRegion::Execute(std::span<const char> stream, ByteWriter& result)
{
  ByteReader task(stream);
  if (task.Get<std::uint8_t>() != 0)
    ReadSettings(task);
  else
    for (const std::uint32_t closed : task.GetArray<std::uint32_t>()) groups_.erase(closed);
  due_.clear();
  while (!task.AtEnd())
  {
    std::unique_ptr<GroupReplica>& group = groups_[task.Get<std::uint32_t>()];
    if (task.Get<std::uint8_t>() != 0) group = std::make_unique<GroupReplica>(settings_);
    if (group == nullptr) RefuseGroup("a region gets orders for a group that it does not have");
    due_.push_back({group.get(), task.GetImage<char>()});
  }
  // The engine sends the largest groups first, so that threads end at about the same time.
  ShareWork(pool_.get(), due_.size(), [&](std::size_t k) { due_[k].group->Execute(due_[k].orders); });
  for (const Due& of : due_) of.group->PutResult(result);
}

}  // namespace swarmanoid::dynamics2d

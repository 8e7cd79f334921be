// Problem: other processes solve groups, with the bits of one process, although Box2D's memory of contacts can neither
// be read nor set, and a process may be lost at any time.
//
// Method: what is done to the world of a group is written down as orders, from the moment when the world was opened. A
// region executes the new ones in each tick. A region that knows nothing executes all, tick by tick: the orders are the
// state of the world. A rebuild, every `canonical_period` ticks, ends all worlds and their orders.
//
// Invariants: a world is here or in one region from its begin to its end. While the regions are not ready (before the
// start, in recovery), worlds begin here. The engine knows the states of all bodies after each call of Run.
#include "engine_worker/engines/dynamics2d/remote_groups.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <string>

#include "engine_worker/engines/dynamics2d/dynamics2d_world.h"

namespace swarmanoid::dynamics2d
{
namespace
{

void PutModel(const BodyModel& model, ByteWriter& orders)
{
  for (const auto flag : {static_cast<int>(model.motion), model.lies ? 1 : 0, model.has_gripper ? 1 : 0,
                          model.has_turret_motor ? 1 : 0, model.grips_by_rod ? 1 : 0})
    orders.Put(static_cast<std::uint8_t>(flag));
  for (const double value : {model.radius, model.mass, model.inertia, model.friction, model.restitution,
                             model.ground_force, model.ground_torque})
    orders.Put(value);
  PutPolygon(model.polygon, orders);
}

}  // namespace

void PutPolygon(std::span<const Vector2> polygon, ByteWriter& orders)
{
  orders.Put(static_cast<std::uint8_t>(polygon.size()));
  for (const Vector2& corner : polygon)
  {
    orders.Put(corner.x());
    orders.Put(corner.y());
  }
}

void RefuseGroup(const char* reason)
{
  throw std::runtime_error(std::string("dynamics2d and its regions do not fit together: ") + reason);
}

RemoteGroups::RemoteGroups(RegionTeam& team, unsigned threads)
    : streams_(team), threads_(threads), closed_(team.RegionCount()), sent_(team.RegionCount())
{
}

void RemoteGroups::Run(RegionSettings settings, const std::function<void()>& meanwhile,
                       const std::function<void(std::uint32_t, ByteReader&)>& take)
{
  if (parts_.empty()) return meanwhile();
  settings.threads = threads_;
  streams_.Run([&](bool all_data, std::span<ByteWriter> streams) { Write(all_data, settings, streams); }, meanwhile);
  for (std::size_t region = 0; region < streams_.Count(); ++region)
  {
    closed_[region].clear();
    ByteReader result(streams_.ResultOf(region));
    for (const std::size_t part : sent_[region])
    {
      GroupWorld::Remote& remote = *parts_[part].world->remote;
      remote.done = remote.orders.Bytes().size();
      take(parts_[part].group, result);
    }
    if (!result.AtEnd()) RefuseGroup("a result does not end");
  }
  parts_.clear();
}

void RemoteGroups::Write(bool all_data, const RegionSettings& settings, std::span<ByteWriter> streams)
{
  for (std::size_t region = 0; region < streams.size(); ++region)
  {
    ByteWriter& stream = streams[region];
    sent_[region].clear();
    stream.Put(static_cast<std::uint8_t>(all_data ? 1 : 0));
    if (all_data)
      stream.Put(settings);
    else
      stream.PutArray(closed_[region]);
  }
  for (std::size_t k = 0; k < parts_.size(); ++k)
  {
    const GroupWorld::Remote& remote = *parts_[k].world->remote;
    const std::span<const char> orders(remote.orders.Bytes());
    const std::size_t done = all_data ? 0 : remote.done;
    if (done == orders.size()) continue;
    ByteWriter& stream = streams[remote.region];
    stream.Put(parts_[k].number);
    stream.Put(static_cast<std::uint8_t>(done == 0 ? 1 : 0));
    stream.PutArray(orders.subspan(done));
    sent_[remote.region].push_back(k);
  }
}

ByteWriter& Dynamics2dWorld::Order(GroupWorld& world, EGroupOrder order, std::uint32_t number)
{
  ByteWriter& orders = world.remote->orders;
  orders.Put(order);
  orders.Put(number);
  return orders;
}

// Returns false, and does nothing, if no region has the body.
bool Dynamics2dWorld::OrderChange(const Body& body, EGroupOrder order) const
{
  if (!IsRemote(body)) return false;
  ByteWriter& orders = Order(*worlds_[body.world], order, static_cast<std::uint32_t>(&body - bodies_.data()));
  if (order == EGroupOrder::kSetOutline) PutPolygon(body.model.polygon, orders);
  PutMotion(body, orders);
  PutGrip(body, orders);
  return true;
}

void Dynamics2dWorld::OrderBuild(GroupWorld& world, Body& body)
{
  ByteWriter& orders = Order(world, EGroupOrder::kBuild, static_cast<std::uint32_t>(&body - bodies_.data()));
  PutModel(body.model, orders);
  PutMotion(body, orders);
  PutGrip(body, orders);
  orders.Put(body.half_axle);
  body.ordered = {body.drive, body.turret_speed};
  orders.Put(body.ordered);
}

void Dynamics2dWorld::OrderSteps(std::size_t group, double seconds, int steps)
{
  GroupWorld& world = WorldOf(group);
  ByteWriter& orders = world.remote->orders;
  orders.Put(EGroupOrder::kSteps);
  orders.Put(seconds);
  orders.Put(static_cast<std::int32_t>(steps));
  orders.Put(static_cast<std::int32_t>(world.steps_done));
  orders.Put(static_cast<std::uint8_t>(are_all_in_one_ ? 1 : 0));
  orders.Put(static_cast<std::uint32_t>(world.dynamic.size()));
  for (std::size_t i = 0; i < world.dynamic.size(); ++i)
  {
    Body& body = bodies_[world.dynamic[i]];
    const Command command{body.drive, body.turret_speed};
    const bool is_other = std::memcmp(&command, &body.ordered, sizeof(Command)) != 0;
    orders.Put(world.ways[i].most);
    orders.Put(static_cast<std::uint8_t>(is_other ? 1 : 0));
    if (!is_other) continue;
    orders.Put(command);
    body.ordered = command;
  }
}

// The regions make the steps that are left of their groups, and this process does its own work meanwhile.
void Dynamics2dWorld::RunWithRegions(double seconds, int steps, const std::function<void()>& meanwhile)
{
  for (const std::uint32_t group : order_)
  {
    GroupWorld& world = WorldOf(group);
    if (!world.remote) continue;
    if (world.steps_done < steps) OrderSteps(group, seconds, steps);
    remote_->Add(group, world_of_group_[group], world);
  }
  remote_->Run({settings_.velocity_iterations, settings_.position_iterations, settings_.turret_torque,
                measures_loads_ ? 1U : 0U, 1},
               meanwhile, [&](std::uint32_t group, ByteReader& result) { TakeResult(group, result); });
}

void Dynamics2dWorld::TakeResult(std::size_t group, ByteReader& result)
{
  GroupWorld& world = WorldOf(group);
  world.steps_done = result.Get<std::int32_t>();
  world.goes_too_far = result.Get<std::uint8_t>() != 0;
  world.remote->contacts = result.Get<std::int32_t>();
  for (const std::uint32_t k : groups_.Bodies(group))
  {
    Body& body = bodies_[moving_[k]];
    GetMotion(body, result);
    GetMeasures(body, result);
  }
}

void Dynamics2dWorld::PutMeasures(const Body& body, ByteWriter& result) const
{
  if (body.half_axle > 0)
  {
    result.Put(body.measures.left_arc);
    result.Put(body.measures.right_arc);
  }
  if (measures_loads_ && body.model.has_gripper) result.Put(body.measures.load);
}

void Dynamics2dWorld::GetMeasures(Body& body, ByteReader& result) const
{
  if (body.half_axle > 0)
  {
    body.measures.left_arc = result.Get<double>();
    body.measures.right_arc = result.Get<double>();
  }
  if (measures_loads_ && body.model.has_gripper) body.measures.load = result.Get<TurretLoad>();
}

}  // namespace swarmanoid::dynamics2d

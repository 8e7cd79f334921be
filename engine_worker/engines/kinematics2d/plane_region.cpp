// Reads the tasks that region_tasks.cpp writes, has the plane of this region make the step, and writes the result.
#include "engine_worker/engines/kinematics2d/plane_region.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "common/experiment/experiment.h"
#include "engine_worker/engines/kinematics2d/region_border.h"
#include "engine_worker/engines/kinematics2d/region_messages.h"

namespace swarmanoid::kinematics2d
{

// The region refers to the plane.
struct PlaneRegion::World
{
  PlaneState plane;
  std::unique_ptr<Region> region;
};

namespace
{

constexpr std::uint32_t kMostThreads = 64;

// Makes a plane that has the followers alone, which have the returned numbers in the whole plane.
std::vector<std::uint32_t> ReadPlan(std::span<const char> bytes, PlaneState& plane)
{
  ByteReader plan(bytes);
  const auto start = plan.Get<PlanStart>();
  if (!start.grid.IsSound() || !(start.median_core >= 0) || !(start.smallest_limit > 0) || start.threads < 1 ||
      start.threads > kMostThreads)
    RefuseRegion("the plan of the plane is not sound");
  Bodies& bodies = plane.bodies;
  plane.contacts.elasticity = start.elasticity;
  bodies.median_core = start.median_core;
  bodies.smallest_limit = start.smallest_limit;
  bodies.keeps_travel = start.keeps_travel != 0;
  for (std::vector<CollisionModel>* models : {&bodies.models, &bodies.statics})
    for (auto count = plan.Get<std::uint64_t>(); count > 0; --count) models->push_back(GetModel(plan));
  std::vector<std::uint32_t> numbers;
  for (const FollowerPlan& follower : plan.GetArray<FollowerPlan>())
  {
    if (follower.model >= bodies.models.size() || (!numbers.empty() && follower.number <= numbers.back()))
      RefuseRegion("the plan has a mirror without a model or out of order");
    numbers.push_back(follower.number);
    bodies.Add(follower.model, {}, true);
  }
  if (!plan.AtEnd()) RefuseRegion("the plan does not end");
  plane.Start(start.grid, start.threads, nullptr);
  return numbers;
}

// The rates of turrets that turn; all others of this region stop.
void ReadTurretRates(Bodies& bodies, const RegionBodies& region, ByteReader& task)
{
  const auto rates = task.GetArray<TurretRate>();
  std::vector<std::uint32_t> stopped;
  auto rate = rates.begin();
  for (const Turret& turret : bodies.turrets)
  {
    if (!region.IsOwn(turret.body)) continue;
    const std::uint32_t number = region.NumberInWhole(turret.body);
    rate = std::find_if(rate, rates.end(), [&](const TurretRate& r) { return r.number >= number; });
    if (rate == rates.end() || rate->number != number) stopped.push_back(turret.body);
  }
  for (const std::uint32_t body : stopped) bodies.SetTurretRate(body, 0);
  for (const TurretRate& turning : rates) bodies.SetTurretRate(region.FindOwn(turning.number), turning.rate);
}

void ReadChanges(Bodies& bodies, RegionBodies& region, ByteReader& task)
{
  for (const ChangedBody& changed : task.GetArray<ChangedBody>())
  {
    const std::uint32_t body = region.FindOwn(changed.number);
    bodies.now.Set(body, changed.pose);
    bodies.is_present[body] = changed.is_present != 0 ? 1 : 0;
  }
  const std::span<const char> twists = task.GetImage<Twist>();
  const std::span<const std::uint32_t> own = region.ListOwn();
  if (twists.size() != own.size() * sizeof(Twist)) RefuseRegion("a task has twists of other bodies");
  for (std::size_t k = 0; k < own.size(); ++k)
  {
    Twist twist;
    std::memcpy(&twist, twists.data() + k * sizeof(Twist), sizeof(Twist));
    bodies.twists.Set(own[k], twist);
  }
  ReadTurretRates(bodies, region, task);
}

void WriteResult(const PlaneState& plane, RegionBodies& region, ByteWriter& result)
{
  const Bodies& bodies = plane.bodies;
  const std::span<const std::uint32_t> own = region.ListOwn();
  result.Put(plane.statistics);
  result.PutEach(own.size(), [&](std::size_t k) { return region.NumberInWhole(own[k]); });
  const auto put = [&](const auto& values)
  { result.PutEach(own.size(), [&](std::size_t k) { return values[own[k]]; }); };
  for (const std::vector<double>* values : {&bodies.now.x, &bodies.now.y, &bodies.now.z, &bodies.now.w}) put(*values);
  std::vector<TurretAngle> turrets;
  for (const Turret& turret : bodies.turrets)
    if (region.IsOwn(turret.body))
      turrets.push_back({region.NumberInWhole(turret.body), 0, bodies.turret_angle[turret.body]});
  result.PutArray(turrets);
  if (!bodies.keeps_travel) return;
  put(bodies.travel_forward);
  put(bodies.travel_turn);
}

void DoTask(PlaneState& plane, Region& region, bool all_data, ByteReader& task, ByteWriter& result)
{
  Bodies& bodies = plane.bodies;
  const auto seconds = task.Get<double>();
  const auto steps = task.Get<int>();
  if (const auto cuts = task.GetArray<std::uint8_t>(); !cuts.empty()) region.bodies.SetCuts(cuts);
  for (auto models = task.Get<std::uint64_t>(); models > 0; --models)
  {
    const auto model = task.Get<std::uint32_t>();
    CollisionModel outline = GetModel(task);
    if (model >= bodies.models.size()) RefuseRegion("a task replaces a model that does not exist");
    bodies.models[model] = std::move(outline);
  }
  const auto followers = task.GetArray<FollowerTask>();
  if (followers.size() != bodies.followers.size()) RefuseRegion("a task has other mirrors");
  for (std::size_t k = 0; k < followers.size(); ++k)
  {
    Follower& follower = bodies.followers[k];
    follower.from = followers[k].from;
    follower.goal = followers[k].goal;
    bodies.now.Set(follower.body, followers[k].now);
    bodies.is_present[follower.body] = followers[k].is_present != 0 ? 1 : 0;
  }
  region.bodies.SetGrips(task.GetArray<Grip>());
  if (all_data)
    region.bodies.TakeBodies(task);
  else
    ReadChanges(bodies, region.bodies, task);
  Advance(plane, seconds, steps, &region);
  WriteResult(plane, region.bodies, result);
}

}  // namespace

PlaneRegion::PlaneRegion(unsigned region, RegionExchange& exchange, unsigned halo)
    : number_(region), exchange_(exchange), halo_(halo)
{
  const unsigned regions = exchange.RegionCount();
  if (regions < 1 || regions > EngineSplit::kMostRegions || region >= regions)
    throw std::runtime_error("a plane can be cut into 1 to 32 regions, numbered from 0");
}

PlaneRegion::~PlaneRegion() = default;

std::size_t PlaneRegion::BodyCount() const { return world_ ? world_->plane.bodies.count : 0; }

void PlaneRegion::Work(std::span<const char> bytes, ByteWriter& result)
{
  ByteReader task(bytes);
  const auto start = task.Get<TaskStart>();
  if (start.tells_all != 0)
  {
    if (start.piece == 0)
    {
      plan_.clear();
      world_.reset();
    }
    const auto piece = task.GetArray<char>();
    plan_.insert(plan_.end(), piece.begin(), piece.end());
    if (start.is_plan_alone != 0) return;
    auto world = std::make_unique<World>();
    std::vector<std::uint32_t> followers = ReadPlan(plan_, world->plane);
    world->region = std::make_unique<Region>(world->plane, std::move(followers), number_, exchange_, halo_);
    world_ = std::move(world);
    std::exchange(plan_, {});
  }
  if (!world_) RefuseRegion("a region was sent a task before a plan");
  if (start.has_changes != 0) world_->region->bodies.ShareOutAnew();
  DoTask(world_->plane, *world_->region, start.tells_all != 0, task, result);
}

}  // namespace swarmanoid::kinematics2d

// Problem: keep the regions of a plane in step with the engine, and send as little as possible in each tick.
//
// Method: regions that know nothing get the plan of the plane (models, static shapes, cells, followers) and their
// bodies. There may be any number of walls, so the plan goes in pieces, one a task. After that a task has only changes:
// twists in the order of the region's last result, turret rates, bodies that were put elsewhere, mirrors, grips.
//
// Invariants: each body that is no follower is in exactly one result. A region that died makes the team call the
// writer again with `all_data`, and all regions start from the plan. region_messages.h has the forms.
#include "engine_worker/engines/kinematics2d/region_tasks.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "common/experiment/experiment.h"

namespace swarmanoid::kinematics2d
{
namespace
{

constexpr std::uint8_t kNoRegion = 0xff;
constexpr std::size_t kPieceOfPlan = 1 << 19;  // bytes

// Returns the part of the plane that stays unchanged while a region has its state, or that is replaced by name.
ByteWriter PlanOf(const PlaneState& plane)
{
  const Bodies& bodies = plane.bodies;
  ByteWriter plan;
  plan.Put(PlanStart{plane.contacts.broad.Grid(), plane.contacts.elasticity, bodies.median_core, bodies.smallest_limit,
                     plane.own_pool ? plane.threads : 1, bodies.keeps_travel});
  for (const std::vector<CollisionModel>* models : {&bodies.models, &bodies.statics})
  {
    plan.Put(static_cast<std::uint64_t>(models->size()));
    for (const CollisionModel& model : *models) PutModel(model, plan);
  }
  plan.PutEach(bodies.followers.size(),
               [&](std::size_t k)
               {
                 const std::uint32_t body = bodies.followers[k].body;
                 return FollowerPlan{body, bodies.model[body]};
               });
  return plan;
}

}  // namespace

RegionTasks::RegionTasks(const PlaneState& plane, RegionTeam& team)
    : team_(team), bodies_(team.RegionCount()), results_(team.RegionCount())
{
  if (team.RegionCount() < 1 || team.RegionCount() > EngineSplit::kMostRegions)
    throw std::runtime_error("a plane can be cut into 1 to 32 regions");
  region_of_body_.assign(plane.bodies.count, kNoRegion);
  SetCuts(plane, std::vector<std::uint8_t>(plane.contacts.broad.BlockCount(), 0));
}

void RegionTasks::SetCuts(const PlaneState& plane, std::span<const std::uint8_t> region_of_block)
{
  CheckCuts(plane.contacts.broad, region_of_block, team_.RegionCount());
  if (std::ranges::equal(region_of_block, region_of_block_)) return;
  region_of_block_.assign(region_of_block.begin(), region_of_block.end());
  region_of_cell_.assign(plane.contacts.broad.Cells().Count(), 0);
  for (std::uint32_t block = 0; block < region_of_block.size(); ++block)
    plane.contacts.broad.FillBlock(block, region_of_block[block], region_of_cell_);
  knows_cuts_ = false;
}

bool RegionTasks::Advance(PlaneState& plane, double seconds, int steps)
{
  if (!team_.IsReady())
  {
    knows_all_ = false;
    return false;
  }
  ByteWriter plan;
  bool tells_all = !knows_all_;
  bool is_done = false;
  for (std::uint32_t piece = 0; !is_done; ++piece)
    team_.Work(
        tells_all && piece == 0,
        [&](bool all_data, std::span<ByteWriter> tasks)
        {
          if (all_data)
          {
            tells_all = true;
            piece = 0;
            plan = PlanOf(plane);
          }
          const std::span<const char> bytes(plan.Bytes());
          const std::span<const char> rest = bytes.subspan(std::min(piece * kPieceOfPlan, bytes.size()));
          is_done = rest.size() <= kPieceOfPlan;
          tasks[0].Put(TaskStart{piece, !is_done, tells_all, !changed_.empty(), {}});
          if (tells_all) tasks[0].PutArray(rest.first(std::min(rest.size(), kPieceOfPlan)));
          if (is_done) WriteForAll(plane, tells_all, seconds, steps, tasks[0]);
          for (std::size_t region = 1; region < tasks.size(); ++region) tasks[region] = tasks[0];
          if (!is_done) return;
          if (tells_all)
            WriteBodies(plane.bodies, plane.contacts.broad, tasks);
          else
            WriteChanges(plane.bodies, tasks);
        },
        results_);
  knows_all_ = knows_cuts_ = true;
  changed_.clear();
  changed_models_.clear();

  plane.statistics = {};
  std::ranges::fill(region_of_body_, kNoRegion);
  std::size_t told = 0;
  for (unsigned region = 0; region < results_.size(); ++region)
  {
    ReadResult(plane, region);
    told += bodies_[region].size();
  }
  Bodies& bodies = plane.bodies;
  for (const Follower& follower : bodies.followers) bodies.now.Set(follower.body, follower.goal);
  if (told + bodies.followers.size() != bodies.count) RefuseRegion("the results lack bodies");
  return true;
}

void RegionTasks::WriteForAll(const PlaneState& plane, bool all_data, double seconds, int steps, ByteWriter& task) const
{
  const Bodies& bodies = plane.bodies;
  task.Put(seconds);
  task.Put(steps);
  task.PutArray(knows_cuts_ && !all_data ? std::vector<std::uint8_t>() : region_of_block_);
  task.Put(static_cast<std::uint64_t>(changed_models_.size()));
  for (const std::uint32_t model : changed_models_)
  {
    task.Put(model);
    PutModel(bodies.models[model], task);
  }
  task.PutEach(bodies.followers.size(),
               [&](std::size_t k)
               {
                 const Follower& follower = bodies.followers[k];
                 return FollowerTask{bodies.now.Get(follower.body), follower.from, follower.goal,
                                     bodies.is_present[follower.body]};
               });
  task.PutArray(plane.groups.grips);
}

// Each body is sent to the region that it is in.
void RegionTasks::WriteBodies(const Bodies& bodies, const BroadPhase& broad, std::span<ByteWriter> tasks)
{
  cells_.resize(bodies.count);
  broad.Cells().FindCells({bodies.now.x.data(), bodies.count}, {bodies.now.y.data(), bodies.count}, cells_.data());
  for (std::uint32_t body = 0; body < bodies.count; ++body)
    if (!bodies.IsFollower(body)) PutBody(bodies, body, body, tasks[region_of_cell_[cells_[body]]]);
}

void RegionTasks::WriteChanges(const Bodies& bodies, std::span<ByteWriter> tasks) const
{
  std::vector<std::vector<ChangedBody>> changed(tasks.size());
  for (const std::uint32_t body : changed_)
    if (!bodies.IsFollower(body))
      changed[region_of_body_[body]].push_back({body, bodies.is_present[body], bodies.now.Get(body)});
  std::vector<std::vector<TurretRate>> rates(tasks.size());
  for (const Turret& turret : bodies.turrets)
    rates[region_of_body_[turret.body]].push_back({turret.body, 0, turret.rate});
  for (std::size_t region = 0; region < tasks.size(); ++region)
  {
    const std::vector<std::uint32_t>& of_region = bodies_[region];
    tasks[region].PutArray(changed[region]);
    tasks[region].PutEach(of_region.size(), [&](std::size_t k) { return bodies.twists.Get(of_region[k]); });
    tasks[region].PutArray(rates[region]);
  }
}

void RegionTasks::ReadResult(PlaneState& plane, unsigned region)
{
  Bodies& bodies = plane.bodies;
  ByteReader result(results_[region]);
  const auto statistics = result.Get<WorldStatistics>();
  plane.statistics.substeps = statistics.substeps;
  plane.statistics.pairs += statistics.pairs;
  plane.statistics.contacts += statistics.contacts;
  plane.statistics.held_back += statistics.held_back;
  std::vector<std::uint32_t>& of_region = bodies_[region];
  result.GetArray(of_region);
  for (const std::uint32_t body : of_region)
  {
    if (body >= bodies.count || bodies.IsFollower(body) || region_of_body_[body] != kNoRegion)
      RefuseRegion("a result has a body that does not exist, or that another result has");
    region_of_body_[body] = static_cast<std::uint8_t>(region);
  }
  const auto take = [&](auto& values)
  {
    const std::span<const char> image = result.GetImage<double>();
    if (image.size() != of_region.size() * sizeof(double)) RefuseRegion("a result has values of other bodies");
    const char* value = image.data();
    for (const std::uint32_t body : of_region)
    {
      std::memcpy(&values[body], value, sizeof(double));
      value += sizeof(double);
    }
  };
  for (std::vector<double>* values : {&bodies.now.x, &bodies.now.y, &bodies.now.z, &bodies.now.w}) take(*values);
  for (const TurretAngle& turret : result.GetArray<TurretAngle>())
  {
    if (turret.number >= bodies.count) RefuseRegion("a result has the turret of a body that does not exist");
    bodies.SetTurretAngle(turret.number, turret.angle);
  }
  if (!bodies.keeps_travel) return;
  take(bodies.travel_forward);
  take(bodies.travel_turn);
}

}  // namespace swarmanoid::kinematics2d

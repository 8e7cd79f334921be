// Problem: solve each contact group by itself, so that its motion depends on no other group, thread or process.
//
// Method: when a tick begins, each assembly gets the box that it can reach in the tick: its outline, grown by its own
// way and by how far the solver may push it. Assemblies with overlapping boxes, or joined by grips, form groups; static
// solids join nothing. A group has a world of its own, and so has a fast assembly. The others share worlds, since ODE
// solves each by itself there. If a body is about to leave its box in the tick, all groups are found again.
//
// Invariants: groups follow from the bodies at the start of the tick. A group's world has its members in the order of
// assemblies, whatever happened before: if they change, all are moved again. All bodies that can touch are in one
// world, so that no bit of their motion depends on how large the group is.
#include "engine_worker/engines/dynamics3d/solver_groups.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <numeric>

namespace swarmanoid::dynamics3d
{
namespace
{

// Bodies may be pushed, or speed up, by so much more (m) than they move by themselves.
constexpr double kPushed = 0.02;
// With fewer assemblies in a step, or in the end of a tick, waking threads takes longer.
constexpr std::size_t kLeastShared = 12;
constexpr std::size_t kLeastEnded = 256;
// No body that is alone speeds up by more than this multiple of gravity.
constexpr double kLargestAcceleration = 3;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

bool Contains(const Box& outer, const Box& inner)
{
  // The condition is false for NaN.
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (!(inner[2 * axis] >= outer[2 * axis] && inner[2 * axis + 1] <= outer[2 * axis + 1])) return false;
  return true;
}

}  // namespace

SolverGroups::SolverGroups(Scene& scene, int steps, double step_seconds, bool solve_all)
    : scene_(scene), steps_(steps), step_seconds_(step_seconds), free_robots_(scene, steps, step_seconds, solve_all)
{
}

void SolverGroups::UseThreads(unsigned threads, WorkerPool* pool)
{
  if (pool == nullptr && threads > 1) own_pool_ = std::make_unique<WorkerPool>(threads);
  pool_ = pool != nullptr ? pool : own_pool_.get();
}

void SolverGroups::Add(Model& model, bool owned)
{
  models_.push_back(&model);
  is_owned_.push_back(owned ? 1 : 0);
  free_robots_.Add(model, owned);
}

void SolverGroups::Advance(std::uint64_t first_step)
{
  contacts_ = 0;
  most_parts_ = 1;
  free_robots_.BeginTick();
  Find(0);
  if (regions_ != nullptr && regions_->AreReady())
    AdvanceWithRegions(first_step);
  else
    AdvanceHere(first_step);
  EndTick();
}

void SolverGroups::AdvanceHere(std::uint64_t first_step)
{
  for (Task& task : tasks_) task.most_parts = 1;
  Place();
  for (int step = 0; step < steps_; ++step)
  {
    RunStep(step, first_step + static_cast<std::uint64_t>(step));
    if (step + 1 == steps_ || !IsAnyTooFar()) continue;
    free_robots_.SearchAgain(step + 1);
    Find(step + 1);
    Place();
  }
  for (std::size_t k = 0; k < task_count_; ++k) contacts_ += tasks_[k].contacts;
  for (const Task& task : tasks_) most_parts_ = std::max(most_parts_, task.most_parts);
}

void SolverGroups::EndTick()
{
  InParts(
      IfItShares(pool_), models_.size(), 1,
      [&](unsigned, std::size_t begin, std::size_t end)
      {
        for (std::size_t assembly = begin; assembly < end; ++assembly)
          free_robots_.EndTick(static_cast<std::uint32_t>(assembly));
      },
      kLeastEnded);
}

// Finds the groups for the steps from `step` on.
void SolverGroups::Find(int step)
{
  const double seconds = (steps_ - step) * step_seconds_;
  const auto count = static_cast<std::uint32_t>(models_.size());
  reach_.resize(count);
  is_searched_.assign(count, 0);
  is_fast_.assign(count, 0);
  boxes_.clear();
  for (std::uint32_t assembly = 0; assembly < count; ++assembly)
    if (!models_[assembly]->IsLeftOut() && !free_robots_.IsFar(assembly) && !free_robots_.IsInPlane(assembly))
      SetReach(assembly, seconds);
  FindPairs();
  FindGroups();
}

// Puts the bodies of the groups into worlds.
void SolverGroups::Place()
{
  PlaceGroups();
  MakeTasks(free_robots_.NearPairs());
}

void SolverGroups::SetReach(std::uint32_t assembly, double seconds)
{
  const Model& model = *models_[assembly];
  Box& reach = reach_[assembly];
  reach = Grown(model.CurrentBox(), model.LargestSpeed() * seconds + kPushed);
  const Vector3& gravity = scene_.world.Settings().gravity;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double fall = gravity[static_cast<Eigen::Index>(axis)] * seconds * seconds / 2;
    reach[2 * axis + (fall > 0 ? 1 : 0)] += fall;
  }
  // Motion that has lost all bounds may meet anything.
  if (!std::ranges::all_of(reach, [](double bound) { return std::isfinite(bound); }))
    reach = {-kInfinity, kInfinity, -kInfinity, kInfinity, -kInfinity, kInfinity};
  is_searched_[assembly] = 1;
  is_fast_[assembly] = IsFast(assembly) ? 1 : 0;
  boxes_.push_back({reach, assembly});
}

// Returns whether steps of the assembly may have to be cut in this tick, which no other assembly is to share.
bool SolverGroups::IsFast(std::uint32_t number) const
{
  const OdeWorld& world = scene_.world;
  const Assembly& assembly = world.Assemblies()[number];
  if (world.RestOf(assembly.first_body).asleep) return false;
  const double gravity = std::sqrt(world.Settings().gravity.squaredNorm());
  const double speed = models_[number]->LargestSpeed() + kLargestAcceleration * gravity * scene_.tick_seconds;
  return speed * step_seconds_ > SolverWorld::kPartOfWidth * assembly.least_width;
}

// Finds overlapping boxes by a sweep along x.
void SolverGroups::FindPairs()
{
  pairs_.clear();
  static_pairs_.clear();
  const auto count = static_cast<std::uint32_t>(models_.size());
  const std::span<const Solid* const> statics = scene_.world.Statics();
  if (boxes_.empty()) return;
  for (std::uint32_t k = 0; k < statics.size(); ++k) boxes_.push_back({statics[k]->box, count + k});
  std::ranges::sort(boxes_, [](const SweptBox& a, const SweptBox& b)
                    { return a.box[0] != b.box[0] ? a.box[0] < b.box[0] : a.number < b.number; });
  for (std::size_t i = 0; i < boxes_.size(); ++i)
  {
    const SweptBox& a = boxes_[i];
    const bool is_movable = IsMovable(a.number);
    for (std::size_t j = i + 1; j < boxes_.size() && boxes_[j].box[0] <= a.box[1]; ++j)
    {
      const SweptBox& b = boxes_[j];
      if (!(is_movable || IsMovable(b.number)) || !Overlap(a.box, b.box)) continue;
      const auto [low, high] = std::minmax(a.number, b.number);
      if (high < count)
        pairs_.push_back({low, high});
      else
        static_pairs_.push_back({low, statics[high - count]});
    }
  }
}

void SolverGroups::FindGroups()
{
  const auto count = static_cast<std::uint32_t>(models_.size());
  islands_.Reset(count);
  for (const SolverWorld::NearAssemblies& pair : pairs_) islands_.Join(pair.first, pair.second);
  for (const kinematics2d::Pair& pair : free_robots_.NearPairs())
    if (pair.second < count) islands_.Join(pair.first, pair.second);
  scene_.links.ForEachPair([&](std::uint32_t a, std::uint32_t b) { islands_.Join(a, b); });

  sizes_.assign(count, 0);
  for (std::uint32_t assembly = 0; assembly < count; ++assembly) ++sizes_[islands_.Of(assembly)];
  group_of_.assign(count, kNoGroup);
  group_count_ = lone_count_ = 0;
  is_in_plane_.clear();
  for (std::uint32_t assembly = 0; assembly < count; ++assembly)
  {
    const std::uint32_t first = islands_.Of(assembly);
    const bool is_in_plane = free_robots_.IsInPlane(first);
    if (sizes_[first] < 2 && is_fast_[first] == 0 && !is_in_plane) continue;
    if (first == assembly)
    {
      group_of_[first] = static_cast<std::uint32_t>(group_count_++);
      if (groups_.size() < group_count_) groups_.emplace_back();
      groups_[group_of_[first]].clear();
      is_in_plane_.push_back(is_in_plane ? 1 : 0);
      if (is_in_plane && sizes_[first] < 2) ++lone_count_;
    }
    groups_[group_of_[first]].push_back(assembly);
  }
}

// Gives each group that is not in the plane a world. A world whose members stay is kept.
void SolverGroups::PlaceGroups()
{
  OdeWorld& world = scene_.world;
  world_of_group_.assign(group_count_, kNoGroup);
  is_used_.assign(worlds_.size(), 0);
  for (std::size_t group = 0; group < group_count_; ++group)
  {
    if (is_in_plane_[group] != 0) continue;
    const SolverWorld& before = *world.AssemblyAt(groups_[group].front()).world;
    if (before.Number() == SolverWorld::kHome || !std::ranges::equal(before.Members(), groups_[group])) continue;
    world_of_group_[group] = before.Number();
    is_used_[before.Number()] = 1;
  }

  is_moving_.assign(models_.size(), 0);
  const auto is_moving = [&](std::uint32_t assembly) { return is_moving_[assembly] != 0; };
  for (std::uint32_t assembly = 0; assembly < models_.size(); ++assembly)
  {
    const std::uint32_t group = GroupWithWorld(assembly);
    const bool stays = group == kNoGroup ? world.AssemblyAt(assembly).world == &world.HomeOf(assembly)
                                         : world_of_group_[group] != kNoGroup;
    is_moving_[assembly] = stays ? 0 : 1;
  }
  scene_.links.DestroyJoints(is_moving);
  std::uint32_t next = 0;
  for (std::size_t group = 0; group < group_count_; ++group)
  {
    if (world_of_group_[group] != kNoGroup || is_in_plane_[group] != 0) continue;
    while (next < worlds_.size() && is_used_[next] != 0) ++next;
    if (next == worlds_.size()) worlds_.push_back(std::make_unique<SolverWorld>(world, next));
    world_of_group_[group] = next;
    SolverWorld& to = *worlds_[next++];
    for (const std::uint32_t assembly : groups_[group]) world.Move(assembly, to);
    to.SetMembers(groups_[group]);
  }
  for (std::uint32_t assembly = 0; assembly < models_.size(); ++assembly)
    if (is_moving(assembly) && GroupWithWorld(assembly) == kNoGroup) world.Move(assembly, world.HomeOf(assembly));
  world.SetMembersOfHomes();
  scene_.links.CreateJoints();
}

// Tells the worlds which of their members and static solids can meet.
void SolverGroups::MakeTasks(std::span<const kinematics2d::Pair> near_pairs)
{
  OdeWorld& world = scene_.world;
  const std::size_t homes = world.Homes().size();
  task_count_ = homes + group_count_;
  if (tasks_.size() < task_count_) tasks_.resize(task_count_);
  order_.resize(task_count_);
  std::iota(order_.begin(), order_.end(), 0U);
  for (std::size_t k = 0; k < task_count_; ++k)
  {
    Task& task = tasks_[k];
    const bool is_in_plane = k >= homes && is_in_plane_[k - homes] != 0;
    task.world = is_in_plane ? nullptr : k < homes ? world.Homes()[k].get() : worlds_[world_of_group_[k - homes]].get();
    const std::span<const std::uint32_t> members = k < homes ? task.world->Members() : groups_[k - homes];
    task.members.clear();
    std::ranges::copy_if(members, std::back_inserter(task.members),
                         [&](std::uint32_t member) { return k >= homes || !free_robots_.IsInPlane(member); });
    if (task.world != nullptr) task.world->ForgetNear();
    task.near_pairs.clear();
    task.contacts = 0;
    task.goes_too_far = false;
  }
  const auto world_of = [&](std::uint32_t assembly) -> SolverWorld& { return *world.AssemblyAt(assembly).world; };
  for (const SolverWorld::NearAssemblies& pair : pairs_) world_of(pair.first).Add(pair);
  for (const SolverWorld::NearStatic& pair : static_pairs_) world_of(pair.assembly).Add(pair);
  for (const OdeWorld::IgnoredPair& pair : world.IgnoredPairs())
    if (pair.high != kNoEntity && world.IsMovable(pair.high))
      world_of(world.AssemblyOfEntity(pair.low)).AddHeld(pair.low, pair.high);
  for (const kinematics2d::Pair& pair : near_pairs)
  {
    const std::uint32_t group = GroupOf(pair.first);
    tasks_[group == kNoGroup ? OdeWorld::HomeNumberOf(pair.first) : homes + group].near_pairs.push_back(pair);
  }
  std::ranges::stable_sort(order_, std::ranges::greater(),
                           [&](std::uint32_t task) { return tasks_[task].members.size(); });
}

// Makes one step of all groups. The largest ones come first, so that the threads end at about the same time.
void SolverGroups::RunStep(int step, std::uint64_t number)
{
  std::size_t members = 0;
  for (const std::uint32_t task : order_) members += tasks_[task].members.size();
  WorkerPool* const pool = IfItShares(pool_);
  if (pool == nullptr || order_.size() < 2 || members < kLeastShared)
    for (const std::uint32_t task : order_) RunTask(tasks_[task], step, number);
  else
    OneByOne(*pool, order_.size(), [&](std::size_t k, unsigned) { RunTask(tasks_[order_[k]], step, number); });
  std::erase_if(order_, [&](std::uint32_t task) { return tasks_[task].is_done; });
}

void SolverGroups::RunTask(Task& task, int step, std::uint64_t number)
{
  task.contacts = 0;
  task.is_done = !free_robots_.BeforeStep(task.members, task.near_pairs, step, task.solved);
  if (task.is_done) return;
  task.contacts = free_robots_.PlanarStep(task.members, task.near_pairs, task.in_plane);
  if (!task.solved.empty()) RunSolved(task, number);
  free_robots_.AfterStep(task.members, step);
  task.goes_too_far = IsAnyTooFar(task);
}

void SolverGroups::RunSolved(Task& task, std::uint64_t number)
{
  SolverWorld& world = *task.world;
  const int parts = world.PartsOfStep(step_seconds_);
  task.most_parts = std::max(task.most_parts, parts);
  for (int part = 0; part < parts; ++part)
  {
    const double seconds = step_seconds_ / parts;
    for (Model* model : task.solved) model->BeforeStep(seconds);
    world.Step(seconds, number);
    for (Model* model : task.solved) model->AfterStep(seconds);
  }
  task.contacts += world.ContactCount();
}

bool SolverGroups::IsAnyTooFar() const
{
  return std::ranges::any_of(order_, [&](std::uint32_t task) { return tasks_[task].goes_too_far; });
}

// Returns whether a body has left, or leaves in the next step, the box that the search assumed for it.
bool SolverGroups::IsAnyTooFar(const Task& task) const
{
  const auto is_too_far = [&](const Model* model)
  {
    const std::uint32_t assembly = model->AssemblyNumber();
    return is_searched_[assembly] != 0 &&
           !Contains(reach_[assembly], Grown(model->CurrentBox(), model->LargestSpeed() * step_seconds_));
  };
  return free_robots_.IsAnyTooFar(task.members) || std::ranges::any_of(task.solved, is_too_far);
}

}  // namespace swarmanoid::dynamics3d

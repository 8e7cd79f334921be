// SolverGroups: finds the groups of assemblies (ode_world.h) that can meet before a tick ends, gives each group a
// SolverWorld of its own unless all its steps are in the plane (contact_free_set.h), and makes the steps of the tick in
// all of them. Groups do not depend on each other, so threads and the regions of a split engine share them, and no bit
// depends on how. Owned by the engine.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "common/threads/worker_pool.h"
#include "engine_worker/engines/dynamics3d/contact_free_set.h"
#include "engine_worker/engines/dynamics3d/model.h"
#include "engine_worker/engines/dynamics3d/solver_world.h"
#include "engine_worker/engines/rigid_bodies/region_streams.h"

namespace swarmanoid::dynamics3d
{

inline constexpr std::uint32_t kNoGroup = std::numeric_limits<std::uint32_t>::max();

class SolverGroups
{
public:
  // `solve_all`: the solver moves all robots.
  SolverGroups(Scene& scene, int steps, double step_seconds, bool solve_all);

  // The threads of a pool solve the groups, or `threads` of a pool of their own if `pool` is nullptr.
  void UseThreads(unsigned threads, WorkerPool* pool);

  // The regions of `team`, which outlives this, make the steps while they are ready.
  void UseRegions(RegionTeam& team);
  // Makes the steps that an engine sends to a region (solver_regions.cpp). Throws std::runtime_error if the stream does
  // not fit this engine.
  void Execute(std::span<const char> stream, ByteWriter& result);

  // Adds the next model before it is placed.
  void Add(Model& model, bool owned);
  ContactFreeSet& FreeRobots() { return free_robots_; }
  const ContactFreeSet& FreeRobots() const { return free_robots_; }

  // Makes all steps of a tick. `first_step` counts from the start of the experiment.
  void Advance(std::uint64_t first_step);

  // The number of groups of several assemblies that can meet, or with a fast one.
  std::size_t GroupCount() const { return group_count_ - lone_count_; }
  // The number of contacts in the last step.
  int ContactCount() const { return contacts_; }
  // Returns into how many parts a step of the last tick was cut at most.
  int MostParts() const { return most_parts_; }

private:
  // A world and what is known of its members in this tick.
  struct Task
  {
    SolverWorld* world = nullptr;  // nullptr: of a group in the plane
    std::vector<std::uint32_t> members;
    PlanarSolver in_plane;
    std::vector<kinematics2d::Pair> near_pairs;  // of free_robots_
    std::vector<Model*> solved;
    int most_parts = 1;
    int contacts = 0;      // in the last step
    bool is_done = false;  // nothing is left to do until the tick ends
    bool goes_too_far = false;
  };
  struct SweptBox
  {
    Box box;
    std::uint32_t number;  // of an assembly, or counted on from them of a static solid
  };

  // An assembly, and a static solid that it can meet.
  struct NearSolid
  {
    std::uint32_t assembly, solid;
  };
  // The work of one region for the steps that are left: a group, or assemblies that are alone.
  struct Unit
  {
    std::vector<std::uint32_t> members;  // ascending
    std::vector<SolverWorld::NearAssemblies> pairs;
    std::vector<NearSolid> statics;
    std::vector<kinematics2d::Pair> near_pairs;  // of free_robots_
    bool is_in_plane = false;
    ByteWriter state;  // of the members, before the steps
    std::size_t load = 0;
    std::uint32_t region = 0;
    std::span<const char> result;
  };
  // A region sends this about a unit, before the states of its members.
  struct UnitEnd
  {
    std::int32_t step;  // after the last one
    std::int32_t contacts, most_parts;
    std::uint32_t goes_too_far;
  };

  void AdvanceHere(std::uint64_t first_step);
  void Find(int step);
  void Place();
  bool IsFast(std::uint32_t number) const;
  void SetReach(std::uint32_t assembly, double seconds);
  void FindPairs();
  void FindGroups();
  void PlaceGroups();
  void MakeTasks(std::span<const kinematics2d::Pair> near_pairs);
  void RunStep(int step, std::uint64_t number);
  void RunTask(Task& task, int step, std::uint64_t number);
  void RunSolved(Task& task, std::uint64_t number);
  void EndTick();
  bool IsAnyTooFar() const;
  bool IsAnyTooFar(const Task& task) const;

  // The work of regions, at the engine and at a region (solver_regions.cpp).
  void AdvanceWithRegions(std::uint64_t first_step);
  void MakeUnits(int step);
  Unit& AddUnit();
  void AddMember(Unit& unit, std::uint32_t assembly);
  void DealUnits();
  int RunUnits(int step, std::uint64_t first_step);
  void SendUnits(int from, int to, std::uint64_t first_step);
  void TakeUnit(const Unit& unit);
  void Count(const Unit& unit);
  void SaveStates(std::span<const std::uint32_t> members, ByteWriter& state) const;
  void LoadStates(std::span<const std::uint32_t> members, ByteReader& state);
  void ReadUnit(ByteReader& stream);
  void CheckLinks();
  void ExecuteUnit(std::size_t unit, int from, int to, std::uint64_t first_step);

  // Returns the group of an assembly, or kNoGroup.
  std::uint32_t GroupOf(std::uint32_t assembly) { return group_of_[islands_.Of(assembly)]; }
  // Returns the group that has a world, or kNoGroup.
  std::uint32_t GroupWithWorld(std::uint32_t assembly)
  {
    const std::uint32_t group = GroupOf(assembly);
    return group == kNoGroup || is_in_plane_[group] != 0 ? kNoGroup : group;
  }
  bool IsMovable(std::uint32_t number) const { return number < models_.size() && is_owned_[number] != 0; }

  Scene& scene_;
  int steps_;
  double step_seconds_;
  ContactFreeSet free_robots_;
  std::unique_ptr<WorkerPool> own_pool_;
  WorkerPool* pool_ = nullptr;
  std::vector<Model*> models_;  // by assembly
  std::vector<std::uint8_t> is_owned_;

  // The rest describes the last search.
  std::vector<Box> reach_;  // by assembly: the box that it will not leave, if it is in boxes_
  std::vector<std::uint8_t> is_searched_, is_fast_;
  std::vector<SweptBox> boxes_;
  std::vector<SolverWorld::NearAssemblies> pairs_;
  std::vector<SolverWorld::NearStatic> static_pairs_;
  Islands islands_;
  std::vector<std::uint32_t> sizes_;                // by first assembly of an island
  std::vector<std::uint32_t> group_of_;             // by first assembly of an island that is a group
  std::vector<std::vector<std::uint32_t>> groups_;  // their assemblies, ascending
  std::vector<std::uint8_t> is_in_plane_;           // by group
  std::size_t group_count_ = 0, lone_count_ = 0;    // of them, robots alone in the plane
  std::vector<std::uint32_t> world_of_group_;
  std::vector<std::unique_ptr<SolverWorld>> worlds_;  // of groups
  std::vector<std::uint8_t> is_used_;                 // by world of a group
  std::vector<std::uint8_t> is_moving_;               // by assembly
  std::vector<Task> tasks_;                           // of the homes, then of the groups
  std::size_t task_count_ = 0;
  std::vector<std::uint32_t> order_;  // of tasks: the largest first
  int contacts_ = 0, most_parts_ = 1;

  std::unique_ptr<RegionStreams> regions_;  // nullptr if the engine is not split
  // The units of the last search, at the engine.
  std::vector<std::unique_ptr<Unit>> units_;
  std::size_t unit_count_ = 0;
  std::vector<std::uint32_t> unit_of_;              // by assembly, or kNoGroup
  std::vector<std::uint32_t> unit_order_;           // the largest first
  std::vector<std::uint32_t> region_of_;            // by first assembly of a unit: its region in the last tick
  std::vector<std::uint32_t> sent_;                 // units
  std::vector<std::vector<const Link*>> links_of_;  // by region
  // The units of a task, at a region. They are the groups.
  std::vector<kinematics2d::Pair> near_pairs_;
  std::vector<std::span<const char>> unit_states_;
  std::vector<std::vector<const Link*>> ropes_of_;
  std::vector<ByteWriter> unit_results_;
};

}  // namespace swarmanoid::dynamics3d

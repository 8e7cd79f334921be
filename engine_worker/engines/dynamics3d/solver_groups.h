// SolverGroups: finds the groups of assemblies (ode_world.h) that can meet before a tick ends, gives each group a
// SolverWorld of its own, and makes the steps of the tick in all of them. Groups do not depend on each other, so
// threads share them, and no bit depends on the number of threads. Owned by the engine.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "common/threads/worker_pool.h"
#include "engine_worker/engines/dynamics3d/contact_free_set.h"
#include "engine_worker/engines/dynamics3d/model.h"
#include "engine_worker/engines/dynamics3d/solver_world.h"

namespace swarmanoid::dynamics3d
{

class SolverGroups
{
public:
  // `solve_all`: the solver moves all robots.
  SolverGroups(Scene& scene, int steps, double step_seconds, bool solve_all);

  // The threads of a pool solve the groups, or `threads` of a pool of their own if `pool` is nullptr.
  void UseThreads(unsigned threads, WorkerPool* pool);

  // Adds the next model before it is placed.
  void Add(Model& model, bool owned);
  ContactFreeSet& FreeRobots() { return free_robots_; }
  const ContactFreeSet& FreeRobots() const { return free_robots_; }

  // Makes all steps of a tick. `first_step` counts from the start of the experiment.
  void Advance(std::uint64_t first_step);

  // The number of worlds with several assemblies that can meet, or with a fast one.
  std::size_t GroupCount() const { return group_count_; }
  int ContactCount() const;
  // Returns into how many parts a step of the last tick was cut at most.
  int MostParts() const;

private:
  // A world and what is known of its members in this tick.
  struct Task
  {
    SolverWorld* world = nullptr;
    std::vector<kinematics2d::Pair> near_pairs;  // of free_robots_
    std::vector<Model*> solved;
    int most_parts = 1;
    bool is_done = false;  // nothing is left to do until the tick ends
    bool goes_too_far = false;
  };
  struct SweptBox
  {
    Box box;
    std::uint32_t number;  // of an assembly, or counted on from them of a static solid
  };

  void Search(int step);
  bool IsFast(std::uint32_t number) const;
  void SetReach(std::uint32_t assembly, double seconds);
  void FindPairs();
  void FindGroups();
  void PlaceGroups();
  void MakeTasks();
  void RunStep(int step, std::uint64_t number);
  void RunTask(Task& task, int step, std::uint64_t number);
  void EndTick();
  bool IsAnyTooFar() const;
  bool IsAnyTooFar(const Task& task) const;
  // Returns the group of an assembly, or kNoGroup.
  std::uint32_t GroupOf(std::uint32_t assembly) { return group_of_[islands_.Of(assembly)]; }
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
  std::size_t group_count_ = 0;
  std::vector<std::uint32_t> world_of_group_;
  std::vector<std::unique_ptr<SolverWorld>> worlds_;  // of groups
  std::vector<std::uint8_t> is_used_;                 // by world of a group
  std::vector<std::uint8_t> is_moving_;               // by assembly
  std::vector<Task> tasks_;                           // of the homes, then of the groups
  std::size_t task_count_ = 0;
  std::vector<std::uint32_t> order_;  // of tasks: the largest first
};

}  // namespace swarmanoid::dynamics3d

// A region of a split dynamics2d, in a process of its own: it solves the groups that its engine gives it. It needs no
// other region. remote_groups.h has the tasks and results.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "common/threads/worker_pool.h"
#include "engine_worker/engines/dynamics2d/group_solver.h"
#include "engine_worker/engines/rigid_bodies/region_streams.h"

namespace swarmanoid::dynamics2d
{

class GroupRegion final : public StreamedRegion
{
private:
  void Execute(std::span<const char> stream, ByteWriter& result) override;
  void ReadModels(ByteReader& task);

  SolverSettings settings_;
  std::unique_ptr<WorkerPool> pool_;  // nullptr for one thread
  std::vector<Body> bodies_;          // all of the engine, with its numbers
  std::vector<GroupRun> runs_;        // of the task
};

}  // namespace swarmanoid::dynamics2d

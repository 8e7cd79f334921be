// Solves the groups of a task by the same function as an engine that is not split.
#include "engine_worker/engines/dynamics2d/group_region.h"

#include <utility>

#include "engine_worker/engines/dynamics2d/remote_groups.h"

namespace swarmanoid::dynamics2d
{
namespace
{

constexpr std::uint32_t kMostThreads = 64;
constexpr std::int32_t kMostPasses = 1000000;

}  // namespace

void GroupRegion::ReadModels(ByteReader& task)
{
  settings_ = task.Get<SolverSettings>();
  const auto threads = task.Get<std::uint32_t>();
  const auto is_sound = [](std::int32_t passes) { return passes >= 1 && passes <= kMostPasses; };
  if (!is_sound(settings_.velocity_iterations) || !is_sound(settings_.position_iterations) || threads < 1 ||
      threads > kMostThreads)
    RefuseGroup("the settings are not sound");
  if (threads == 1)
    pool_.reset();
  else if (pool_ == nullptr || pool_->Threads() != threads)
    pool_ = std::make_unique<WorkerPool>(threads);
  bodies_.clear();
  const auto count = task.Get<std::uint32_t>();
  for (std::uint32_t i = 0; i < count; ++i) GetModel(bodies_.emplace_back(), task);
}

void GroupRegion::Execute(std::span<const char> stream, ByteWriter& result)
{
  ByteReader task(stream);
  if (task.Get<std::uint8_t>() != 0) ReadModels(task);
  const auto seconds = task.Get<double>();
  const auto steps = task.Get<std::int32_t>();
  const auto groups = task.Get<std::uint32_t>();
  if (!(seconds > 0) || steps < 1) RefuseGroup("a tick has no steps");
  std::vector<std::uint8_t> is_taken(bodies_.size());
  for (std::uint32_t i = 0; i < groups; ++i)
  {
    if (i == runs_.size()) runs_.emplace_back();
    GetGroup(bodies_, runs_[i], task);
    for (const std::uint32_t number : runs_[i].bodies)
      if (std::exchange(is_taken[number], 1) != 0) RefuseGroup("a body is in two groups");
  }
  if (!task.AtEnd()) RefuseGroup("a task does not end");
  // The engine sends the largest groups first, so that threads end at about the same time.
  ShareWork(pool_.get(), groups, [&](std::size_t k) { SolveGroup(bodies_, runs_[k], settings_, seconds, steps); });
  for (std::uint32_t i = 0; i < groups; ++i) PutResult(bodies_, runs_[i], settings_, result);
}

}  // namespace swarmanoid::dynamics2d

// One step of an engine: it collects the commands of its robots, calls the engine, and checks what the engine returns
// before any other role sees it. Each engine call runs within an activity (common/activity), so that an error names the
// engine and the tick.
#include "engine_worker/engine_worker.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "common/experiment/actors.h"
#include "common/space/space.h"
#include "common/space/state_checks.h"
#include "common/threads/worker_pool.h"

namespace swarmanoid
{

const PluginRegistry<CPhysicsEngine>::Entry& RegisteredEngine(const EngineConfiguration& configuration)
{
  const auto* entry = PluginRegistry<CPhysicsEngine>::Instance().Find(configuration.tag);
  if (entry == nullptr)
    throw ConfigurationError(configuration.location, "no engine is registered as '" + configuration.tag + "'");
  return *entry;
}

EngineWorker::EngineWorker(const CSwarmanoidSpace& space, const Assignment& assignment, std::size_t engine,
                           RegionTeam* team, WorkerPool* pool)
    : space_(space),
      assignment_(assignment),
      layout_(assignment.engines[engine]),
      pool_(pool),
      actor_(EngineActor(space.GetExperiment(), engine)),
      members_(space, assignment, static_cast<std::uint32_t>(engine))
{
  const EngineConfiguration& configuration = space.GetExperiment().engines[engine];
  const PluginRegistry<CPhysicsEngine>::Entry& entry = RegisteredEngine(configuration);
  RunCodeOf<ConfigurationError>(
      actor_, ActivityStep::kInit, space.GetTick(),
      [&]
      {
        engine_ = entry.create();
        engine_->Init({configuration, Parameters(configuration.tree, entry.description.parameters), space, layout_,
                       team, pool == nullptr ? 1 : pool->Threads(), pool});
        for (const std::uint32_t index : configuration.entities)
        {
          const CSwarmanoidSpaceEntity& entity = space.GetEntity(index);
          const bool fixed = !entity.IsMovable() || IsBodiless(entity.GetKind());
          // An entity that changes its engine is both a mirror and owned.
          if (fixed)
            engine_->AddEntity(entity, EBinding::kFixed);
          else if (std::ranges::binary_search(layout_.mirrored, index))
            engine_->AddEntity(entity, EBinding::kMirror);
          if (std::ranges::binary_search(layout_.owned, index)) engine_->AddEntity(entity, EBinding::kOwned);
        }
        engine_->Start();
        members_.Begin(*engine_);
      });

  command_values_.resize(layout_.command_size);
  index_ = static_cast<std::uint32_t>(engine);
  update_.engine = index_;
  update_.poses.resize(7 * layout_.owned.size());
  frame_.engine = static_cast<std::uint32_t>(engine);
  frame_.values.resize(layout_.sensor_size);
}

EngineWorker::~EngineWorker() = default;

void EngineWorker::Tick(std::span<const std::uint32_t> moved, std::span<const ControlCommands* const> commands)
{
  const std::uint64_t tick = space_.GetTick();
  update_.tick = tick + 1;
  frame_.tick = update_.tick;
  update_.attributes.Clear();
  Checked([&] { ReadCommands(commands); });
  RunCodeOf(actor_, ActivityStep::kUpdate, tick,
            [&]
            {
              members_.Follow(*engine_);
              for (const std::uint32_t entity : moved)
              {
                const bool may_move_it = std::ranges::binary_search(layout_.owned, entity);
                if (may_move_it && !members_.IsElsewhere(entity))
                  engine_->EntityMoved(entity);
                else if (may_move_it || std::ranges::binary_search(layout_.mirrored, entity))
                  engine_->MirrorMoved(entity);
              }
              if (std::exchange(first_tick_, space_.FirstTick()) != space_.FirstTick()) engine_->BeginAgain();
              members_.StopElsewhere(command_values_);
              engine_->Update({layout_.commands, command_values_}, update_, frame_.values);
              members_.TellVelocities(*engine_, update_);
            });
  // The engine was lent these.
  update_.tick = frame_.tick;
  update_.engine = index_;
  Checked(
      [&]
      {
        members_.LeaveOutElsewhere(update_);
        KeepInactive();
        CheckResults();
        order_.Apply(update_.attributes);
      });
  if ((frame_.tick - first_tick_) % space_.GetExperiment().canonical_period == 0) Canonicalise();
}

void EngineWorker::Canonicalise()
{
  RunCodeOf(actor_, ActivityStep::kUpdate, space_.GetTick(), [&] { engine_->Canonicalise(); });
}

template <class Check>
void EngineWorker::Checked(const Check& check) const
{
  try
  {
    check();
  }
  catch (const std::exception& error)
  {
    throw EngineError(ActivityText(actor_, ActivityStep::kUpdate, space_.GetTick()) + " failed: " + error.what());
  }
}

void EngineWorker::ReadCommands(std::span<const ControlCommands* const> commands)
{
  for (const ValueCopy& copy : layout_.command_copies)
  {
    const auto source = std::find(layout_.commands_from.begin(), layout_.commands_from.end(), copy.source);
    const ControlCommands& message = *commands[static_cast<std::size_t>(source - layout_.commands_from.begin())];
    if (message.values.size() != assignment_.hosts[copy.source].command_size)
      throw std::runtime_error(fmt::format("{} sent {} values of commands; there must be {}", HostName(copy.source),
                                           message.values.size(), assignment_.hosts[copy.source].command_size));
    std::copy_n(message.values.begin() + static_cast<std::ptrdiff_t>(copy.from), copy.count,
                command_values_.begin() + static_cast<std::ptrdiff_t>(copy.to));
  }
  CheckChannels(space_, layout_.commands, command_values_, "commands");
  StopInactive();
}

// Robots outside the arena ignore their commands and do nothing.
void EngineWorker::StopInactive()
{
  if (space_.Absent().empty()) return;
  for (const ChannelBlock& block : layout_.commands)
    for (std::size_t k = 0; k < block.entities.size(); ++k)
      if (!space_.IsPresent(block.entities[k]))
        std::fill_n(command_values_.begin() + static_cast<std::ptrdiff_t>(block.offset + k * block.width), block.width,
                    0.0);
}

// Entities that are not in the arena stay where they wait, whatever the engine makes of them.
void EngineWorker::KeepInactive()
{
  if (space_.Absent().empty() || update_.poses.size() != 7 * layout_.owned.size()) return;
  const PoseArrays& poses = space_.Poses();
  const std::array components{&poses.x, &poses.y, &poses.z, &poses.qx, &poses.qy, &poses.qz, &poses.qw};
  const std::size_t count = layout_.owned.size();
  std::size_t k = 0;  // both ascend
  for (const std::uint32_t entity : space_.Absent())
  {
    while (k < count && layout_.owned[k] < entity) ++k;
    if (k == count) return;
    if (layout_.owned[k] != entity) continue;
    for (std::size_t c = 0; c < components.size(); ++c) update_.poses[c * count + k] = (*components[c])[entity];
  }
}

// The server checks all results again. This check names the mistake to the engine's author earlier.
void EngineWorker::CheckResults() const
{
  WorkerPool* const pool = IfItShares(pool_);
  CheckPoses(space_, layout_.owned, update_.poses, pool);
  CheckAttributes(space_, update_.attributes);
  CheckHolds(space_, layout_.owned, update_.attributes);
  if (space_.GetExperiment().beyond_limit == BeyondLimit::kStop)
    CheckWithinLimit(space_, layout_.owned, update_.poses, pool);
  if (space_.GetExperiment().outside_volumes == OutsideVolumes::kStop)
    CheckInVolumes(space_, index_, layout_, update_.poses);
  CheckChannels(space_, layout_.sensors, frame_.values, "readings");
}

void EngineWorker::SaveState(ByteWriter& state) const
{
  state.PutArray(frame_.values);
  members_.SaveState(state);
  RunCodeOf(actor_, ActivityStep::kSaveState, space_.GetTick(), [&] { engine_->SaveState(state); });
}

void EngineWorker::LoadState(ByteReader& state)
{
  frame_.values = state.GetArray<double>();
  if (frame_.values.size() != layout_.sensor_size) throw std::runtime_error("saved state: it is of another experiment");
  RunCodeOf(actor_, ActivityStep::kLoadState, space_.GetTick(),
            [&]
            {
              members_.LoadState(state, *engine_);
              engine_->LoadState(state);
            });
}

}  // namespace swarmanoid

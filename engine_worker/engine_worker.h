// The role that runs one physics engine. A step function over messages; knows nothing of DDS, threads or files.
#pragma once

#include <memory>
#include <span>
#include <stdexcept>

#include "common/activity/failure_report.h"
#include "common/messages/attribute_changes.h"
#include "engine_worker/physics_engine.h"
#include "engine_worker/volume_members.h"

namespace swarmanoid
{

// Adds dummy_engine (kinematics2d), dynamics2d and dynamics3d to the registry. Idempotent.
void RegisterBuiltinEngines();
// Loads the library of such an engine now, if it is in one that is otherwise loaded with the first engine. Does nothing
// for other labels, and if the library cannot be loaded: each run that makes the engine reports it.
void LoadBuiltinEngine(const std::string& label);

// Returns the engine that the configuration asks for. Throws ConfigurationError if it is not registered.
const PluginRegistry<CPhysicsEngine>::Entry& RegisteredEngine(const EngineConfiguration& configuration);

// An engine failed, or its result cannot be part of the state. what() names the engine, the tick and the mistake.
class EngineError : public ActivityError
{
public:
  using ActivityError::ActivityError;
};

class EngineWorker
{
public:
  // `space` is the replica of this process; it, `assignment` and `team` outlive the worker. `team` is nullptr unless
  // the engine is split. `pool` has threads that the engine may use, beside others. Throws ConfigurationError, or
  // ActivityError naming the engine that failed; so does Tick.
  EngineWorker(const CSwarmanoidSpace& space, const Assignment& assignment, std::size_t engine,
               RegionTeam* team = nullptr, WorkerPool* pool = nullptr);
  ~EngineWorker();

  // Computes the update of the next tick from the state in the space and the commands of its tick. `commands` has one
  // entry for each of layout.commands_from, in that order. `moved` is SpaceState::moved. The results are valid until
  // the next call. Throws EngineError.
  void Tick(std::span<const std::uint32_t> moved, std::span<const ControlCommands* const> commands);
  const EngineUpdate& Update() const { return update_; }
  const SensorFrame& Sensors() const { return frame_; }

  // Makes the engine canonical between two ticks, to save the state at a tick at which that does not happen anyway.
  void Canonicalise();

  // The engine's state with its last sensor values, as of a tick at which engines are canonicalised.
  void SaveState(ByteWriter& state) const;
  void LoadState(ByteReader& state);

  CPhysicsEngine& Engine() { return *engine_; }
  const EngineLayout& Layout() const { return layout_; }
  // Returns the owned entities that other engines moved in the last tick, ascending.
  std::span<const std::uint32_t> Elsewhere() const { return members_.Elsewhere(); }

private:
  // Runs a check of inputs or results. A failure throws EngineError with the engine and the tick.
  template <class Check>
  void Checked(const Check& check) const;
  void ReadCommands(std::span<const ControlCommands* const> commands);
  void StopInactive();
  void KeepInactive();
  void CheckResults() const;

  const CSwarmanoidSpace& space_;
  const Assignment& assignment_;
  const EngineLayout& layout_;
  WorkerPool* const pool_;
  const Actor actor_;
  VolumeMembers members_;
  std::uint32_t index_ = 0;
  std::unique_ptr<CPhysicsEngine> engine_;
  std::vector<double> command_values_;
  std::uint64_t first_tick_ = 0;  // of the space, as far as the engine knows
  EngineUpdate update_;
  SensorFrame frame_;
  AttributeOrder order_;
};

}  // namespace swarmanoid

// The role that runs one physics engine. A step function over messages; knows nothing of DDS, threads or files.
#pragma once

#include <memory>
#include <span>

#include "common/space/attribute_changes.h"
#include "engine_worker/physics_engine.h"

namespace swarmanoid
{

// Adds dummy_engine (kinematics2d), dynamics2d and dynamics3d to the registry. Idempotent.
void RegisterBuiltinEngines();

class EngineWorker
{
public:
  // `space` is the replica of this process; it and `assignment` outlive the worker.
  EngineWorker(const CSwarmanoidSpace& space, const Assignment& assignment, std::size_t engine);
  ~EngineWorker();

  // From the state in the space and the commands of its tick (one for each of layout.commands_from, in that order) to
  // the update of the next tick. `moved`: SpaceState::moved. The results are valid until the next call.
  void Step(std::span<const std::uint32_t> moved, std::span<const ControlCommands* const> commands);
  const EngineUpdate& Update() const { return update_; }
  const SensorFrame& Sensors() const { return frame_; }

  // The engine's state with its last sensor values, as of a tick at which engines are canonicalised.
  void SaveState(ByteWriter& state) const;
  void LoadState(ByteReader& state);

  CPhysicsEngine& Engine() { return *engine_; }
  const EngineLayout& Layout() const { return layout_; }

private:
  void KeepAbsent();

  const CSwarmanoidSpace& space_;
  const EngineLayout& layout_;
  std::unique_ptr<CPhysicsEngine> engine_;
  std::vector<double> command_values_;
  EngineUpdate update_;
  SensorFrame frame_;
  AttributeOrder order_;
};

}  // namespace swarmanoid

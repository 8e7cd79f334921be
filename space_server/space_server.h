// The role that owns the original space and its clock. A step function: merges what engines and hosts did into the next
// state.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "common/space/assignment.h"
#include "common/space/messages.h"
#include "common/space/space.h"

namespace swarmanoid
{

// What is asked from outside between two ticks, in the order of arrival at the server.
struct MoveRequest
{
  std::uint32_t entity = 0;
  Pose pose;
};

class SpaceServer
{
public:
  // The space at tick 0. Both references outlive the server.
  SpaceServer(const Experiment& experiment, const Assignment& assignment);

  CSwarmanoidSpace& Space() { return space_; }
  // The state at the current tick as what changed; what the cluster publishes.
  const SpaceState& State();
  void WriteSnapshot(SpaceSnapshot& snapshot) const;

  // To the next tick: updates in engine order (all engines), commands in host order (those that report to the server).
  // An attribute set by both an engine and a host has the engine's value.
  void Advance(std::span<const EngineUpdate* const> updates, std::span<const ControlCommands* const> commands);
  // Puts an entity elsewhere at the current tick, before its state goes out.
  void Move(const MoveRequest& request);
  // The current tick is the last one.
  void Finish() { last_ = true; }

  // True where maxclock is reached or Finish was called.
  bool IsLast() const { return last_ || (experiment_.max_clock != 0 && space_.GetTick() >= experiment_.max_clock); }

private:
  void Merge(const AttributeChanges& changes);

  const Experiment& experiment_;
  const Assignment& assignment_;
  CSwarmanoidSpace space_;
  SpaceState state_;
  std::vector<std::uint32_t> changed_slots_;
  std::vector<std::uint32_t> moved_;
  bool last_ = false;
};

}  // namespace swarmanoid

// The role that owns the original space and its clock. A step function: merges what engines and hosts did into the next
// state.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "common/serialisation/bytes.h"
#include "common/space/assignment.h"
#include "common/space/messages.h"
#include "common/space/space.h"
#include "space_server/experiment_functions.h"

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
  // The space at tick 0, its experiment functions initialised. Both references outlive the server. Throws
  // ConfigurationError, or std::runtime_error naming the functions that failed; so does Advance.
  SpaceServer(const Experiment& experiment, const Assignment& assignment, const std::string& output_folder);
  ~SpaceServer();

  CSwarmanoidSpace& Space() { return space_; }
  // For those who change the experiment from outside physics.
  SpaceEditor& Editor() { return editor_; }
  // The state at the current tick as what changed; what the cluster publishes.
  const SpaceState& State();
  // The entities that were put elsewhere at the current tick, ascending.
  std::span<const std::uint32_t> Moved();
  void WriteSnapshot(SpaceSnapshot& snapshot) const;
  // What the server remembers beside the snapshot. Saving throws std::runtime_error where experiment functions cannot
  // be saved (HasState is false).
  void SaveState(ByteWriter& state) const;
  // The space as in the snapshot, which must fit it; what is sent next is complete only for those who have it too.
  void LoadState(const SpaceSnapshot& snapshot, ByteReader& state);

  // To the next tick: updates in engine order (all engines), commands in host order (those that report to the server).
  // An attribute set by both an engine and a host has the engine's value.
  void Advance(std::span<const EngineUpdate* const> updates, std::span<const ControlCommands* const> commands);
  // Puts an entity elsewhere at the current tick, before its state goes out.
  void Move(const MoveRequest& request);
  // Changes one attribute at the current tick, before its state goes out.
  void SetAttribute(std::uint32_t slot, double value);
  // The current tick is the last one.
  void Finish() { last_ = true; }
  // Ends the experiment functions, once; later calls do nothing.
  void Destroy();
  // True where the experiment functions say that the experiment failed: exit code 1.
  bool HasFailed() const { return failed_; }

  // True where maxclock is reached or Finish was called.
  bool IsLast() const { return last_ || (experiment_.max_clock != 0 && space_.GetTick() >= experiment_.max_clock); }

private:
  struct Functions
  {
    const FunctionsConfiguration* configuration;
    std::unique_ptr<CExperimentFunctions> object;
  };

  void Merge(const AttributeChanges& changes);
  // Calls a step of all functions in the order of the file; what fails is named.
  template <class Call>
  void CallFunctions(const char* step, Call call);
  void AskWhetherFinished();

  const Experiment& experiment_;
  const Assignment& assignment_;
  CSwarmanoidSpace space_;
  SpaceState state_;
  std::vector<std::uint32_t> changed_slots_;
  std::vector<std::uint32_t> moved_;
  bool last_ = false;
  bool failed_ = false;
  bool destroyed_ = false;
  SpaceEditor editor_;
  std::vector<Functions> functions_;
};

}  // namespace swarmanoid

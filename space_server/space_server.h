// The role that owns the original space and its clock. A step function: merges what engines and hosts did into the next
// state, after it has checked it: nothing else writes to the space.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/activity/failure_report.h"
#include "common/messages/assignment.h"
#include "common/messages/tick_messages.h"
#include "common/serialisation/bytes.h"
#include "common/space/space.h"
#include "space_server/experiment_functions.h"

namespace swarmanoid
{

// What is asked from outside between two ticks, in the order of arrival at the server.
struct MoveRequest
{
  std::uint32_t entity = 0;
  Pose pose;
  bool present = true;  // false: it leaves the arena, and the pose is where it waits
};

class SpaceServer
{
public:
  // The space at tick 0, its experiment functions initialised. Both references outlive the server. Throws
  // ConfigurationError, or ActivityError naming the functions that failed; so does Advance.
  SpaceServer(const Experiment& experiment, const Assignment& assignment, const std::string& output_folder);
  ~SpaceServer();

  // Who hears that the run goes on, but not as asked; otherwise the log. Called within Advance.
  void SetWarningHandler(std::function<void(const std::string&)> warn) { warn_ = std::move(warn); }

  // Likewise: who hears of controllers that failed while the run goes on.
  using FaultHandler = std::function<void(const std::vector<RecordedFault>& of_a_tick)>;
  void SetFaultHandler(FaultHandler handler) { fault_ = std::move(handler); }

  const CSwarmanoidSpace& Space() const { return space_; }
  // For those who change the experiment from outside physics.
  SpaceEditor& Editor() { return editor_; }
  // The state at the current tick as what changed; what the cluster publishes. It stays until that of the tick after
  // the next one is asked for.
  const SpaceState& State();
  // The entities that were put elsewhere at the current tick, ascending.
  std::span<const std::uint32_t> Moved();
  void WriteSnapshot(SpaceSnapshot& snapshot) const;
  // What the server remembers beside the snapshot. Saving throws std::runtime_error if experiment functions cannot
  // be saved (HasState is false), or began the run again.
  void SaveState(ByteWriter& state) const;
  // The space as in the snapshot, which must fit it; what is sent next is complete only for those who have it too.
  void LoadState(const SpaceSnapshot& snapshot, ByteReader& state);

  // After LoadState, for those who have the state of the tick before: these attributes have changed since.
  void Resend(const AttributeChanges& changes) { changed_slots_ = changes.slots; }

  // For what comes from another process, before Advance; roles of this process have checked their results themselves.
  // Throw std::runtime_error that names the engine or the host which gave what cannot be part of the state, the entity,
  // the tick of the step and the value.
  void Check(const EngineUpdate& update) const;
  void Check(const ControlCommands& commands) const;
  // To the next tick: updates in engine order (all engines), commands in host order (those that report to the server),
  // all checked. An attribute set by both an engine and a host has the engine's value. Entities that their engine took
  // beyond the limit of the world are treated as the experiment says.
  void Advance(std::span<const EngineUpdate* const> updates, std::span<const ControlCommands* const> commands);
  // Puts entities elsewhere, into the arena or out of it at the current tick, before its state goes out: all or none.
  // Those that hold one another go on to, if they all stay in the arena; what they hold otherwise, and who else holds
  // them, lets go. Throws StateError for what cannot be a pose, or is too far from the arena.
  void Move(std::span<const MoveRequest> requests);
  void Move(const MoveRequest& request) { Move({&request, 1}); }
  // Changes one attribute at the current tick, before its state goes out. Throws StateError for a value that it cannot
  // have. Of who is held, 0 alone is taken, which ends the hold.
  void SetAttribute(std::uint32_t slot, double value);
  // All roles read this space: they are in one process with the server.
  void ShareSpace() { shares_space_ = true; }
  // As SpaceEditor says.
  void BeginAgain(std::uint64_t first_tick, std::uint32_t variation);
  // The current tick is the last one.
  void Finish() { last_ = true; }
  // True if Finish was called, or the experiment functions ended the run.
  bool IsFinished() const { return last_; }
  // Has experiment functions draw, if something changed since they did. Throws as Advance does.
  void Draw();
  // The states that go out have what they drew.
  void SetDrawsIntoStates() { draws_into_states_ = true; }
  // Gives all experiment functions a key ("I"), pressed or released, or selects an entity (its id; empty: none). Throws
  // std::invalid_argument if there are no functions, no such key or no such entity.
  void PressKey(const std::string& key, bool pressed);
  void Select(const std::string& id);
  // Ends the experiment functions, once; later calls do nothing.
  void Destroy();
  // True if the experiment functions say that the experiment failed: exit code 1.
  bool HasFailed() const { return failed_; }

  // True if maxclock is reached or Finish was called.
  bool IsLast() const { return last_ || (experiment_.max_clock != 0 && space_.GetTick() >= experiment_.max_clock); }

private:
  void TellFaults(std::span<const ControlCommands* const> commands) const;
  struct Functions
  {
    const FunctionsConfiguration* configuration;
    Actor actor;
    std::unique_ptr<CExperimentFunctions> object;
  };

  void Merge(const EngineUpdate& update);
  void Merge(const AttributeChanges& changes);
  // Holds or removes those that the engine took beyond the limit.
  void SetPosesWithinLimit(const EngineUpdate& update, std::span<const std::uint32_t> owned);
  void Put(std::span<const MoveRequest> requests);
  // Ends the holds of an entity but those on or by `kept` (ascending).
  void EndHolds(std::uint32_t entity, std::span<const std::uint32_t> kept);
  void EndHold(std::uint32_t gripper, std::uint32_t gripped);
  void Change(std::uint32_t slot, double value);
  // Calls a step of all functions in the order of the file; what fails is named.
  template <class Call>
  void CallFunctions(ActivityStep step, Call call);
  void AskWhetherFinished();
  void Tell(const UserInput& input);
  void RequireFunctions() const;

  // When they drew last.
  struct DrawnAt
  {
    std::uint64_t tick, poses, attributes, inputs;
    bool operator==(const DrawnAt&) const = default;
  };

  const Experiment& experiment_;
  const Assignment& assignment_;
  CSwarmanoidSpace space_;
  std::array<SpaceState, 2> states_;  // of even and odd ticks
  std::vector<std::uint32_t> changed_slots_;
  std::vector<std::uint32_t> moved_;
  std::vector<bool> told_;  // of each entity: whether it is told already that it was held
  bool shares_space_ = false;
  bool last_ = false;
  bool failed_ = false;
  bool destroyed_ = false;
  SpaceEditor editor_;
  StreamKey program_random_;  // of those who change the experiment between two steps
  std::vector<Functions> functions_;
  std::function<void(const std::string&)> warn_;
  FaultHandler fault_;
  Drawing drawing_;
  bool draws_into_states_ = false;
  bool told_full_ = false;
  std::optional<DrawnAt> drawn_at_;
  std::uint64_t inputs_ = 0;
  std::uint32_t selected_ = kNobody;
  static constexpr std::uint32_t kNobody = ~0U;
};

}  // namespace swarmanoid

// SpaceServer: the role that owns the original space and its clock. It is a step function: it checks the results of
// engines and hosts, and merges them into the next state. No other code writes to the space.
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
#include "space_server/batteries.h"
#include "space_server/experiment_functions.h"

namespace swarmanoid
{

// A move that a user or the experiment asks for between two ticks. Moves are carried out in the order of arrival.
struct MoveRequest
{
  std::uint32_t entity = 0;
  Pose pose;
  bool present = true;  // false: the entity leaves the arena, and the pose is its waiting pose
};

class WorkerPool;

class SpaceServer
{
public:
  // Makes the space at tick 0 and initialises the experiment functions. The references must outlive the server. Throws
  // ConfigurationError, or ActivityError with the name of the functions that failed. Advance throws the same.
  SpaceServer(const Experiment& experiment, const Assignment& assignment, const std::string& output_folder);
  ~SpaceServer();

  // Sets the receiver of warnings: the run goes on, but not exactly as requested. The default is the log. Called within
  // Advance.
  void SetWarningHandler(std::function<void(const std::string&)> warn) { warn_ = std::move(warn); }

  // Sets the receiver of reports about controllers that failed in a run that goes on. Called within Advance.
  using FaultHandler = std::function<void(const std::vector<RecordedFault>& of_a_tick)>;
  void SetFaultHandler(FaultHandler handler) { fault_ = std::move(handler); }

  const CSwarmanoidSpace& Space() const { return space_; }
  // Returns the editor for changes from outside physics.
  SpaceEditor& Editor() { return editor_; }
  // Returns the changes of the state at the current tick, as the cluster publishes them. The reference is valid until
  // State is called for the tick after the next one.
  const SpaceState& State();
  // Returns the entities that were moved from outside physics at the current tick, ascending.
  std::span<const std::uint32_t> Moved();
  void WriteSnapshot(SpaceSnapshot& snapshot) const;
  // Saves the server's own state, which is not in the snapshot. Throws std::runtime_error if experiment functions
  // cannot be saved (HasState is false) or have begun the run again.
  void SaveState(ByteWriter& state) const;
  // Restores the space from a snapshot, which must fit it. The next state that is sent is complete only for processes
  // that have the snapshot too.
  void LoadState(const SpaceSnapshot& snapshot, ByteReader& state);

  // Marks the attributes and cells of floor fields that this recorded state changed as changed after LoadState, for
  // processes that have the state of the tick before.
  void Resend(const SpaceState& state);

  // Checks messages of other processes before Advance; roles in this process check their results themselves. Throws
  // std::runtime_error that names the engine or host, the entity, the tick of the step and the wrong value.
  void Check(const EngineUpdate& update) const;
  void Check(const ControlCommands& commands) const;
  // Advances the space to the next tick. The updates of all engines are in engine order, and the commands of hosts that
  // report to the server are in host order. All must be checked. If an engine and a host set the same attribute, the
  // engine's value counts. The experiment file says what happens to entities beyond the limit of the world.
  void Advance(std::span<const EngineUpdate* const> updates, std::span<const ControlCommands* const> commands);
  // Moves entities, into the arena or out of it, at the current tick and before its state is sent: all or none. Grips
  // between moved entities stay if these all stay in the arena. All other grips of moved entities end. Throws
  // StateError for values that are no pose, and for positions too far from the arena.
  void Move(std::span<const MoveRequest> requests);
  void Move(const MoveRequest& request) { Move({&request, 1}); }
  // Changes one attribute at the current tick, before its state is sent. Throws StateError for a value outside its
  // range. The attribute "gripped" accepts only 0, which ends the grip.
  void SetAttribute(std::uint32_t slot, double value);
  // Changes a cell of the floor fields at the current tick, before its state is sent. The value must be from 0 to
  // FloorField::kMost.
  void SetFieldCell(std::uint32_t cell, float value);
  // States that all roles read this space, since they are in one process with the server.
  void ShareSpace() { shares_space_ = true; }
  // The threads of the pool share the work of Advance from now on.
  void UseThreads(WorkerPool* pool) { pool_ = pool; }
  // Does what SpaceEditor::BeginAgain describes.
  void BeginAgain(std::uint64_t first_tick, std::uint32_t variation);
  // Makes the current tick the last one.
  void Finish() { last_ = true; }
  // Returns true if Finish was called, or the experiment functions ended the run.
  bool IsFinished() const { return last_; }
  // Calls Draw of the experiment functions, if something has changed since they last drew. Throws as Advance does.
  void Draw();
  // Puts the drawings of the experiment functions into the states that are sent.
  void SetDrawsIntoStates() { draws_into_states_ = true; }
  // Passes a key ("I"), pressed or released, to all experiment functions, or selects an entity by its id (empty: none).
  // Throws std::invalid_argument if there are no functions, no such key or no such entity.
  void PressKey(const std::string& key, bool pressed);
  void Select(const std::string& id);
  // Ends the experiment functions once; later calls do nothing.
  void Destroy();
  // Returns true if the experiment functions say that the experiment failed: exit code 1.
  bool HasFailed() const { return failed_; }
  // Returns which experiment functions ended the run as failed, and the reason if they gave one; empty if none did.
  const std::string& Failure() const { return failure_; }

  // Returns true if maxclock is reached or Finish was called.
  bool IsLast() const { return last_ || (experiment_.max_clock != 0 && space_.GetTick() >= experiment_.max_clock); }

private:
  void TellFaults(std::span<const ControlCommands* const> commands) const;
  struct Functions
  {
    const FunctionsConfiguration* configuration;
    Actor actor;
    std::unique_ptr<CExperimentFunctions> object;
    // The random streams of each step, made at its first call.
    std::array<std::optional<StreamKey>, static_cast<std::size_t>(ActivityStep::kInput) + 1> streams{};
  };

  void Merge(const EngineUpdate& update);
  void Merge(const AttributeChanges& changes);
  // Takes the poses of an engine. Entities beyond the limit are held at it or removed.
  void SetPosesWithinLimit(const EngineUpdate& update, std::span<const std::uint32_t> owned);
  // Returns the update, with the present poses of entities that other engines move.
  const EngineUpdate& OwnPart(const EngineUpdate& update);
  // Gives entities that left the volumes of their engines to others.
  void HandOverAll();
  // An entity that was put elsewhere from outside gets the first engine whose volume has it, whichever it had.
  void HandOver(std::size_t choice, bool was_put);
  void Put(std::span<const MoveRequest> requests);
  // Ends all grips of an entity except those with entities in `kept` (ascending).
  void EndHolds(std::uint32_t entity, std::span<const std::uint32_t> kept);
  void EndHold(std::uint32_t gripper, std::uint32_t gripped);
  void Change(std::uint32_t slot, double value);
  // Calls a step of all functions in the order of the file. An exception is thrown again with the id of the functions.
  template <class Call>
  void CallFunctions(ActivityStep step, Call call);
  void AskWhetherFinished();
  void Tell(const UserInput& input);
  void RequireFunctions() const;

  // The state at which the functions last drew.
  struct DrawnAt
  {
    std::uint64_t tick, poses, attributes, inputs;
    bool operator==(const DrawnAt&) const = default;
  };

  const Experiment& experiment_;
  const Assignment& assignment_;
  CSwarmanoidSpace space_;
  Batteries batteries_;
  std::array<SpaceState, 2> states_;  // for even and odd ticks
  std::vector<std::uint32_t> changed_slots_;
  std::vector<std::uint32_t> changed_cells_;  // of floor fields
  std::vector<std::uint32_t> moved_;
  std::vector<bool> told_;  // by entity: whether its hold at the limit was reported
  EngineUpdate own_part_;   // scratch
  WorkerPool* pool_ = nullptr;
  bool shares_space_ = false;
  bool last_ = false;
  bool failed_ = false;
  std::string failure_;  // why; not saved, since a run that failed has ended
  bool destroyed_ = false;
  SpaceEditor editor_;
  StreamKey program_random_;  // for programs that change the experiment between two steps
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

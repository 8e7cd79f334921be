// WorkerMembership is a worker's membership in a run, from the search for the space server to the Leave. It has a phase
// and one transition function. WorkerSession reports messages and the time to it, and does what it returns. It uses no
// bus, thread or clock. docs/recovery.md prints the table.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "common/activity/activity.h"
#include "idl/messages.h"

namespace swarmanoid
{

class WorkerMembership
{
public:
  // From kStuck to kFailed are the ends, the weakest first. Until the process leaves, a stronger one replaces a weaker.
  enum class Phase : std::uint8_t
  {
    kSearching,    // no space server was heard
    kJoining,      // the process builds its part of the world, and matches the others
    kReady,        // the process said that it can step
    kStepping,     // ticks pass
    kFinishing,    // the last tick has come
    kStuck,        // a dead process holds a lock of the shared memory
    kCutOff,       // the space server has gone
    kRunOver,      // the space server reported the end of the run
    kRunFailed,    // the space server reported a failure of the run, or refused this process
    kInterrupted,  // a signal asked for the end
    kFailed,       // this process failed
    kLeaving,      // the process repeats its Leave until the server answers
    kLeft
  };
  enum class Event : std::uint8_t
  {
    kWorldHeard,
    kPrepared,    // the process can step
    kTickPassed,  // a tick has passed since the process was ready
    kLastTick,
    kUnheard,  // the last message is old and may be lost
    kBusStuck,
    kServerGone,
    kServerLeft,
    kServerFailed,
    kInterrupted,
    kOwnFailure,
    kNextServer,  // another server resumes the run
    kWorkEnded,   // the process has nothing more to do
    kAnswered     // the server has read the Leave
  };
  enum class Action : std::uint8_t
  {
    kNone,
    kSayJoin,
    kSayReady,
    kSayLeave
  };
  static constexpr std::array<std::string_view, 13> kPhases{
      "Searching", "Joining",   "Ready",       "Stepping", "Finishing", "Stuck", "CutOff",
      "RunOver",   "RunFailed", "Interrupted", "Failed",   "Leaving",   "Left"};
  static constexpr std::array<std::string_view, 14> kEvents{
      "WorldHeard", "Prepared",     "TickPassed",  "LastTick",   "Unheard",    "BusStuck",  "ServerGone",
      "ServerLeft", "ServerFailed", "Interrupted", "OwnFailure", "NextServer", "WorkEnded", "Answered"};
  static constexpr std::array<std::string_view, 4> kActions{"", "say Join", "say Join, ready", "say Leave"};

  struct Next
  {
    Phase phase;
    Action action = Action::kNone;
    bool operator==(const Next&) const = default;
  };
  static Next Transition(Phase phase, Event event);

  using Time = std::chrono::steady_clock::time_point;

  // An observer: a failure of the run is a failure of this process, and another server may go on with the run.
  void Observe() { observes_ = true; }
  bool Observes() const { return observes_; }

  // Handles an event. `text` says why, for kServerFailed and kOwnFailure.
  Action On(Event event, Time now, const std::string& text = {});
  // Handles a Leave message of any process. `process`: "host:pid" of this one; `run`: the run of the world.
  void Heard(const LeaveMessage& leave, const std::string& process, std::uint64_t run, Time now);
  // `server`: "host:pid" of the server. `replaces`: dead processes are replaced, so the wait for a lock is shorter.
  Action HeardWorld(const std::string& server, bool replaces, Time now);
  Action JoinNext(const std::string& server, bool replaces, Time now);
  void AtTick(std::uint64_t tick, Time now);

  // The observations that the process makes repeatedly.
  struct Sight
  {
    bool is_interrupted = false;
    bool bus_is_broken = false;
    bool server_is_gone = false;
  };
  Action Look(const Sight& sight, Time now);

  Phase Now() const { return phase_; }
  bool HasEnded() const { return phase_ >= Phase::kStuck; }
  // Returns how this process ended, before it leaves; none if its work was done.
  std::optional<Phase> End() const { return end_; }
  // Returns the reason of the end, for people.
  std::string Text() const;
  EndReason Reason() const;
  int ExitCode() const;
  std::uint64_t Tick() const { return tick_; }
  const std::string& Server() const { return server_; }
  // Returns whether the process of that name has finished its work, at that tick or a later one.
  bool HasLeft(const std::string& name, std::uint64_t tick) const;

private:
  Phase phase_ = Phase::kSearching;
  std::optional<Phase> end_;
  bool observes_ = false;
  bool replaces_ = false;
  std::string server_;  // "host:pid"
  std::string text_;
  std::uint64_t tick_ = 0;
  std::optional<std::uint64_t> first_tick_;  // the first one after it was ready
  Time said_;
  Time leaves_since_;
  std::chrono::milliseconds repeat_after_{};
  std::optional<Time> broken_since_;
  std::map<std::string, std::uint64_t> left_;  // last tick by name
};

}  // namespace swarmanoid

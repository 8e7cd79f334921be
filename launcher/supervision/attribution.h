// Attribution: finds the process of a cluster that failed, as opposed to processes that ended because of it, and makes
// the line about it. The functions are pure. Their input is the reports of processes and how they ended. The supervisor
// uses them.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "common/activity/activity.h"
#include "common/program/process.h"
#include "space_server/worker_placement.h"

namespace swarmanoid
{

// A process has reported this on its page (ActivityPage).
struct ActivityRecord
{
  bool taken = false;  // the process has taken over the page
  std::uint64_t tick = 0;
  Actor::Kind kind = Actor::kNobody;
  std::uint32_t number = 0;
  ActivityStep step = ActivityStep::kNone;
  EndReason end = EndReason::kUnknown;
  std::uint64_t ended_ns = 0;
  bool complete = false;
  std::string cause;
};
ActivityRecord ReadActivity(const ActivityPage* page);

// How much the end of a process says about the failure; lower values say more.
enum class Evidence
{
  kDeath,        // it was killed, or reports the failure of users' code
  kFailure,      // the process itself failed
  kEarlyEnd,     // the process ended without a failure before the run did; the run may still end well
  kConsequence,  // the process ended because another one did
  kNone
};
// Returns the evidence of a process. `ended` is empty while the process runs; it may have reported a failure already.
Evidence EvidenceOf(const std::optional<ProcessEnd>& ended, const ActivityRecord& record);

// Returns true if a process has ended because a dead one holds a lock of their shared memory. Other processes with this
// memory will then stop too.
bool IsStuck(const std::optional<ProcessEnd>& ended);

// Returns true if a process has died without a report of a mistake, so that a process that replaces it may get further.
// `elsewhere` means that it was started on another machine.
bool MayBeReplaced(const ProcessEnd& ended, const ActivityRecord& record, bool elsewhere);
// Returns true if SIGKILL ended the process, or its connection by ssh failed. Its own code is then not the cause.
bool WasKilled(const ProcessEnd& ended, bool elsewhere);

// The deaths of a process while the run makes no progress.
class DeathCount
{
public:
  // Counts a death. `ticks` is the number of ticks that the server has reported as done. Returns false, and counts
  // nothing, if `most` deaths are counted already or if the process died like the last time.
  bool Add(std::uint64_t ticks, const ActivityRecord& record, unsigned most);

private:
  unsigned count_ = 0;
  std::uint64_t ticks_ = 0;  // the run has made progress once more ticks than these are done
  ActivityRecord last_;
};

// FailureText describes such a process in one line: its name, the failure and the tick. `actor_of` names the code that
// ran in a killed process. `server_tick` is the run's tick, for processes without their own. `killed_for_memory` is the
// result of KernelKillsForMemory.
struct FailedProcess
{
  std::string name;
  std::string machine = kHere;
  std::optional<ProcessEnd> end;
  ActivityRecord record;
};
using ActorNames = std::function<Actor(Actor::Kind kind, std::uint32_t number)>;
std::string FailureText(const FailedProcess& failed, std::uint64_t server_tick, const ActorNames& actor_of,
                        bool killed_for_memory);

// Returns the number of processes that the kernel has killed so far for lack of memory.
std::uint64_t KernelKillsForMemory();

}  // namespace swarmanoid

// Attribution: which process of a cluster failed, as opposed to those that ended because it did, and the line that says
// so. Pure functions over what processes say of themselves and how they ended; used by the supervisor.
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

// What a process says of itself on its page (ActivityPage).
struct ActivityRecord
{
  bool taken = false;  // it has the page
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

// How much an end says about who failed; the lower, the more.
enum class Evidence
{
  kDeath,        // it was killed, or reports the failure of somebody's code
  kFailure,      // it failed by itself
  kEarlyEnd,     // it ended without a failure before the run did; that may still come to its end
  kConsequence,  // it ended since another one did
  kNone
};
// `ended`: nothing while the process runs; it may have said already that it failed.
Evidence EvidenceOf(const std::optional<ProcessEnd>& ended, const ActivityRecord& record);

// Whether a process has ended since one that died holds a lock of the shared memory that they had: then no other
// process gets further in this memory.
bool IsStuck(const std::optional<ProcessEnd>& ended);

// Whether a process has died, rather than said what is wrong, so that a process that replaces it may get further.
// `elsewhere`: it was started on another machine.
bool MayBeReplaced(const ProcessEnd& ended, const ActivityRecord& record, bool elsewhere);
// Whether somebody else ended it, or the connection to it: not by what it did.
bool WasKilled(const ProcessEnd& ended, bool elsewhere);
// Whether both died of the same step of the same code: whoever comes next will, too.
bool DiedAlike(const ActivityRecord& a, const ActivityRecord& b);

// One line: who failed, how, and at which tick. `actor_of` names who ran in a process that was killed; `server_tick` is
// that of the run, for processes that say none; `killed_for_memory` as KernelKillsForMemory tells.
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

// How many processes the kernel has killed so far for want of memory.
std::uint64_t KernelKillsForMemory();

}  // namespace swarmanoid

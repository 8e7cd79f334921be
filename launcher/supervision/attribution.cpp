// When one process fails, the others end soon after it, and the order in which the launcher hears of their ends is
// random. So each end is weighed by what the process reported in shared memory and how it ended. The supervisor names
// the process with the strongest evidence. An end because of others is the weakest.
//
// Invariant: the result depends only on the reports and the ends, so tests give them as data.
#include "launcher/supervision/attribution.h"

#include <fmt/format.h>
#include <signal.h>

#include <algorithm>
#include <fstream>

#include "common/errors/exit_codes.h"

namespace swarmanoid
{
namespace
{

constexpr int kSshFailed = 255;

// Returns true if both died in the same step of the same code. A process that replaces them will die there too.
bool DiedAlike(const ActivityRecord& a, const ActivityRecord& b)
{
  return a.end == EndReason::kDied && b.end == EndReason::kDied && a.kind == b.kind && a.number == b.number &&
         a.step == b.step && a.tick == b.tick;
}

}  // namespace

ActivityRecord ReadActivity(const ActivityPage* page)
{
  ActivityRecord record;
  if (page == nullptr || page->taken == 0) return record;
  record.taken = true;
  record.end = static_cast<EndReason>(page->end.load(std::memory_order_acquire));
  record.tick = page->tick;
  record.kind = static_cast<Actor::Kind>(page->kind.load());
  record.number = page->number;
  record.step = static_cast<ActivityStep>(page->step.load());
  record.ended_ns = page->ended_ns;
  record.complete = page->complete != 0;
  if (record.end != EndReason::kUnknown) record.cause = page->cause;
  return record;
}

Evidence EvidenceOf(const std::optional<ProcessEnd>& ended, const ActivityRecord& record)
{
  if (IsStuck(ended)) return Evidence::kDeath;
  switch (record.end)
  {
    case EndReason::kFailed:
    case EndReason::kDied:
      return record.complete ? Evidence::kDeath : Evidence::kFailure;
    case EndReason::kInvalid:
    case EndReason::kInterrupted:
      return Evidence::kFailure;
    case EndReason::kOthers:
      return ended ? Evidence::kConsequence : Evidence::kNone;
    case EndReason::kDone:
    case EndReason::kUnknown:
      break;
  }
  if (!ended) return Evidence::kNone;
  if (ended->signal != 0) return Evidence::kDeath;
  if (ended->exit_code == kExitOthersFailed || ended->exit_code == kExitCutOff) return Evidence::kConsequence;
  if (ended->exit_code != 0) return Evidence::kFailure;
  // Our programs report that their work is done before they end.
  return record.taken && record.end == EndReason::kUnknown ? Evidence::kDeath : Evidence::kEarlyEnd;
}

bool IsStuck(const std::optional<ProcessEnd>& ended) { return ended && ended->exit_code == kExitStuck; }

bool MayBeReplaced(const ProcessEnd& ended, const ActivityRecord& record, bool elsewhere)
{
  constexpr int kKilledThere = 128;  // from here on: a signal ended the process there, or the connection failed
  if (ended.exit_code == kExitCutOff) return true;
  switch (record.end)
  {
    case EndReason::kDied:
      return true;
    case EndReason::kDone:
      return ended.signal != 0;
    case EndReason::kOthers:
      // A cut link makes both sides give up each other. The process ended because of that, and may be replaced if it
      // was killed.
      return WasKilled(ended, elsewhere);
    case EndReason::kUnknown:
      // The program has reported its mistake, and another process would report the same.
      if (ended.exit_code == kExitUsage || ended.exit_code == kExitInvalidFile) return false;
      return ended.signal != 0 || record.taken ||
             (elsewhere && ended.exit_code >= kKilledThere && ended.exit_code != kExitInterrupted);
    default:
      return false;
  }
}

bool WasKilled(const ProcessEnd& ended, bool elsewhere)
{
  return ended.signal == SIGKILL || (elsewhere && (ended.exit_code == 128 + SIGKILL || ended.exit_code == kSshFailed));
}

bool DeathCount::Add(std::uint64_t ticks, const ActivityRecord& record, unsigned most)
{
  if (ticks > ticks_) *this = {};
  if (count_ >= most || DiedAlike(last_, record)) return false;
  ++count_;
  // The tick in which it died may be done, and the server's report of it comes late. After a restart earlier ticks come
  // again.
  ticks_ = std::max({ticks_, ticks, record.tick + 1});
  last_ = record;
  return true;
}

std::string FailureText(const FailedProcess& failed, std::uint64_t server_tick, const ActorNames& actor_of,
                        bool killed_for_memory)
{
  const ActivityRecord& record = failed.record;
  const bool says = record.end != EndReason::kUnknown && record.end != EndReason::kDone;
  if (says && !record.cause.empty()) return record.cause;

  std::string what = "has not ended";
  if (failed.end) what = failed.end->Clean() ? "ended before the last tick" : failed.end->Text();
  if (failed.end && failed.end->exit_code == kExitCutOff) what = "was cut off from the space server";
  if (failed.end && failed.end->signal == SIGKILL && killed_for_memory)
    what += " by the kernel, since memory was short (--memory-limit sets a limit that tells who takes too much)";
  const bool is_here = failed.machine == kHere;
  if (failed.end && failed.end->exit_code == kSshFailed && !is_here)
    what += " (by ssh: the connection failed, or a signal ended the process there)";
  std::string text = fmt::format("{}{} {}", failed.name, is_here ? "" : " on " + failed.machine, what);
  const Actor actor = actor_of && record.kind != Actor::kNobody ? actor_of(record.kind, record.number) : Actor();
  if (actor.kind != Actor::kNobody) return text + ", during " + ActivityText(actor, record.step, record.tick);
  return text + fmt::format(" at tick {}", record.taken && record.tick > 0 ? record.tick : server_tick);
}

std::uint64_t KernelKillsForMemory()
{
  std::ifstream counters("/proc/vmstat");
  std::string name;
  for (std::uint64_t value = 0; counters >> name >> value;)
    if (name == "oom_kill") return value;
  return 0;
}

}  // namespace swarmanoid

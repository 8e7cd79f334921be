// Transition is the table of all phases and events, as a pure function; docs/recovery.md prints it, and tests go
// through it. Messages may be lost, so each message of a phase is repeated until an event shows that it was heard.
//
// Invariants: a worker whose work has ended repeats its Leave until the server answers, or leaves silently if the
// server expects no message of it. A stronger end replaces a weaker one, never the other way round.
#include "common/bus/membership/worker_membership.h"

#include <fmt/format.h>
#include <algorithm>

#include "common/errors/exit_codes.h"

namespace swarmanoid
{
namespace
{

using namespace std::chrono_literals;
using Phase = WorkerMembership::Phase;
using Event = WorkerMembership::Event;
using Action = WorkerMembership::Action;

constexpr std::chrono::milliseconds kJoinAgain = 1s;
constexpr std::chrono::milliseconds kFirstLeaveAgain = 100ms;
constexpr std::chrono::milliseconds kLastLeaveAgain = 1s;
constexpr auto kBrokenTime = 5s;       // for the lease of a dead process to end
constexpr auto kStuckTime = 2s;        // the same, if another process may replace it
constexpr auto kInterruptedTime = 1s;  // for the answer to a Leave, if the process was asked to end

std::optional<Phase> EndOf(Event event)
{
  switch (event)
  {
    case Event::kBusStuck:
      return Phase::kStuck;
    case Event::kServerGone:
      return Phase::kCutOff;
    case Event::kServerLeft:
      return Phase::kRunOver;
    case Event::kServerFailed:
      return Phase::kRunFailed;
    case Event::kInterrupted:
      return Phase::kInterrupted;
    case Event::kOwnFailure:
      return Phase::kFailed;
    default:
      return std::nullopt;
  }
}

// Returns whether the server still expects a message of this process.
bool IsExpected(Phase phase)
{
  return phase < Phase::kStuck || phase == Phase::kInterrupted || phase == Phase::kFailed;
}

}  // namespace

WorkerMembership::Next WorkerMembership::Transition(Phase phase, Event event)
{
  const bool is_in_run = phase == Phase::kJoining || phase == Phase::kReady || phase == Phase::kStepping;
  if (const auto end = EndOf(event))
  {
    const bool needs_server = event == Event::kServerGone || event == Event::kServerLeft;
    if (phase == Phase::kLeaving && event != Event::kOwnFailure) return {Phase::kLeft};
    if (phase >= *end || (phase == Phase::kSearching && needs_server)) return {phase};
    return {*end};
  }
  switch (event)
  {
    case Event::kWorldHeard:
      if (phase == Phase::kSearching) return {Phase::kJoining, Action::kSayJoin};
      break;
    case Event::kPrepared:
      if (is_in_run) return {Phase::kReady, Action::kSayReady};
      break;
    case Event::kTickPassed:
      if (phase == Phase::kReady) return {Phase::kStepping};
      break;
    case Event::kLastTick:
      if (is_in_run) return {Phase::kFinishing};
      break;
    case Event::kUnheard:
      if (phase == Phase::kJoining) return {phase, Action::kSayJoin};
      if (phase == Phase::kReady || phase == Phase::kFinishing) return {phase, Action::kSayReady};
      if (phase == Phase::kLeaving) return {phase, Action::kSayLeave};
      break;
    case Event::kNextServer:
      if (phase == Phase::kCutOff) return {Phase::kReady, Action::kSayReady};
      break;
    case Event::kWorkEnded:
      if (phase >= Phase::kLeaving) break;
      if (phase == Phase::kSearching || !IsExpected(phase)) return {Phase::kLeft};
      return {Phase::kLeaving, Action::kSayLeave};
    case Event::kAnswered:
      if (phase == Phase::kLeaving) return {Phase::kLeft};
      break;
    default:
      break;
  }
  return {phase};
}

Action WorkerMembership::On(Event event, Time now, const std::string& text)
{
  const Next next = Transition(phase_, event);
  if (next.phase != phase_)
  {
    if (const auto end = EndOf(event); end && next.phase == *end)
    {
      end_ = end;
      text_ = text;
    }
    if (next.phase == Phase::kReady)
    {
      first_tick_.reset();
      end_.reset();
    }
    if (next.phase == Phase::kLeaving)
    {
      leaves_since_ = now;
      repeat_after_ = kFirstLeaveAgain;
    }
    phase_ = next.phase;
  }
  else if (next.action == Action::kSayLeave)
    repeat_after_ = std::min(2 * repeat_after_, kLastLeaveAgain);
  if (next.action != Action::kNone) said_ = now;
  return next.action;
}

void WorkerMembership::Heard(const LeaveMessage& leave, const std::string& process, std::uint64_t run, Time now)
{
  const bool is_of_run = phase_ != Phase::kSearching && leave.run == run;
  if (leave.name != "space server")
  {
    if (is_of_run && leave.error.empty()) left_[leave.name] = leave.tick;
    return;
  }
  const bool is_for_this = leave.process == process;
  if (!leave.process.empty() && !is_for_this) return;
  // The end of an access grant is reported without a world.
  const bool ends_share = phase_ == Phase::kSearching && !is_for_this && !leave.error.empty();
  if (!is_of_run && !ends_share) return;
  if (!leave.error.empty())
    On(Event::kServerFailed, now, leave.error);
  else
    On(is_for_this ? Event::kAnswered : Event::kServerLeft, now);
}

Action WorkerMembership::HeardWorld(const std::string& server, bool replaces, Time now)
{
  server_ = server;
  replaces_ = replaces;
  return On(Event::kWorldHeard, now);
}

Action WorkerMembership::JoinNext(const std::string& server, bool replaces, Time now)
{
  server_ = server;
  replaces_ = replaces;
  return On(Event::kNextServer, now);
}

void WorkerMembership::AtTick(std::uint64_t tick, Time now)
{
  // The run goes on: another process has replaced the one that died with its lock.
  if (tick != tick_) broken_since_.reset();
  tick_ = tick;
  if (phase_ != Phase::kReady) return;
  if (!first_tick_) first_tick_ = tick;
  if (tick != *first_tick_) On(Event::kTickPassed, now);
}

Action WorkerMembership::Look(const Sight& sight, Time now)
{
  const bool leaves = phase_ == Phase::kLeaving;
  if (sight.server_is_gone) On(Event::kServerGone, now);
  if (sight.is_interrupted && (!leaves || now - leaves_since_ > kInterruptedTime)) On(Event::kInterrupted, now);
  if (sight.bus_is_broken)
  {
    if (!broken_since_) broken_since_ = now;
    if (leaves || now - *broken_since_ > (replaces_ ? kStuckTime : kBrokenTime)) On(Event::kBusStuck, now);
  }
  const bool is_old = now - said_ >= (phase_ == Phase::kLeaving ? repeat_after_ : kJoinAgain);
  return is_old ? On(Event::kUnheard, now) : Action::kNone;
}

std::string WorkerMembership::Text() const
{
  switch (end_.value_or(Phase::kFailed))
  {
    case Phase::kStuck:
      return "a process died, or was stopped, while it held shared memory of the run";
    case Phase::kCutOff:
      return fmt::format("the space server has gone (process {})", server_);
    case Phase::kRunOver:
      return "the run has ended";
    case Phase::kInterrupted:
      return "interrupted by a signal";
    default:
      return text_;
  }
}

EndReason WorkerMembership::Reason() const
{
  if (end_ == Phase::kInterrupted) return EndReason::kInterrupted;
  return !end_ || end_ == Phase::kFailed ? EndReason::kFailed : EndReason::kOthers;
}

int WorkerMembership::ExitCode() const
{
  if (end_ == Phase::kInterrupted) return kExitInterrupted;
  if (!end_ || end_ == Phase::kFailed || observes_) return kExitProcessFailed;
  if (end_ == Phase::kStuck) return kExitStuck;
  return end_ == Phase::kCutOff ? kExitCutOff : kExitOthersFailed;
}

bool WorkerMembership::HasLeft(const std::string& name, std::uint64_t tick) const
{
  const auto found = left_.find(name);
  return found != left_.end() && found->second >= tick;
}

}  // namespace swarmanoid

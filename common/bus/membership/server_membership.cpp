// Transition is the table of all phases and events, as a pure function; docs/recovery.md prints it, and tests go
// through it. Messages may come late, again, or from a process that was replaced, so each is compared with the process
// and the incarnation of the member.
//
// Invariants: at any time at most one process is the member of a name; a member that has left never comes back; only
// the first failure of a run is kept.
#include "common/bus/membership/server_membership.h"

#include <fmt/format.h>
#include <algorithm>

namespace swarmanoid
{
namespace
{

// Returns whether the process is the member, or may become it.
bool IsOf(const ServerMembership::Member& member, const std::string& process)
{
  return member.process.empty() || member.process == process;
}

}  // namespace

ServerMembership::Next ServerMembership::Transition(Phase phase, Event event)
{
  const bool is_here = phase == Phase::kJoined || phase == Phase::kReady;
  const bool has_left = phase >= Phase::kDone;
  switch (event)
  {
    case Event::kCame:
      if (phase == Phase::kAwaited) return {Phase::kJoined};
      break;
    case Event::kReplaced:
      if (!has_left) return {Phase::kJoined};
      break;
    case Event::kPrepared:
      if (phase == Phase::kJoined) return {Phase::kReady};
      break;
    case Event::kReleased:
      if (is_here) return {Phase::kReleased};
      break;
    case Event::kWorkDone:
      if (!has_left) return {phase == Phase::kReleased ? Phase::kGone : Phase::kDone, Action::kTellLeft};
      break;
    case Event::kFailed:
      if (phase != Phase::kReleased) return {Phase::kGone, Action::kFailRun};
      break;
    case Event::kLost:
      if (is_here) return {phase, Action::kTellLost};
      break;
    case Event::kMissed:
      if (is_here) return {Phase::kGone, Action::kFailRun};
      break;
  }
  return {phase};
}

ServerMembership::ServerMembership(std::uint64_t run, const std::vector<std::string>& expected) : run_(run)
{
  for (const std::string& name : expected) members_[name];
}

const ServerMembership::Member* ServerMembership::Find(const std::string& name) const
{
  const auto found = members_.find(name);
  return found == members_.end() ? nullptr : &found->second;
}

void ServerMembership::On(const std::string& name, Event event, const std::string& failure)
{
  Member& member = members_.at(name);
  const Next next = Transition(member.phase, event);
  member.phase = next.phase;
  if (next.action == Action::kTellLeft) news_.left.push_back(name);
  if (next.action == Action::kTellLost) news_.lost.push_back(name);
  if (next.action == Action::kFailRun && !is_over_ && !failure_) failure_ = failure;
}

bool ServerMembership::MayJoinAs(const Member& member, const JoinMessage& join) const
{
  if (!awaits_ || member.HasLeft()) return IsOf(member, join.process);
  return join.incarnation > member.incarnation ||
         (join.incarnation == member.incarnation && IsOf(member, join.process));
}

ServerMembership::Verdict ServerMembership::Heard(const JoinMessage& join)
{
  const auto found = members_.find(join.name);
  if (found == members_.end())
  {
    attached_[join.process] = join.name;
    return Verdict::kNothingNew;
  }
  Member& member = found->second;
  if (!MayJoinAs(member, join)) return Verdict::kNameTaken;
  const bool is_another = member.process != join.process;
  // A process repeats its Join until the run begins, and again after the last tick while it waits for others.
  const bool is_known =
      !is_another && member.incarnation == join.incarnation && (!join.ready || member.phase != Phase::kJoined);
  // It may wait for a process that has left, because it missed the Leave. A process that has left does not wait.
  if ((is_known && !member.done_at) || (is_another && join.incarnation > 0))
    for (const auto& [name, other] : members_)
      if (other.done_at && name != join.name) Answer({run_, *other.done_at, name, other.process, ""});
  if (is_known) return Verdict::kNothingNew;
  if (is_another)
  {
    On(join.name, member.process.empty() ? Event::kCame : Event::kReplaced);
    if (!member.process.empty()) member.replaced.insert(member.process);
    member.process = join.process;
    member.status = {};
    member.done_at.reset();
  }
  member.incarnation = join.incarnation;
  member.machine = join.machine;
  member.reach = join.reach;
  if (join.ready) On(join.name, Event::kPrepared);
  if (join.ready && join.incarnation > 0) news_.replaced.emplace_back(join.name, join.incarnation);
  return Verdict::kTaken;
}

// All processes receive each answer. So what many ask for, and what one asks for again, goes once.
void ServerMembership::Answer(const LeaveMessage& answer)
{
  const auto same = [&](const LeaveMessage& other)
  { return other.name == answer.name && other.process == answer.process; };
  const auto waits = std::ranges::find_if(news_.answers, same);
  if (waits == news_.answers.end())
    news_.answers.push_back(answer);
  else
    *waits = answer;
}

void ServerMembership::Heard(const LeaveMessage& leave)
{
  const auto found = members_.find(leave.name);
  const bool is_of_run = found != members_.end() && IsOf(found->second, leave.process);
  // If a replacement's Join was lost, it repeats Join and Leave. An answer now would leave the run waiting for its
  // predecessor.
  const bool is_unheard = found != members_.end() && !is_of_run && awaits_ && !found->second.HasLeft() &&
                          !found->second.replaced.contains(leave.process);
  if (is_unheard) return;
  Answer({leave.run, leave.tick, "space server", leave.process, ""});
  if (!is_of_run) return;
  if (!leave.error.empty())
    return On(leave.name, Event::kFailed, fmt::format("{} failed at tick {}: {}", leave.name, leave.tick, leave.error));
  if (found->second.phase != Phase::kReleased) found->second.done_at = leave.tick;
  On(leave.name, Event::kWorkDone);
}

void ServerMembership::Heard(const StatusMessage& status)
{
  const auto found = members_.find(status.name);
  if (found != members_.end()) found->second.status = status;
}

void ServerMembership::Missed(const std::string& process, bool died)
{
  attached_.erase(process);
  for (const auto& [name, member] : members_)
    if (member.process == process)
      On(name, awaits_ && !is_over_ ? Event::kLost : Event::kMissed,
         fmt::format("{} {} (process {})", name, died ? "does not answer any more" : "has left", process));
}

bool ServerMembership::HeardBad(const std::string& process, const std::string& what)
{
  const auto sender =
      std::ranges::find_if(members_, [&](const auto& member) { return member.second.process == process; });
  if (process.empty() || sender == members_.end()) return false;
  if (!is_over_ && !failure_) failure_ = fmt::format("{} {}", sender->first, what);
  return true;
}

}  // namespace swarmanoid

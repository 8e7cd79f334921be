// How the supervisor ends a run: by its last tick, by request, or by the failure of a process, and of which one.
#include <fmt/format.h>
#include <poll.h>

#include <algorithm>
#include <tuple>
#include <utility>

#include "common/activity/exit_codes.h"
#include "launcher/supervision/supervisor.h"

namespace swarmanoid
{

void Supervisor::CollectEnds()
{
  std::vector<ClusterMember*> ended;
  for (const auto& member : members_)
  {
    pollfd entry{member->Process().end.Get(), POLLIN, 0};
    if (!member->Alive() || poll(&entry, 1, 0) <= 0) continue;
    member->Collect(spawner_);
    ReadMember(*member);
    ended.push_back(member.get());
  }
  for (const ClusterMember* member : ended)
    if (!Replace(*member)) TakeEnd(*member);
}

void Supervisor::TakeEnd(const ClusterMember& member)
{
  if (phase_ == Phase::kDying || phase_ == Phase::kRestarting) return;
  const ProcessEnd& end = *member.End();
  const bool is_server = &member == members_.front().get();

  if (is_server && outcome_.kind == ClusterOutcome::kFinished && end.exit_code == kExitExperimentFailed)
  {
    outcome_.kind = ClusterOutcome::kUnsuccessful;
    return;
  }

  if (IsDone(member)) return;
  // After Ctrl-C all end as interrupted ones do, and some may complain that the space server has gone. The server may
  // not have got as far as catching the signal that asks it to stop. But it waits for each worker that died before it
  // left.
  const bool stopped_early = is_server && phase_ == Phase::kStopping && end.signal == SIGINT;
  const bool stopping =
      phase_ == Phase::kStopping || (phase_ == Phase::kFinishing && outcome_.kind == ClusterOutcome::kInterrupted);
  const bool missed = !is_server && MayBeReplaced(end, member.Record(), !member.Plan().host.empty());
  if (stopping && !missed && (end.signal == 0 || stopped_early))
  {
    if (is_server && !outcome_.finished) Die(now_() + times_.terminate);
    return;
  }

  switch (EvidenceOf(end, member.Record()))
  {
    case Evidence::kDeath:
      ended_.push_back(&member);
      return Attribute();
    case Evidence::kFailure:
      ended_.push_back(&member);
      return AttributeWithin(times_.settle);
    case Evidence::kConsequence:
      ended_.push_back(&member);
      return AttributeWithin(times_.others);
    case Evidence::kEarlyEnd:
      break;
    case Evidence::kNone:
      return;
  }
  if (outcome_.finished) return;
  ended_.push_back(&member);
  AttributeWithin(is_server ? times_.settle : times_.early_end);
}

// It has left in good order, or the one before it had when it was replaced: what happens to it now changes nothing.
bool Supervisor::IsDone(const ClusterMember& member) const
{
  return left_.contains(member.Name()) &&
         (member.Incarnation() > 0 || WasKilled(*member.End(), !member.Plan().host.empty()));
}

std::string Supervisor::TextOf(const ClusterMember& failed) const
{
  const std::string text = FailureText({failed.Name(), failed.Plan().host, failed.End(), failed.Record()},
                                       progress_.tick, actor_of_, KernelKillsForMemory() > kills_for_memory_);
  return retries_ == 0 && failed.NewDeath() ? text +
                                                  "; for its on_failure, processes that die must be replaced: leave "
                                                  "out --no-recovery, --no-journal and --retries 0"
                                            : text;
}

void Supervisor::AttributeWithin(std::chrono::milliseconds patience)
{
  const Clock::time_point at = now_() + patience;
  if (!attribute_at_ || at < *attribute_at_) attribute_at_ = at;
}

// One failure makes the others end too, and they may be collected first. A process that still runs may have said that
// it failed.
void Supervisor::Attribute()
{
  attribute_at_.reset();
  const ClusterMember* first = nullptr;
  std::tuple<Evidence, std::uint64_t> first_rank;
  for (const auto& member : members_)
  {
    const ActivityRecord record = member->Record();
    const auto noticed = std::find(ended_.begin(), ended_.end(), member.get());
    if (noticed == ended_.end() && member->End()) continue;
    Evidence evidence = EvidenceOf(member->End(), record);
    if (evidence == Evidence::kEarlyEnd && left_.contains(member->Name())) continue;
    if (member->End() && IsDone(*member)) continue;
    // For processes of other machines: the server often knows who began.
    const bool accused = evidence == Evidence::kFailure && server_error_.starts_with(member->Name());
    if (accused) evidence = Evidence::kDeath;
    const auto order = static_cast<std::uint64_t>(noticed - ended_.begin());
    const std::tuple rank(evidence, record.ended_ns == 0 ? order : record.ended_ns);
    if (evidence == Evidence::kNone || (first != nullptr && first_rank <= rank)) continue;
    first = member.get();
    first_rank = rank;
  }
  const Evidence evidence = std::get<0>(first_rank);
  if (first == nullptr || (evidence == Evidence::kEarlyEnd && outcome_.finished)) return;
  if (Restart(*first, evidence)) return;
  if (evidence == Evidence::kConsequence && !server_error_.empty()) return Fail(*members_.front(), server_error_, true);
  const ActivityRecord record = first->Record();
  Fail(*first, TextOf(*first), record.complete && !record.cause.empty());
}

void Supervisor::TakeInterrupts()
{
  while (const auto signal = interrupts_.Take())
  {
    // A lost terminal sends more than one, and what was begun may come to its end.
    if (*signal == SIGHUP && phase_ != Phase::kRunning && phase_ != Phase::kRestarting)
    {
      if (phase_ == Phase::kStopping && !deadline_) deadline_ = now_() + times_.forced_stop;
      continue;
    }
    if (phase_ == Phase::kRunning && outcome_.kind == ClusterOutcome::kInterrupted)
    {
      StopAtTick(*signal == SIGINT ? "stopping at the end of this tick; Ctrl-C again kills at once"
                                   : "asked to end: stopping");
      if (*signal != SIGINT) deadline_ = now_() + times_.forced_stop;
      continue;
    }
    if (phase_ != Phase::kDying)
    {
      if (phase_ == Phase::kRestarting) display_.Note("interrupted while all processes start again");
      outcome_.kind = ClusterOutcome::kInterrupted;
      if (phase_ == Phase::kStopping) outcome_.finished.reset();
    }
    phase_ = Phase::kDying;
    KillAll();
  }
}

void Supervisor::StopAtTick(std::string_view why)
{
  phase_ = Phase::kStopping;
  progress_.phase = "stopping";
  display_.Note(why);
  spawner_.Signal(members_.front()->Process(), SIGINT);
}

void Supervisor::CheckDeadlines()
{
  const Clock::time_point now = now_();
  if (attribute_at_ && now >= *attribute_at_ && phase_ != Phase::kDying) return Attribute();
  if (!deadline_ || now < *deadline_) return;

  if (phase_ == Phase::kDying)
  {
    KillAll();
    return;
  }
  if (phase_ == Phase::kStopping) return Die(now + times_.terminate);

  // The last tick is done. Who is still there?
  for (const auto& member : members_)
  {
    if (!member->Alive()) continue;
    progress_.waiting_for = member->Name();
    progress_.waited_s = std::chrono::duration<double>(now - heard_).count();
    const auto patience = member->Plan().visualiser ? times_.finish_visualiser : times_.finish;
    if (now - heard_ >= patience)
      return Fail(*member,
                  fmt::format("{} did not end within {} of the last tick, at tick {}", member->Name(),
                              DurationText(std::chrono::duration<double>(patience).count()), progress_.tick),
                  false);
  }
  deadline_ = now + times_.refresh;
}

// `complete`: the text does not begin with the name of the process.
void Supervisor::Fail(const ClusterMember& member, const std::string& text, bool complete)
{
  const bool invalid =
      member.Record().end == EndReason::kInvalid || (member.End() && member.End()->exit_code == kExitInvalidFile);
  outcome_.kind = invalid ? ClusterOutcome::kInvalid : ClusterOutcome::kFailed;
  outcome_.finished.reset();
  outcome_.reason = text;
  // A mistake of the experiment file has its place: nobody has to look for it in a log.
  if (invalid && member.Record().end == EndReason::kInvalid) return Die(now_() + times_.terminate);
  const bool told = text.find(server_error_) != std::string::npos || member.Record().end != EndReason::kUnknown;
  if (!told) outcome_.reason += fmt::format(" ({})", server_error_);
  outcome_.reason += complete ? fmt::format("; the log of {} is {}", member.Name(), member.Log().Path())
                              : fmt::format("; its log is {}", member.Log().Path());
  if (!member.Log().Trouble().empty()) outcome_.reason += fmt::format(" (incomplete: {})", member.Log().Trouble());
  outcome_.log_lines.assign(member.Log().LastLines().begin(), member.Log().LastLines().end());
  Die(now_() + times_.terminate);
}

void Supervisor::Die(Clock::time_point kill_at)
{
  phase_ = Phase::kDying;
  SignalAll(SIGTERM);
  deadline_ = kill_at;
}

void Supervisor::KillAll()
{
  phase_ = Phase::kDying;
  SignalAll(SIGKILL);
  deadline_ = now_() + times_.refresh;
}

void Supervisor::SignalAll(int signal)
{
  for (const auto& member : members_)
    if (member->Alive()) spawner_.Signal(member->Process(), signal);
}

}  // namespace swarmanoid

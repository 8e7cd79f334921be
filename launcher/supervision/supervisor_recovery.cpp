// How the supervisor replaces processes that died, moves them, and starts all of them again.
#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "launcher/supervision/process_state.h"
#include "launcher/supervision/supervisor.h"
#include "space_server/worker_placement.h"

namespace swarmanoid
{
namespace
{

}  // namespace

// All have ended.
bool Supervisor::MustStartAgain()
{
  if (attribute_at_ && phase_ != Phase::kDying) Attribute();
  return phase_ == Phase::kRestarting;
}

bool Supervisor::Replace(const ClusterMember& member)
{
  const bool server_works = members_.front()->Alive() && &member != members_.front().get() && server_error_.empty();
  const bool goes_on = phase_ == Phase::kRunning || phase_ == Phase::kStopping;
  if (!goes_on || !server_works || !member.Plan().replacement || left_.contains(member.Name())) return false;
  const auto move = moves_.extract(member.Name());
  const bool strayed = move.empty() && IsOnItsWay(member);
  if (IsStuck(member.End()) ||
      (move.empty() && !strayed && !MayBeReplaced(*member.End(), member.Record(), !member.Plan().host.empty())))
    return false;
  MemberPlan plan = member.Plan();
  std::vector<ControllerDeath> deaths = member.Deaths();
  const auto death = retries_ > 0 ? member.NewDeath() : std::nullopt;
  if (death)
    deaths.push_back(*death);
  else if (move.empty() && !CountDeath(member))
    return false;
  if (!move.empty())
  {
    came_from_[member.Name()] = {plan.host, progress_.tick};
    plan.host = move.mapped();
    display_.Note(fmt::format("{} moves to {}", member.Name(),
                              plan.host.empty() ? "another process of this machine" : plan.host));
  }
  else
    display_.Note(fmt::format("{}; another process takes its place", TextOf(member)));
  if (strayed) plan.host = came_from_.extract(member.Name()).mapped().first;
  if (plan.place) plan.place(plan.host);
  kills_for_memory_ = KernelKillsForMemory();
  const auto place =
      std::find_if(members_.begin(), members_.end(), [&](const auto& candidate) { return candidate.get() == &member; });
  try
  {
    auto next = std::make_unique<ClusterMember>(plan, spawner_, member.Incarnation() + 1, 0, std::move(deaths));
    pids_.push_back(next->Process().pid);
    *place = std::move(next);
    return true;
  }
  catch (const std::exception& error)
  {
    display_.Note(error.what());
    return false;
  }
}

bool Supervisor::CountDeath(const ClusterMember& member)
{
  const ActivityRecord record = member.Record();
  Deaths& deaths = deaths_[member.Name()];
  if (progress_.tick > deaths.tick) deaths = {};
  if (deaths.count >= retries_ || DiedAlike(deaths.last, record)) return false;
  // What the server says of its tick comes late; and after a restart, ticks that were done come again.
  deaths = {deaths.count + 1, std::max({deaths.tick, progress_.tick, record.tick}), record};
  return true;
}

bool Supervisor::Restart(const ClusterMember& first, Evidence evidence)
{
  const bool all_can = std::all_of(members_.begin(), members_.end(),
                                   [](const auto& member) { return member->Plan().replacement != nullptr; });
  // A server that has told its result may still have to say by its exit code what the experiment thinks of it.
  const bool goes_on =
      phase_ == Phase::kRunning || (outcome_.kind == ClusterOutcome::kFinished && &first == members_.front().get());
  if (!goes_on || !all_can) return false;
  const bool died =
      first.End() && (IsStuck(first.End()) || MayBeReplaced(*first.End(), first.Record(), !first.Plan().host.empty()));
  if (!died && evidence != Evidence::kConsequence) return false;
  if (!CountDeath(first)) return false;
  display_.Note(fmt::format("{}; all processes start again where the journal ends", TextOf(first)));
  KillToStartAgain();
  return true;
}

void Supervisor::KillToStartAgain()
{
  kills_for_memory_ = KernelKillsForMemory();
  phase_ = Phase::kRestarting;
  outcome_.kind = ClusterOutcome::kInterrupted;
  outcome_.finished.reset();
  outcome_.reset.reset();
  deadline_.reset();
  progress_.phase = "starting again";
  progress_.waiting_for.clear();
  ended_.clear();
  // Some may be stuck.
  SignalAll(SIGKILL);
}

void Supervisor::StartAgain()
{
  left_.clear();
  server_error_.clear();
  attribute_at_.reset();
  phase_ = Phase::kRunning;
  try
  {
    const double taken_s = began_ ? std::chrono::duration<double>(now_() - *began_).count() : 0;
    // Robots, and so their deaths, may be of another host than before.
    std::vector<ControllerDeath> deaths;
    unsigned incarnation = 0;
    std::vector<MemberPlan> plans;
    for (const auto& member : members_)
    {
      deaths.insert(deaths.end(), member->Deaths().begin(), member->Deaths().end());
      if (const auto death = member->NewDeath()) deaths.push_back(*death);
      incarnation = std::max(incarnation, member->Incarnation() + 1);
      plans.push_back(member->Plan());
    }
    if (!next_plans_.empty()) plans = std::exchange(next_plans_, {});
    members_.clear();
    for (const MemberPlan& plan : plans)
    {
      members_.push_back(std::make_unique<ClusterMember>(plan, spawner_, incarnation, taken_s,
                                                         plan.may_fail ? deaths : std::vector<ControllerDeath>()));
      pids_.push_back(members_.back()->Process().pid);
    }
    heard_ = now_();
  }
  catch (const std::exception& error)
  {
    outcome_.kind = ClusterOutcome::kFailed;
    outcome_.reason = error.what();
    KillAll();
  }
}

// It may be stopped, or cut off: nobody hears it any more, and it must not come back.
void Supervisor::KillLost(const std::string& name)
{
  for (const auto& member : members_)
    if (member->Name() == name && member->Alive()) spawner_.Signal(member->Process(), SIGKILL);
}

void Supervisor::Move(const ServerMove& move)
{
  for (const auto& member : members_)
  {
    if (member->Name() != move.name || !member->Alive() || !member->Plan().place) continue;
    moves_[move.name] = move.machine == kHere ? "" : move.machine;
    spawner_.Signal(member->Process(), SIGKILL);
  }
}

void Supervisor::ShareOut(const std::vector<std::string>& machines)
{
  if (phase_ != Phase::kRunning || !plan_again_) return;
  next_plans_ = plan_again_(static_cast<unsigned>(machines.size()));
  std::size_t host = 0;
  for (MemberPlan& plan : next_plans_)
  {
    if (!plan.place) continue;
    const auto before = std::find_if(members_.begin(), members_.end(),
                                     [&](const auto& member) { return member->Name() == plan.command.name; });
    if (before != members_.end()) plan.host = (*before)->Plan().host;
    if (plan.may_fail) plan.host = machines[host] == kHere ? "" : machines[host];
    host += plan.may_fail ? 1 : 0;
    plan.place(plan.host);
  }
  const bool as_many = std::cmp_equal(
      machines.size(),
      std::ranges::count_if(members_, [](const auto& member) { return member->Plan().may_fail != nullptr; }));
  display_.Note(fmt::format("{}{} controller host{} from now on; all processes start again where the journal ends",
                            as_many ? "the robots are shared out anew among " : "", machines.size(),
                            machines.size() == 1 ? "" : "s"));
  KillToStartAgain();
}

bool Supervisor::IsOnItsWay(const ClusterMember& member) const
{
  const auto from = came_from_.find(member.Name());
  return from != came_from_.end() && from->second.second == progress_.tick;
}

// Who was stopped before others met it is missed by nobody's lease.
void Supervisor::KillStopped()
{
  if (times_.stopped.count() == 0 || phase_ != Phase::kRunning) return;
  const Clock::time_point now = now_();
  for (const auto& member : members_)
  {
    const pid_t pid = member->Process().pid;
    if (!member->Alive() || !member->Plan().replacement || !IsStoppedBySignal(pid))
      stopped_.erase(pid);
    else if (now - stopped_.try_emplace(pid, now).first->second >= times_.stopped)
      spawner_.Signal(member->Process(), SIGKILL);
  }
}

}  // namespace swarmanoid

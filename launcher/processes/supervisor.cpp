#include "launcher/processes/supervisor.h"

#include <fmt/format.h>
#include <poll.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "common/activity/exit_codes.h"

namespace swarmanoid
{
namespace
{

constexpr std::size_t kScreenBytes = 2048;  // a pipe that poll calls writable takes these without blocking
constexpr std::size_t kOutputBytes = 65536;
constexpr const char* kLocalMachine = "here";  // in status lines

// The letter of a process, as proc(5) has it.
bool IsInState(pid_t pid, char state)
{
  std::ifstream stat(fmt::format("/proc/{}/stat", pid));
  std::string line;
  std::getline(stat, line);
  return line.find(fmt::format(") {} ", state)) != std::string::npos;
}

// True if the process waits for something by its own will, and does not work, nor was it stopped.
bool IsAsleep(pid_t pid) { return IsInState(pid, 'S'); }

bool TakesMore(int descriptor)
{
  pollfd entry{descriptor, POLLOUT, 0};
  return poll(&entry, 1, 0) > 0;
}

}  // namespace

Supervisor::Supervisor(ProcessSpawner& spawner, Interrupts& interrupts, ProgressDisplay& display, int screen,
                       ActorNames actor_of, const SupervisorTimes& times, std::function<Clock::time_point()> now,
                       unsigned retries)
    : spawner_(spawner),
      interrupts_(interrupts),
      display_(display),
      screen_(screen),
      times_(times),
      now_(std::move(now)),
      retries_(retries),
      actor_of_(std::move(actor_of)),
      kills_for_memory_(KernelKillsForMemory())
{
}

ClusterOutcome Supervisor::Run(const std::vector<MemberPlan>& plans, const GoOn& go_on)
{
  Start(plans, go_on);
  while (AnyAlive() || MustStartAgain())
  {
    if (phase_ == Phase::kRestarting && !AnyAlive()) StartAgain();
    WaitForEvents();
    for (const auto& member : members_) ReadMember(*member);
    CollectEnds();
    TakeInterrupts();
    CheckDeadlines();
    KillStopped();
    ShowProgress();
  }
  display_.Clear();
  return outcome_;
}

// All have ended.
bool Supervisor::MustStartAgain()
{
  if (attribute_at_ && phase_ != Phase::kDying) Attribute();
  return phase_ == Phase::kRestarting;
}

void Supervisor::Start(const std::vector<MemberPlan>& plans, const GoOn& go_on)
{
  outcome_.kind = ClusterOutcome::kInterrupted;
  progress_.phase = go_on.incarnation > 0 ? "starting again" : "starting";
  heard_ = now_();
  if (go_on.incarnation > 0)
    began_ = heard_ - std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(go_on.taken_s));
  try
  {
    for (const MemberPlan& plan : plans)
    {
      if (go_on.incarnation > 0 && !plan.replacement)
        throw std::runtime_error(
            fmt::format("{} cannot be started again{}", plan.command.name,
                        plan.host.empty() ? "" : ": it may live on at " + plan.host + ", where nobody sees it"));
      members_.push_back(std::make_unique<ClusterMember>(plan, spawner_, go_on.incarnation, go_on.taken_s));
      pids_.push_back(members_.back()->Process().pid);
    }
  }
  catch (const std::exception& error)
  {
    outcome_.kind = ClusterOutcome::kFailed;
    outcome_.reason = error.what();
    KillAll();
  }
}

void Supervisor::WaitForEvents()
{
  std::vector<pollfd> entries{{interrupts_.Descriptor(), POLLIN, 0}};
  for (const auto& member : members_)
  {
    if (member->Alive()) entries.push_back({member->Process().end.Get(), POLLIN, 0});
    if (member->Process().errors.IsOpen()) entries.push_back({member->Process().errors.Get(), POLLIN, 0});
    const bool held = screen_full_ && member->Plan().output == MemberPlan::kScreen;
    if (!member->OutputClosed() && !held) entries.push_back({member->Process().output.Get(), POLLIN, 0});
  }
  if (screen_full_) entries.push_back({screen_, POLLOUT, 0});

  auto timeout = times_.refresh;
  if (attribute_at_) timeout = std::min(timeout, times_.settle / 4);
  if (deadline_)
    timeout = std::clamp(
        std::chrono::duration_cast<std::chrono::milliseconds>(*deadline_ - now_()) + std::chrono::milliseconds(1),
        std::chrono::milliseconds(1), times_.refresh);
  poll(entries.data(), entries.size(), static_cast<int>(timeout.count()));
}

void Supervisor::ReadMember(ClusterMember& member)
{
  member.ReadErrors();
  if (member.OutputTaken()) return;
  switch (member.Plan().output)
  {
    case MemberPlan::kLog:
      member.ReadOutput({}, kOutputBytes);
      break;
    case MemberPlan::kScreen:
      screen_full_ = !screen_gone_ && !TakesMore(screen_);
      if (!screen_full_)
        member.ReadOutput([this, &member](std::string_view line) { WriteScreen(member, line); }, kScreenBytes);
      break;
    case MemberPlan::kStatus:
      member.ReadOutput(
          [this, &member](std::string_view line)
          {
            const auto status = ParseServerStatus(line);
            if (const auto* warning = status ? std::get_if<ServerWarning>(&*status) : nullptr)
              TakeWarning(member, *warning);
            else if (status)
              TakeStatus(*status);
            else
              member.AddToLog(line);
          },
          kOutputBytes);
      break;
  }
}

void Supervisor::TakeStatus(const ServerStatus& status)
{
  heard_ = now_();
  if (const auto* state = std::get_if<ServerState>(&status))
  {
    if (phase_ != Phase::kRunning) return;
    switch (state->phase)
    {
      case ServerState::kLoading:
        progress_.phase = "starting";
        break;
      case ServerState::kWaiting:
        progress_.phase = state->waiting_for.empty() ? "starting" : "waiting for " + state->waiting_for;
        break;
      case ServerState::kRunning:
        progress_.phase = "running";
        if (!began_) began_ = heard_;
        break;
      case ServerState::kPaused:
        progress_.phase = "paused";
        if (choice_) choice_->Disturbed();
        break;
    }
  }
  else if (const auto* tick = std::get_if<ServerTick>(&status))
  {
    progress_.waiting_for.clear();
    progress_.tick = tick->tick;
    progress_.max = tick->max;
    progress_.real_time_factor = tick->real_time_factor;
    ChooseHosts();
  }
  else if (const auto* stall = std::get_if<ServerStall>(&status))
  {
    progress_.waiting_for = stall->name;
    progress_.waited_s = stall->seconds;
  }
  else if (const auto* asked = std::get_if<ServerAsked>(&status))
  {
    display_.Note(asked->text);
  }
  else if (const auto* error = std::get_if<ServerError>(&status))
  {
    server_error_ = error->text;
  }
  else if (const auto* left = std::get_if<ServerLeft>(&status))
  {
    left_.insert(left->name);
  }
  else if (const auto* lost = std::get_if<ServerLost>(&status))
  {
    KillLost(lost->name);
  }
  else if (const auto* move = std::get_if<ServerMove>(&status))
  {
    Move(*move);
  }
  else if (const auto* reset = std::get_if<ServerReset>(&status))
  {
    outcome_.reset = *reset;
  }
  else if (const auto* hosts = std::get_if<ServerHosts>(&status))
  {
    choice_.reset();
    std::istringstream words(hosts->machines);
    ShareOut({std::istream_iterator<std::string>(words), {}});
  }
  else if (const auto* finished = std::get_if<ServerFinished>(&status))
  {
    // One that has failed already has no result.
    if (phase_ == Phase::kDying || phase_ == Phase::kRestarting) return;
    outcome_.finished = *finished;
    progress_.tick = finished->ticks;
    progress_.waiting_for.clear();
    progress_.phase = "finishing";
    if (phase_ == Phase::kRunning) outcome_.kind = ClusterOutcome::kFinished;
    phase_ = Phase::kFinishing;
    deadline_ = heard_ + times_.finish;
  }
}

// As a run in one process says it.
void Supervisor::TakeWarning(ClusterMember& member, const ServerWarning& warning)
{
  member.AddToLog(fmt::format("warning: {}", warning.text));
  display_.Note(fmt::format("swarmanoid: warning: {}", warning.text));
}

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
  if (member.End()->exit_code == kExitMachineGone && move.empty()) plan.host.clear();
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
  if (choice_) choice_->Disturbed();
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

std::string Supervisor::TextOf(const ClusterMember& failed) const
{
  const std::string text = FailureText({failed.Name(), failed.Plan().host, failed.End(), failed.Record()},
                                       progress_.tick, actor_of_, KernelKillsForMemory() > kills_for_memory_);
  return retries_ == 0 && failed.NewDeath() ? text +
                                                  "; for its on_failure, processes that die must be replaced: leave "
                                                  "out --no-recovery, --no-journal and --retries 0"
                                            : text;
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
    moves_[move.name] = move.machine == kLocalMachine ? "" : move.machine;
    spawner_.Signal(member->Process(), SIGKILL);
  }
}

void Supervisor::ChooseHosts()
{
  if (!choice_ || phase_ != Phase::kRunning) return;
  if (progress_.phase != "running") return choice_->Disturbed();
  const auto hosts = choice_->Take(progress_.tick, now_());
  if (choice_->IsOver())
  {
    display_.Note(choice_->Text());
    choice_.reset();
  }
  if (!hosts) return;
  std::vector<std::string> machines;
  for (const auto& member : members_)
    if (member->Plan().may_fail) machines.push_back(member->Plan().host.empty() ? kLocalMachine : member->Plan().host);
  machines.resize(*hosts, kLocalMachine);
  ShareOut(machines);
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
    if (plan.may_fail) plan.host = machines[host] == kLocalMachine ? "" : machines[host];
    host += plan.may_fail ? 1 : 0;
    plan.place(plan.host);
  }
  display_.Note(fmt::format("{} controller host{} from now on; all processes start again where the journal ends",
                            machines.size(), machines.size() == 1 ? "" : "s"));
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
    if (!member->Alive() || !member->Plan().replacement || !IsInState(pid, 'T'))
      stopped_.erase(pid);
    else if (now - stopped_.try_emplace(pid, now).first->second >= times_.stopped)
      spawner_.Signal(member->Process(), SIGKILL);
  }
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
    // Nobody is there any more, and whatever was begun may come to its end.
    if (*signal == SIGHUP && phase_ != Phase::kRunning)
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

void Supervisor::ShowProgress()
{
  const Clock::time_point now = now_();
  // A paced run may be silent for long: then the space server sleeps.
  const bool silent =
      progress_.phase == "running" && now - heard_ >= times_.stall && !IsAsleep(members_.front()->Process().pid);
  RunProgress shown = progress_;
  if (silent && shown.waiting_for.empty())
  {
    shown.waiting_for = members_.front()->Name();
    shown.waited_s = std::chrono::duration<double>(now - heard_).count();
  }
  shown.processes = static_cast<int>(
      std::count_if(members_.begin(), members_.end(), [](const auto& member) { return member->Alive(); }));
  if (now - shown_ >= times_.refresh || shown.phase != shown_phase_)
  {
    shown_ = now;
    shown_phase_ = shown.phase;
    if (phase_ != Phase::kDying) display_.Show(shown, now);
  }
}

// Whoever takes the place of another process begins with what that one has written already.
void Supervisor::WriteScreen(const ClusterMember& member, std::string_view line)
{
  Screen& screen = screens_[member.Name()];
  if (screen.incarnation != member.Incarnation()) screen = {member.Incarnation(), screen.shown, 0};
  if (++screen.lines <= screen.shown) return;
  screen.shown = screen.lines;
  if (screen_gone_) return;
  display_.Clear();
  std::string text(line);
  text += '\n';
  std::string_view rest = text;
  while (!rest.empty())
  {
    const ssize_t written = write(screen_, rest.data(), rest.size());
    if (written > 0) rest.remove_prefix(static_cast<std::size_t>(written));
    if (written >= 0 || errno == EINTR || interrupts_.ConsoleHasGone()) continue;
    screen_gone_ = true;
    if (phase_ == Phase::kRunning)
      StopAtTick("nobody reads standard output any more: stopping at the end of this tick");
    return;
  }
}

bool Supervisor::AnyAlive() const
{
  return std::any_of(members_.begin(), members_.end(),
                     [this](const auto& member)
                     {
                       const bool more_to_show = !member->OutputClosed() && phase_ != Phase::kDying;
                       return member->Alive() || more_to_show;
                     });
}

}  // namespace swarmanoid

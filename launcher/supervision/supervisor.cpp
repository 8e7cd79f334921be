#include "launcher/supervision/supervisor.h"

#include <fmt/format.h>
#include <poll.h>

#include <algorithm>
#include <cerrno>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <tuple>
#include <utility>
#include <variant>

#include "common/errors/exit_codes.h"
#include "launcher/supervision/process_state.h"

namespace swarmanoid
{
namespace
{

constexpr std::size_t kScreenBytes = 2048;  // a pipe that poll calls writable takes these without blocking
constexpr std::size_t kOutputBytes = 65536;

bool TakesMore(int descriptor)
{
  pollfd entry{descriptor, POLLOUT, 0};
  return poll(&entry, 1, 0) > 0;
}

}  // namespace

Supervisor::Supervisor(ProcessSpawner& spawner, SignalDescriptor& interrupts, ProgressDisplay& display, int screen,
                       SupervisedRun run, const SupervisorTimes& times, std::function<Clock::time_point()> now)
    : spawner_(spawner),
      interrupts_(interrupts),
      display_(display),
      screen_(screen),
      run_(std::move(run)),
      times_(times),
      now_(std::move(now)),
      kills_for_memory_(KernelKillsForMemory())
{
}

ClusterOutcome Supervisor::Run(ClusterPlan plan)
{
  plan_ = std::move(plan);
  Start();
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

void Supervisor::Start()
{
  outcome_.kind = ClusterOutcome::kInterrupted;
  progress_.phase = "starting";
  heard_ = now_();
  try
  {
    for (const PlannedProcess& process : plan_.processes)
      outcome_.processes.emplace_back(process.name, process.log_path);
    for (std::size_t i = 0; i < plan_.processes.size(); ++i) members_.push_back(StartProcess(i, {}));
  }
  catch (const std::exception& error)
  {
    outcome_.kind = ClusterOutcome::kFailed;
    outcome_.reason = error.what();
    KillAll();
  }
}

std::unique_ptr<ClusterMember> Supervisor::StartProcess(std::size_t process, Incarnation incarnation)
{
  const ProcessCommand command = run_.command_of(plan_, process, incarnation);
  auto member = std::make_unique<ClusterMember>(plan_.processes[process], command, spawner_, std::move(incarnation));
  pids_.push_back(member->Process().pid);
  return member;
}

void Supervisor::WaitForEvents()
{
  std::vector<pollfd> entries{{interrupts_.Descriptor(), POLLIN, 0}};
  for (const auto& member : members_)
  {
    if (member->Alive()) entries.push_back({member->Process().end.Get(), POLLIN, 0});
    if (member->Process().errors.IsOpen()) entries.push_back({member->Process().errors.Get(), POLLIN, 0});
    const bool held = screen_full_ && member->Planned().role == ProcessRole::kVisualiser;
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
  if (member.Planned().role == ProcessRole::kVisualiser)
  {
    screen_full_ = !screen_gone_ && !TakesMore(screen_);
    if (!screen_full_)
      member.ReadOutput([this, &member](std::string_view line) { WriteScreen(member, line); }, kScreenBytes);
    return;
  }
  // Only the lines of the space server come here.
  member.ReadOutput(
      [this, &member](std::string_view line)
      {
        if (const auto status = ParseServerStatus(line))
        {
          heard_ = now_();
          std::visit([this](const auto& word) { Take(word); }, *status);
        }
        else
          member.AddToLog(line);
      },
      kOutputBytes);
}

void Supervisor::Take(const ServerState& state)
{
  if (phase_ != Phase::kRunning) return;
  switch (state.phase)
  {
    case ServerState::kLoading:
      progress_.phase = "starting";
      break;
    case ServerState::kWaiting:
      progress_.phase = state.waiting_for.empty() ? "starting" : "waiting for " + state.waiting_for;
      break;
    case ServerState::kRunning:
      progress_.phase = "running";
      if (!began_) began_ = heard_;
      break;
    case ServerState::kPaused:
      progress_.phase = "paused";
      break;
  }
}

void Supervisor::Take(const ServerTick& tick)
{
  progress_.waiting_for.clear();
  progress_.tick = tick.tick;
  progress_.max = tick.max;
  progress_.real_time_factor = tick.real_time_factor;
}

void Supervisor::Take(const ServerStall& stall)
{
  progress_.waiting_for = stall.name;
  progress_.waited_s = stall.seconds;
}

void Supervisor::Take(const ServerFinished& finished)
{
  // A server that has failed already has no result.
  if (phase_ == Phase::kDying || phase_ == Phase::kRestarting) return;
  outcome_.finished = finished;
  progress_.tick = finished.ticks;
  progress_.waiting_for.clear();
  progress_.phase = "finishing";
  if (phase_ == Phase::kRunning) outcome_.kind = ClusterOutcome::kFinished;
  phase_ = Phase::kFinishing;
  deadline_ = heard_ + times_.finish;
}

// Shows the warning as a run in one process does.
void Supervisor::Take(const ServerWarning& warning)
{
  members_.front()->AddToLog(fmt::format("warning: {}", warning.text));
  display_.Note(fmt::format("swarmanoid: warning: {}", warning.text));
}

// A visualiser that replaces another one begins with the lines that the other one has written already.
void Supervisor::WriteScreen(const ClusterMember& member, std::string_view line)
{
  const unsigned incarnation = member.GetIncarnation().number;
  Screen& screen = screens_[member.Name()];
  if (screen.incarnation != incarnation) screen = {incarnation, screen.shown, 0};
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
    if (written >= 0 || errno == EINTR) continue;
    screen_gone_ = true;
    if (phase_ == Phase::kRunning) StopAtTick("standard output is closed: stopping at the end of this tick");
    return;
  }
}

void Supervisor::ShowProgress()
{
  const Clock::time_point now = now_();
  // A paced run may be silent for long, because the space server sleeps.
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

bool Supervisor::AnyAlive() const
{
  return std::any_of(members_.begin(), members_.end(),
                     [this](const auto& member)
                     {
                       const bool more_to_show = !member->OutputClosed() && phase_ != Phase::kDying;
                       return member->Alive() || more_to_show;
                     });
}

// These functions collect the processes that ended and find the one that failed first.

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
  // After Ctrl-C all end as interrupted processes do, and some may complain that the space server has gone. The server
  // may not yet catch the signal that asks it to stop. But it waits for each worker that died before it left.
  const bool stopped_early = is_server && phase_ == Phase::kStopping && end.signal == SIGINT;
  const bool stopping =
      phase_ == Phase::kStopping || (phase_ == Phase::kFinishing && outcome_.kind == ClusterOutcome::kInterrupted);
  const bool missed = !is_server && MayBeReplaced(end, member.Record(), !member.Planned().IsHere());
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

bool Supervisor::IsDone(const ClusterMember& member) const
{
  // The process before it may have left just when it was replaced.
  const bool replaces = member.GetIncarnation().number > 0;
  return left_.contains(member.Name()) && (replaces || WasKilled(*member.End(), !member.Planned().IsHere()));
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
    // For processes on other machines, the server often knows which one failed first.
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

std::string Supervisor::TextOf(const ClusterMember& failed) const
{
  const std::string text = FailureText({failed.Name(), failed.Planned().machine, failed.End(), failed.Record()},
                                       progress_.tick, run_.actor_of, KernelKillsForMemory() > kills_for_memory_);
  if (run_.retries > 0 || !NewDeath(failed)) return text;
  return text +
         "; for its on_failure, processes that die must be replaced: leave out --no-recovery, --no-journal and "
         "--retries 0";
}

// These functions replace one process.

bool Supervisor::Replace(const ClusterMember& member)
{
  const std::string& name = member.Name();
  const bool server_works = members_.front()->Alive() && &member != members_.front().get() && server_error_.empty();
  const bool goes_on = phase_ == Phase::kRunning || phase_ == Phase::kStopping;
  if (!goes_on || !server_works || !member.Planned().replaceable || left_.contains(name)) return false;
  const auto move = moves_.extract(name);
  const bool strayed = move.empty() && IsOnItsWay(member);
  // The server has not heard its good-bye and waits for it.
  const bool was_unheard = lost_.erase(name) > 0 && member.End()->signal == 0 && member.End()->exit_code == kExitDone;
  const bool may_be = was_unheard || MayBeReplaced(*member.End(), member.Record(), !member.Planned().IsHere());
  if (IsStuck(member.End()) || (move.empty() && !strayed && !may_be)) return false;

  Incarnation next{.number = member.GetIncarnation().number + 1, .deaths = member.GetIncarnation().deaths};
  const auto death = run_.retries > 0 ? NewDeath(member) : std::nullopt;
  if (death)
    next.deaths.push_back(*death);
  else if (move.empty() && !CountDeath(member))
    return false;

  const auto slot =
      std::find_if(members_.begin(), members_.end(), [&](const auto& candidate) { return candidate.get() == &member; });
  const auto process = static_cast<std::size_t>(slot - members_.begin());
  PlannedProcess& planned = plan_.processes[process];
  if (move.empty())
    display_.Note(fmt::format("{}; another process takes its place", TextOf(member)));
  else
  {
    came_from_[name] = {planned.machine, progress_.tick};
    planned.machine = move.mapped();
    display_.Note(
        fmt::format("{} moves to {}", name, planned.IsHere() ? "another process of this machine" : planned.machine));
  }
  if (strayed) planned.machine = came_from_.extract(name).mapped().first;
  kills_for_memory_ = KernelKillsForMemory();
  try
  {
    *slot = StartProcess(process, std::move(next));
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
  return deaths_[member.Name()].Add(progress_.tick, member.Record(), run_.retries);
}

std::optional<ControllerDeath> Supervisor::NewDeath(const ClusterMember& member) const
{
  const ActivityRecord record = member.Record();
  if (member.Planned().role != ProcessRole::kControllerHost || record.end != EndReason::kDied ||
      record.kind != Actor::kRobot || record.step != ActivityStep::kControlStep || !run_.may_fail ||
      !run_.may_fail(record.number))
    return std::nullopt;
  const ControllerDeath death{record.tick, record.number};
  const std::vector<ControllerDeath>& before = member.GetIncarnation().deaths;
  if (std::find(before.begin(), before.end(), death) != before.end()) return std::nullopt;
  return death;
}

bool Supervisor::IsOnItsWay(const ClusterMember& member) const
{
  const auto from = came_from_.find(member.Name());
  return from != came_from_.end() && from->second.second == progress_.tick;
}

// Kills a worker, so that Replace starts another process on the machine that a user wants.
void Supervisor::Take(const ServerMove& move)
{
  for (const auto& member : members_)
  {
    if (member->Name() != move.name || !member->Alive() || member->Planned().role == ProcessRole::kSpaceServer)
      continue;
    moves_[move.name] = move.machine;
    spawner_.Signal(member->Process(), SIGKILL);
  }
}

// A lost worker may be stopped or cut off. It must not come back.
void Supervisor::Take(const ServerLost& lost)
{
  for (const auto& member : members_)
  {
    if (member->Name() != lost.text) continue;
    lost_.insert(lost.text);
    if (member->Alive()) return spawner_.Signal(member->Process(), SIGKILL);
    std::erase(ended_, member.get());
    if (!Replace(*member)) TakeEnd(*member);
    return;
  }
}

// No lease runs for a process that was stopped before others met it.
void Supervisor::KillStopped()
{
  if (times_.stopped.count() == 0 || phase_ != Phase::kRunning) return;
  const Clock::time_point now = now_();
  for (const auto& member : members_)
  {
    const pid_t pid = member->Process().pid;
    if (!member->Alive() || !member->Planned().replaceable || !IsStoppedBySignal(pid))
      stopped_.erase(pid);
    else if (now - stopped_.try_emplace(pid, now).first->second >= times_.stopped)
      spawner_.Signal(member->Process(), SIGKILL);
  }
}

// These functions replace all processes.

bool Supervisor::Restart(const ClusterMember& first, Evidence evidence)
{
  const bool all_can =
      std::all_of(members_.begin(), members_.end(), [](const auto& member) { return member->Planned().replaceable; });
  // A server that has reported its result must still give the verdict of the experiment by its exit code.
  const bool goes_on =
      phase_ == Phase::kRunning || (outcome_.kind == ClusterOutcome::kFinished && &first == members_.front().get());
  if (!goes_on || !all_can) return false;
  const bool died =
      first.End() && (IsStuck(first.End()) || MayBeReplaced(*first.End(), first.Record(), !first.Planned().IsHere()));
  if (!died && evidence != Evidence::kConsequence) return false;
  if (!CountDeath(first)) return false;
  display_.Note(fmt::format("{}; all processes start again where the journal ends", TextOf(first)));
  KillToStartAgain();
  return true;
}

// Ends all processes, to start them again with one controller host on each of the machines.
void Supervisor::Take(const ServerHosts& hosts)
{
  std::istringstream words(hosts.text);
  const std::vector<std::string> machines{std::istream_iterator<std::string>(words), {}};
  if (phase_ != Phase::kRunning || !members_.front()->Planned().replaceable) return;
  const auto before = std::ranges::count(plan_.processes, ProcessRole::kControllerHost, &PlannedProcess::role);
  SetControllerHosts(plan_, machines);
  for (const PlannedProcess& process : plan_.processes)
    if (const std::pair entry(process.name, process.log_path);
        std::ranges::find(outcome_.processes, entry) == outcome_.processes.end())
      outcome_.processes.push_back(entry);
  display_.Note(fmt::format("{}{} controller host{} from now on; all processes start again where the journal ends",
                            std::cmp_equal(machines.size(), before) ? "the robots are assigned again to " : "",
                            machines.size(), machines.size() == 1 ? "" : "s"));
  KillToStartAgain();
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
  // Stuck processes do not react to SIGTERM.
  SignalAll(SIGKILL);
}

// Returns whether the processes, which have all ended, must start again.
bool Supervisor::MustStartAgain()
{
  if (attribute_at_ && phase_ != Phase::kDying) Attribute();
  return phase_ == Phase::kRestarting;
}

void Supervisor::StartAgain()
{
  left_.clear();
  lost_.clear();
  server_error_.clear();
  attribute_at_.reset();
  phase_ = Phase::kRunning;
  try
  {
    // Robots, and so their deaths, may have another host than before.
    std::vector<ControllerDeath> deaths;
    unsigned number = 0;
    for (const auto& member : members_)
    {
      const Incarnation& incarnation = member->GetIncarnation();
      deaths.insert(deaths.end(), incarnation.deaths.begin(), incarnation.deaths.end());
      if (const auto death = NewDeath(*member)) deaths.push_back(*death);
      number = std::max(number, incarnation.number + 1);
    }
    const double taken_s = began_ ? std::chrono::duration<double>(now_() - *began_).count() : 0;
    members_.clear();
    for (std::size_t i = 0; i < plan_.processes.size(); ++i)
    {
      const bool is_host = plan_.processes[i].role == ProcessRole::kControllerHost;
      members_.push_back(StartProcess(i, {number, taken_s, is_host ? deaths : std::vector<ControllerDeath>()}));
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

// These functions end the run.

void Supervisor::TakeInterrupts()
{
  while (const auto signal = interrupts_.Take())
  {
    // A lost terminal sends several signals, and an end that has begun may complete.
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

  // The last tick is done. Processes that are still there must end in time.
  for (const auto& member : members_)
  {
    if (!member->Alive()) continue;
    progress_.waiting_for = member->Name();
    progress_.waited_s = std::chrono::duration<double>(now - heard_).count();
    const auto patience = member->Planned().role == ProcessRole::kVisualiser ? times_.finish_visualiser : times_.finish;
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
  // The text of a mistake in the experiment file has its position, so users need no log.
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

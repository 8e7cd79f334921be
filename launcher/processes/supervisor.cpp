#include "launcher/processes/supervisor.h"

#include <fmt/format.h>
#include <poll.h>

#include <algorithm>
#include <cerrno>
#include <fstream>

namespace swarmanoid
{
namespace
{

constexpr std::size_t kScreenBytes = 2048;  // a pipe that poll calls writable takes these without blocking
constexpr std::size_t kOutputBytes = 65536;

// True where the process waits for something by its own will, and does not work, nor was it stopped.
bool IsAsleep(pid_t pid)
{
  std::ifstream stat(fmt::format("/proc/{}/stat", pid));
  std::string line;
  std::getline(stat, line);
  return line.find(") S ") != std::string::npos;
}

bool TakesMore(int descriptor)
{
  pollfd entry{descriptor, POLLOUT, 0};
  return poll(&entry, 1, 0) > 0;
}

}  // namespace

Supervisor::Supervisor(ProcessSpawner& spawner, Interrupts& interrupts, ProgressDisplay& display, int screen,
                       const SupervisorTimes& times)
    : spawner_(spawner), interrupts_(interrupts), display_(display), screen_(screen), times_(times)
{
}

ClusterOutcome Supervisor::Run(const std::vector<MemberPlan>& plans)
{
  Start(plans);
  while (AnyAlive())
  {
    WaitForEvents();
    for (const auto& member : members_) ReadMember(*member);
    CollectEnds();
    TakeInterrupts();
    CheckDeadlines();
    ShowProgress();
  }
  if (judge_at_ && phase_ != Phase::kDying) JudgeSuspects();
  display_.Clear();
  return outcome_;
}

void Supervisor::Start(const std::vector<MemberPlan>& plans)
{
  outcome_.kind = ClusterOutcome::kInterrupted;
  progress_.phase = "starting";
  heard_ = Clock::now();
  try
  {
    for (const MemberPlan& plan : plans)
    {
      members_.push_back(std::make_unique<ClusterMember>(plan, spawner_));
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
  if (judge_at_) timeout = std::min(timeout, times_.settle / 4);
  if (deadline_)
    timeout = std::clamp(
        std::chrono::duration_cast<std::chrono::milliseconds>(*deadline_ - Clock::now()) + std::chrono::milliseconds(1),
        std::chrono::milliseconds(1), times_.refresh);
  poll(entries.data(), entries.size(), static_cast<int>(timeout.count()));
}

void Supervisor::ReadMember(ClusterMember& member)
{
  member.ReadErrors();
  if (member.OutputClosed()) return;
  switch (member.Plan().output)
  {
    case MemberPlan::kLog:
      member.ReadOutput({}, kOutputBytes);
      break;
    case MemberPlan::kScreen:
      screen_full_ = !screen_gone_ && !TakesMore(screen_);
      if (!screen_full_) member.ReadOutput([this](std::string_view line) { WriteScreen(line); }, kScreenBytes);
      break;
    case MemberPlan::kStatus:
      member.ReadOutput(
          [this, &member](std::string_view line)
          {
            if (const auto status = ParseServerStatus(line))
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
  heard_ = Clock::now();
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
        break;
      case ServerState::kPaused:
        progress_.phase = "paused";
        break;
    }
  }
  else if (const auto* tick = std::get_if<ServerTick>(&status))
  {
    progress_.waiting_for.clear();
    progress_.tick = tick->tick;
    progress_.max = tick->max;
    progress_.real_time_factor = tick->real_time_factor;
  }
  else if (const auto* stall = std::get_if<ServerStall>(&status))
  {
    progress_.waiting_for = stall->name;
    progress_.waited_s = stall->seconds;
  }
  else if (const auto* error = std::get_if<ServerError>(&status))
  {
    server_error_ = error->text;
  }
  else if (const auto* finished = std::get_if<ServerFinished>(&status))
  {
    outcome_.finished = *finished;
    progress_.tick = finished->ticks;
    progress_.waiting_for.clear();
    progress_.phase = "finishing";
    if (phase_ == Phase::kRunning) outcome_.kind = ClusterOutcome::kFinished;
    if (phase_ == Phase::kDying) return;
    phase_ = Phase::kFinishing;
    deadline_ = heard_ + times_.finish;
  }
}

void Supervisor::CollectEnds()
{
  std::vector<const ClusterMember*> ended;
  for (const auto& member : members_)
  {
    pollfd entry{member->Process().end.Get(), POLLIN, 0};
    if (!member->Alive() || poll(&entry, 1, 0) <= 0) continue;
    member->Collect(spawner_);
    ReadMember(*member);
    ended.push_back(member.get());
  }
  // Several may end within one look: the one that a signal killed is rather the cause than those that ended by
  // themselves.
  std::stable_sort(ended.begin(), ended.end(),
                   [](const auto* a, const auto* b) { return a->End()->signal != 0 && b->End()->signal == 0; });
  for (const ClusterMember* member : ended) JudgeEnd(*member);
}

void Supervisor::JudgeEnd(const ClusterMember& member)
{
  if (phase_ == Phase::kDying) return;
  const ProcessEnd& end = *member.End();
  const bool is_server = &member == members_.front().get();
  // It may not have got as far as catching the signal that asks it to stop.
  const bool stopped_early = is_server && phase_ == Phase::kStopping && end.signal == SIGINT;
  if (end.signal != 0 && !stopped_early) return Fail(member, end.Text());

  if (is_server && outcome_.kind == ClusterOutcome::kFinished && end.exit_code == kUnsuccessfulExperiment)
  {
    outcome_.kind = ClusterOutcome::kUnsuccessful;
    return;
  }

  // After Ctrl-C all end as interrupted ones do, and some may complain that the space server has gone.
  if (phase_ == Phase::kStopping || (phase_ == Phase::kFinishing && outcome_.kind == ClusterOutcome::kInterrupted))
  {
    if (is_server && !outcome_.finished) Die(Clock::now() + times_.terminate);
    return;
  }
  if (!end.Clean() || (is_server && !outcome_.finished)) return Suspect(member, times_.settle);
  if (outcome_.finished) return;
  // The run's last word comes after the last picture.
  const bool draws = std::any_of(members_.begin(), members_.end(),
                                 [](const auto& other) { return other->Plan().visualiser && other->Alive(); });
  Suspect(member, draws ? times_.last_picture : times_.early_end);
}

void Supervisor::Suspect(const ClusterMember& member, std::chrono::milliseconds patience)
{
  suspects_.push_back(&member);
  const Clock::time_point judge_at = Clock::now() + patience;
  if (!judge_at_ || judge_at < *judge_at_) judge_at_ = judge_at;
}

// One failure makes the others end too. The space server often knows who began.
void Supervisor::JudgeSuspects()
{
  judge_at_.reset();
  const auto unclean = [](const ClusterMember* member) { return !member->End()->Clean(); };
  const auto accused = [this](const ClusterMember* member) { return server_error_.starts_with(member->Name()); };
  auto culprit = std::find_if(suspects_.begin(), suspects_.end(), accused);
  if (culprit == suspects_.end()) culprit = std::find_if(suspects_.begin(), suspects_.end(), unclean);
  if (culprit == suspects_.end())
  {
    if (outcome_.finished) return;
    culprit = suspects_.begin();
  }
  Fail(**culprit, unclean(*culprit) ? (*culprit)->End()->Text() : "ended before the last tick");
}

void Supervisor::TakeInterrupts()
{
  while (const auto signal = interrupts_.Take())
  {
    if (phase_ == Phase::kRunning && outcome_.kind == ClusterOutcome::kInterrupted)
    {
      StopAtTick(*signal == SIGINT ? "stopping at the end of this tick; Ctrl-C again kills at once"
                                   : "asked to end: stopping");
      if (*signal != SIGINT) deadline_ = Clock::now() + times_.forced_stop;
      continue;
    }
    if (phase_ != Phase::kDying)
    {
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
  const Clock::time_point now = Clock::now();
  if (judge_at_ && now >= *judge_at_ && phase_ != Phase::kDying) return JudgeSuspects();
  if (!deadline_ || now < *deadline_) return;

  if (phase_ == Phase::kDying)
  {
    KillAll();
    deadline_ = now + times_.refresh;
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
      return Fail(*member, fmt::format("did not end within {} of the last tick",
                                       DurationText(std::chrono::duration<double>(patience).count())));
  }
  deadline_ = now + times_.refresh;
}

void Supervisor::Fail(const ClusterMember& member, const std::string& what)
{
  outcome_.kind = member.End() && member.End()->exit_code == kInvalidExperiment ? ClusterOutcome::kInvalid
                                                                                : ClusterOutcome::kFailed;
  outcome_.finished.reset();
  outcome_.reason = fmt::format("{} {} at tick {}", member.Name(), what, progress_.tick);
  if (!server_error_.empty()) outcome_.reason += fmt::format(" ({})", server_error_);
  outcome_.reason += fmt::format("; its log is {}", member.Log().Path());
  if (!member.Log().Trouble().empty()) outcome_.reason += fmt::format(" (incomplete: {})", member.Log().Trouble());
  outcome_.log_lines.assign(member.Log().LastLines().begin(), member.Log().LastLines().end());
  Die(Clock::now() + times_.terminate);
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
}

void Supervisor::SignalAll(int signal)
{
  for (const auto& member : members_)
    if (member->Alive()) spawner_.Signal(member->Process(), signal);
}

void Supervisor::ShowProgress()
{
  const Clock::time_point now = Clock::now();
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

void Supervisor::WriteScreen(std::string_view line)
{
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

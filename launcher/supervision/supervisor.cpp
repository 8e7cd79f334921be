#include "launcher/supervision/supervisor.h"

#include <fmt/format.h>
#include <poll.h>

#include <algorithm>
#include <cerrno>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <utility>

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

ClusterOutcome Supervisor::Run(const std::vector<MemberPlan>& plans)
{
  Start(plans);
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

void Supervisor::Start(const std::vector<MemberPlan>& plans)
{
  outcome_.kind = ClusterOutcome::kInterrupted;
  progress_.phase = "starting";
  heard_ = now_();
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

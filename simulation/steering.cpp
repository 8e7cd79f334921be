#include "simulation/steering.h"

#include <unistd.h>

#include <algorithm>
#include <thread>
#include "common/space/space.h"

namespace swarmanoid
{
namespace
{

constexpr auto kIdlePeriod = std::chrono::milliseconds(10);
constexpr std::size_t kNotesKept = 100;

std::string OwnProcess()
{
  char host[256] = "";
  gethostname(host, sizeof host - 1);
  return std::string(host) + ":" + std::to_string(getpid());
}

std::string NameOf(const std::string& visualiser) { return "visualiser '" + visualiser + "'"; }

}  // namespace

Steering::Steering(const Experiment& experiment, SpaceServer& server, RunControlSetup setup,
                   const std::atomic<bool>* stop)
    : server_(server),
      stop_(stop),
      run_control_(experiment, std::move(setup),
                   [this](const ControlRequestMessage& request, bool done, std::uint64_t tick, const std::string& text)
                   { Answer(request, done, tick, text); }),
      control_([this](const ControlOrder& order) { run_control_.Ask({order}); }),
      pace_(experiment.TickSeconds())
{
  server_.SetFaultHandler([this](const std::vector<RecordedFault>& faults) { run_control_.Failed(faults); });
  status_.processes.push_back({"single process", OwnProcess(), 0, 0, {}});
}

void Steering::Answer(const ControlRequestMessage& request, bool done, std::uint64_t tick, const std::string& text)
{
  notes_.push_back({tick, done, text, request.client, request.number});
  if (notes_.size() > kNotesKept) notes_.erase(notes_.begin());
  if (link_ != nullptr) link_->Reply(request, done, tick, text);
}

void Steering::Open(RunLink& link, const Assignment& assignment)
{
  link.Open({server_, assignment, *host_, [this](const ControlRequestMessage& request) { run_control_.Ask(request); },
             [this](const ControlRequestMessage& note) { run_control_.Note(note); }});
  if (link.IsOpen()) link_ = &link;
}

void Steering::CloseLink()
{
  if (link_ != nullptr) link_->Close(*this, Reset().has_value());
}

void Steering::WaitForGo(const std::vector<std::unique_ptr<Visualiser>>& visualisers)
{
  const std::uint64_t tick = server_.Space().GetTick();
  if (!started_) run_control_.Start(tick, Clock::now());
  if (Interrupted()) run_control_.Stop("interrupt");
  if (link_ != nullptr) link_->Publish(*this);
  if (started_ && tick != until_ && !run_control_.WantsHold()) return;
  started_ = true;
  while (true)
  {
    run_control_.Work(server_);
    const Clock::time_point now = Clock::now();
    const RunControl::Decision decision = run_control_.Decide(tick, now);
    until_ = decision.until;
    if (decision.go) return;
    if (run_control_.Paused()) pace_.Rest(tick, now);
    if (link_ != nullptr) link_->Publish(*this);
    // Windows are not updated in a short wait, since drawing may take longer than the wait.
    const bool idle = !decision.due || *decision.due - now >= kIdlePeriod;
    if (idle && !visualisers.empty()) server_.Draw();
    if (idle)
      for (const auto& visualiser : visualisers)
        if (visualiser->Idle()) run_control_.Stop(NameOf(visualiser->Id()));
    std::this_thread::sleep_until(std::min(decision.due.value_or(now + kIdlePeriod), now + kIdlePeriod));
    if (Interrupted()) run_control_.Stop("interrupt");
  }
}

void Steering::Stopped(const std::string& visualiser)
{
  run_control_.Stopped(server_.Space().GetTick(), NameOf(visualiser));
  status_.ended = NameOf(visualiser) + " asked for the end";
}

void Steering::Ended()
{
  ended_ = true;
  run_control_.Ended(server_.Space().GetTick());
}

const RunStatus& Steering::Status()
{
  const std::uint64_t tick = server_.Space().GetTick();
  const bool paused = run_control_.Paused();
  if (!paused && !ended_) pace_.Observe(tick, Clock::now());
  status_.phase = ended_   ? RunStatus::Phase::kFinished
                  : paused ? RunStatus::Phase::kPaused
                           : RunStatus::Phase::kRunning;
  status_.tick = tick;
  status_.speed_wanted = run_control_.Speed();
  status_.real_time_factor = paused ? 0 : pace_.RealTimeFactor();
  status_.ticks_per_second = paused ? 0 : pace_.TicksPerSecond();
  if (status_.ended.empty()) status_.ended = run_control_.WhyStopped();
  status_.processes.resize(1);
  status_.processes[0].tick = tick;
  if (link_ != nullptr)
    for (const ProcessStatus& attached : link_->Attached()) status_.processes.push_back(attached);
  return status_;
}

const RobotStatus* Steering::Robot(std::uint32_t robot)
{
  if (host_ == nullptr || std::find(watched_.begin(), watched_.end(), robot) == watched_.end()) return nullptr;
  RobotStatus& status = robots_[robot];
  return host_->Describe(robot, status) ? &status : nullptr;
}

}  // namespace swarmanoid

// The reports of a run to the launcher, to users who ask, and to observers.
#include "space_server/cluster/server_program.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/activity/print_error.h"
#include "common/messages/control_verbs.h"
#include "space_server/cluster/process_liveness.h"

namespace swarmanoid
{
namespace
{

using namespace std::chrono_literals;

constexpr auto kStallTime = 2s;

}  // namespace

void ServerProgram::Reply(const ControlRequestMessage& request, bool done, std::uint64_t tick, const std::string& text)
{
  session_.Reply(request, done, tick, text);
  if (request.verb == kFailedController)
  {
    status_.Publish(ServerWarning{text});
    Say(text);
  }
  const ControlVerb* const verb = FindControlVerb(request.verb);
  if (!done || verb == nullptr || !verb->announced) return;
  const std::string line = fmt::format("{}: {}", AskerOf(request), text);
  status_.Publish(ServerAsked{line});
  Say(line);
}

void ServerProgram::Say(const std::string& text) const
{
  if (!status_.IsOpen()) PrintError("space server: {}\n", text);
}

void ServerProgram::ReportState()
{
  const ServerState::Phase phase = run_control_.Paused() ? ServerState::kPaused : ServerState::kRunning;
  if (phase == said_phase_) return;
  said_phase_ = phase;
  status_.Publish(ServerState{phase, {}});
  Say(run_control_.Paused() ? fmt::format("paused at tick {}", lockstep_.Tick()) : "running");
}

void ServerProgram::ReportProgress()
{
  const auto now = Clock::now();
  const std::uint64_t tick = lockstep_.Tick();
  const bool held = lockstep_.Held();
  if (tick != last_tick_ || held)
  {
    last_tick_ = tick;
    since_ = now;
    repeat_after_ = kFirstRepeat;
    repeated_ = now;
    stall_said_ = 0s;
  }
  else if (now - repeated_ >= repeat_after_)
  {
    lockstep_.Repeat();
    repeated_ = now;
    repeat_after_ = std::min<Clock::duration>(2 * repeat_after_, kLastRepeat);
  }
  if (StallIsDue()) ReportStall(LateNames(tick));
  ReportState();
  const bool rests = run_control_.Paused() && held;
  if (rests) pace_.Rest(tick, now);
  if (rests || pace_.Observe(tick, now)) TellTick();
}

void ServerProgram::TellTick()
{
  const std::uint64_t tick = lockstep_.Tick();
  if (std::exchange(told_tick_, tick) != tick)
    status_.Publish(ServerTick{tick, experiment_.max_clock, pace_.RealTimeFactor()});
}

bool ServerProgram::StallIsDue() const
{
  return Clock::now() - since_ >= std::max<Clock::duration>(kStallTime, stall_said_ + 1s);
}

void ServerProgram::ReportStall(const std::string& who)
{
  stall_said_ = Clock::now() - since_;
  // A replacement waits for the world, and Fast DDS 2.9 may lose it while they meet.
  SayWorldAgain();
  status_.Publish(ServerStall{who, std::round(Seconds(stall_said_))});
  Say(fmt::format("tick {}: waiting for {} since {:.0f} s", lockstep_.Tick(), who, Seconds(stall_said_)));
}

std::string ServerProgram::LateNames(std::uint64_t tick) const
{
  std::vector<std::string> names;
  for (const LateProcess& late : LateProcesses(session_, lockstep_.Missing(), tick))
    names.push_back(late.doing.empty() ? late.name : fmt::format("{} ({})", late.name, late.doing));
  return Joined(names);
}

RunStatus::Phase ServerProgram::Phase() const
{
  if (lockstep_.Finished()) return RunStatus::Phase::kFinished;
  if (!started_) return RunStatus::Phase::kWaiting;
  return run_control_.Paused() ? RunStatus::Phase::kPaused : RunStatus::Phase::kRunning;
}

void ServerProgram::PublishViews()
{
  grants_.Work(lockstep_.Tick());
  const auto now = Clock::now();
  const bool over = lockstep_.Finished();
  if (std::exchange(told_end_, over) || (over && BeginsAgain())) return;
  if (started_ && (over || views_.ViewIsDue(lockstep_.Tick(), now)))
  {
    lockstep_.WithServer(
        [this](SpaceServer& server)
        {
          server.Draw();
          server.WriteSnapshot(snapshot_);
          snapshot_.drawing = server.Space().GetDrawing();
        });
    snapshot_.last = over;
    snapshot_.real_time_factor = pace_.RealTimeFactor();
    views_.SendView(snapshot_, now);
  }
  const RunStatus::Phase phase = Phase();
  if (over || views_.StatusIsDue(phase, now)) views_.SendStatus(Status(phase, now), now);
}

RunStatus ServerProgram::Status(RunStatus::Phase phase, Clock::time_point now)
{
  RunStatus status;
  status.phase = phase;
  status.tick = lockstep_.Tick();
  status.speed_wanted = run_control_.Speed();
  if (phase == RunStatus::Phase::kRunning || phase == RunStatus::Phase::kFinished)
  {
    status.real_time_factor = pace_.RealTimeFactor();
    status.ticks_per_second = pace_.TicksPerSecond();
  }
  status.ended = run_control_.WhyStopped();
  if (const auto who = lockstep_.Terminator()) status.ended = *who + " asked for the end";
  const bool waits = started_ && !lockstep_.Held() && !lockstep_.Finished();
  status.processes = ProcessesNow(session_, status.tick, waits ? lockstep_.Missing() : std::vector<std::string>(),
                                  waits ? Seconds(now - since_) : 0);
  return status;
}

}  // namespace swarmanoid

#include "space_server/cluster/server_program.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "common/activity/exit_codes.h"
#include "common/activity/print_error.h"
#include "common/program/standard_output.h"
#include "common/run/run_summary.h"
#include "common/space/space.h"

namespace swarmanoid
{
namespace
{

using namespace std::chrono_literals;

constexpr auto kPeriod = 50ms;         // of the main thread, when nothing happens
constexpr double kLastViewTime_s = 1;  // observers may be stopped
constexpr auto kWorldAgain = 3s;       // between announcements to processes that have not joined
constexpr auto kBrokenTime = 5s;       // for the lease of a dead process to end
constexpr auto kStuckTime = 1s;        // for another process to take its place

}  // namespace

int ServerProgram::Run()
{
  try
  {
    session_.Open();
    if (KeepsJournal()) session_.AnnounceFolder(std::filesystem::absolute(options_.output_folder).lexically_normal());
    Collect();
    RunTicks();
    Close();
  }
  catch (const std::exception& error)
  {
    const bool complete = dynamic_cast<const ActivityError*>(&error) != nullptr;
    const bool interrupted = IsInterrupted() && reason_ == EndReason::kFailed;
    NoteEnd(interrupted ? EndReason::kInterrupted : reason_, lockstep_.Tick(),
            complete ? error.what() : fmt::format("space server failed at tick {}: {}", lockstep_.Tick(), error.what()),
            complete);
    if (journal_) journal_->Flush();
    // Observers wait for the server that replaces a stuck one, so they get no end of the run.
    if (!stuck_ || !options_.awaits_replacements)
    {
      grants_.Leave(lockstep_.Tick(), error.what(), kLastViewTime_s);
      session_.Leave(lockstep_.Tick(), error.what());
    }
    // Within another program, that one says it.
    if (options_.abandon == nullptr) PrintError("space_server: {}\n", error.what());
    status_.Publish(ServerError{error.what()});
    session_.LeaveDirectory();
    failed_ = true;
    if (interrupted) return kExitInterrupted;
    if (stuck_) return kExitStuck;
    return reason_ == EndReason::kOthers ? kExitOthersFailed : kExitProcessFailed;
  }
  if (IsInterrupted())
  {
    NoteEnd(EndReason::kInterrupted, lockstep_.Tick(),
            fmt::format("space server was asked by a signal to end the run at tick {}", lockstep_.Tick()));
    return kExitInterrupted;
  }
  NoteEnd(EndReason::kDone, lockstep_.Tick(), "");
  return server_.HasFailed() ? kExitExperimentFailed : kExitDone;
}

void ServerProgram::Wake()
{
  const std::lock_guard lock(wake_mutex_);
  awake_ = true;
  wake_.notify_all();
}

void ServerProgram::Sleep(Clock::time_point until)
{
  std::unique_lock lock(wake_mutex_);
  wake_.wait_until(lock, until, [this] { return awake_; });
  awake_ = false;
}

void ServerProgram::CheckFailures()
{
  if (options_.abandon != nullptr && *options_.abandon) throw BusError("the run was given up");
  // The launcher is told which processes have left, so that it expects their end.
  for (const std::string& name : session_.TakeLeft()) status_.Publish(ServerLeft{name});
  session_.AnswerLeaves();
  HelpReplacements();
  // The order matters: a process that leaves in good order has the last state. Any other one has failed.
  const std::optional<std::string> left = session_.FirstLeft();
  if (const auto failure = lockstep_.Failure()) throw BusError(*failure);
  if (const auto failure = session_.Failure())
  {
    reason_ = EndReason::kOthers;
    throw BusError(*failure);
  }
  if (left && !lockstep_.Finished())
  {
    reason_ = EndReason::kOthers;
    throw BusError(fmt::format("{} has left before the last tick", *left));
  }
  if (!BusIsBroken()) return;
  // Another process may have taken the place of the dead one: then the run goes on.
  if (!broken_since_ || lockstep_.Tick() != broken_tick_) broken_since_ = Clock::now();
  broken_tick_ = lockstep_.Tick();
  if (Clock::now() - *broken_since_ <= (options_.awaits_replacements ? kStuckTime : kBrokenTime)) return;
  reason_ = EndReason::kOthers;
  stuck_ = true;
  throw BusError("a process died, or was stopped, while it held shared memory of the run");
}

void ServerProgram::HelpReplacements()
{
  for (const std::string& name : session_.TakeLost()) status_.Publish(ServerLost{name});
  if (const auto trouble = journal_ ? journal_->TakeTrouble() : std::nullopt)
  {
    if (options_.journal_need != "optional")
      throw BusError(*trouble + "; free some room, or let the run go on without it: --journal optional");
    status_.Publish(ServerWarning{*trouble});
    Say(*trouble);
  }
  if (const auto excess = journal_ ? journal_->TakeExcess() : std::nullopt)
  {
    status_.Publish(ServerWarning{*excess});
    Say(*excess);
  }
  try
  {
    recoveries_.Work();
  }
  catch (const BusError&)
  {
    reason_ = EndReason::kOthers;
    throw;
  }
  const auto replaced = session_.TakeReplaced();
  for (const auto& [name, incarnation] : replaced)
  {
    lockstep_.Return(name, incarnation);
    run_control_.Arrived({name, session_.MachineOf(name)}, session_.ProcessOf(name), lockstep_.Tick());
  }
  if (replaced.empty() || !started_) return;
  lockstep_.Repeat();
  repeated_ = Clock::now();
  repeat_after_ = kFirstRepeat;
}

void ServerProgram::SayWorldAgain()
{
  if (Clock::now() < world_said_ + kWorldAgain) return;
  session_.SayWorldAgain();
  world_said_ = Clock::now();
}

void ServerProgram::Collect()
{
  const auto start = Clock::now();
  world_said_ = start;
  std::string said;
  while (true)
  {
    CheckFailures();
    if (IsInterrupted()) throw BusError("interrupted before the first tick");
    PublishViews();
    const std::vector<std::string> missing = session_.Missing();
    if (missing.empty() && lockstep_.AllMatched()) return;
    SayWorldAgain();
    const std::string text = Joined(missing);
    if (text != said && !text.empty() && (Clock::now() - start > 300ms || !said.empty()))
    {
      Say(fmt::format("waiting for {} (experiment '{}', domain {}) …", text, experiment_.name, options_.bus.domain));
      status_.Publish(ServerState{ServerState::kWaiting, text});
      said = text;
    }
    // Endpoints match without a message, so poll often once all processes have joined.
    Sleep(Clock::now() + (missing.empty() ? 1ms : 10ms));
  }
}

void ServerProgram::RunTicks()
{
  start_ = since_ = repeated_ = Clock::now();
  if (GoesOn())
    start_ -= std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(options_.goes_on_after_s));
  repeat_after_ = kFirstRepeat;
  started_ = true;
  const std::uint64_t tick = lockstep_.Tick();
  first_tick_ = restart_point_ && restart_point_->Journal() ? restart_point_->Journal()->Start().first_tick : tick;
  run_control_.Start(tick, since_);
  ReportState();
  while (!lockstep_.Finished())
  {
    CheckFailures();
    Clock::time_point next = Clock::now() + kPeriod;
    if (IsInterrupted()) run_control_.Stop("interrupt");
    if (run_control_.WantsHold()) lockstep_.Hold();
    if (lockstep_.Held())
    {
      lockstep_.WithServer([this](SpaceServer& server) { run_control_.Work(server); });
      const RunControl::Decision decision = run_control_.Decide(lockstep_.Tick(), Clock::now());
      if (decision.go)
        lockstep_.Go(decision.until);
      else if (decision.due)
        next = std::min(next, *decision.due);
    }
    checkpoints_.Work();
    ReportProgress();
    PublishViews();
    if (!lockstep_.Finished() && !lockstep_.Failure()) Sleep(std::min(next, views_.Next()));
  }
  end_ = Clock::now();
  const auto who = lockstep_.Terminator();
  if (!who) return;
  run_control_.Stopped(lockstep_.Tick(), *who);
  status_.Publish(ServerAsked{fmt::format("{}: stopped at tick {}", *who, lockstep_.Tick())});
}

void ServerProgram::Close()
{
  RunSummary result;
  lockstep_.WithServer(
      [&](SpaceServer& server)
      {
        result.ticks = server.Space().GetTick();
        result.entities = server.Space().Size();
        result.hash = server.Space().Hash();
      });
  lockstep_.CloseHashLog();
  run_control_.Ended(result.ticks);
  result.wall_s = Seconds(end_ - start_);
  result.real_time_factor = RealTimeFactor(result.ticks - first_tick_, experiment_.TickSeconds(), result.wall_s);
  status_.Publish(ServerTick{result.ticks, experiment_.max_clock, result.real_time_factor});
  PublishViews();
  auto said = Clock::now();
  repeat_after_ = kFirstRepeat;
  since_ = said;
  stall_said_ = 0s;
  for (std::vector<std::string> there = session_.NotLeft(); !there.empty(); there = session_.NotLeft())
  {
    CheckFailures();
    Sleep(Clock::now() + 10ms);
    if (StallIsDue()) ReportStall(Joined(there));
    if (Clock::now() - said < repeat_after_) continue;
    said = Clock::now();
    repeat_after_ = std::min<Clock::duration>(2 * repeat_after_, kLastRepeat);
    lockstep_.Repeat();
  }
  CheckFailures();
  FinishCheckpoints();
  lockstep_.WithServer([](SpaceServer& server) { server.Destroy(); });
  // After the last state was read, no process waits for another one.
  views_.WaitUntilRead(kLastViewTime_s);
  grants_.Leave(result.ticks, "", kLastViewTime_s);
  if (BeginsAgain())
    session_.LeaveToNext();
  else
    session_.Leave(result.ticks, "");
  if (const auto& reset = run_control_.Reset())
    status_.Publish(ServerReset{reset->seed, reset->paused, reset->real_time_factor});
  status_.Publish(ServerFinished{result.ticks, result.entities, result.hash, result.wall_s, result.real_time_factor});
  if (status_.IsOpen()) return;
  std::fputs((FinishedLine(result) + "\n").c_str(), stdout);
  if (!OutputIsWritten()) throw std::runtime_error("the result of the run is lost");
}

void ServerProgram::FinishCheckpoints()
{
  const auto patience = Clock::now() + kBrokenTime;
  for (checkpoints_.Work(); !checkpoints_.Incomplete().empty(); checkpoints_.Work())
  {
    if (Clock::now() > patience)
      throw BusError(fmt::format("the checkpoint of tick {} is incomplete: parts of it were lost",
                                 checkpoints_.Incomplete().front()));
    Sleep(Clock::now() + 10ms);
  }
}

}  // namespace swarmanoid

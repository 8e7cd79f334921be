#include "common/bus/membership/worker_session.h"

#include <fmt/format.h>
#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <new>
#include <utility>

#include "common/activity/exit_codes.h"
#include "common/activity/memory_limit.h"
#include "common/activity/print_error.h"
#include "common/bus/membership/library_check.h"
#include "common/configuration/configuration_tree.h"
#include "common/experiment/places.h"
#include "common/program/interrupts.h"

namespace swarmanoid
{

namespace
{

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr auto kAgain = 1s;                                // what others may not have heard is said again
constexpr auto kPatience = 1s;                             // before what is waited for is said
constexpr auto kBrokenTime = 5s;                           // for the lease of a dead process to end
constexpr auto kStuckTime = 2s;                            // likewise, if another process may take its place
constexpr auto kPatienceForNext = 15s;                     // of observers, for another space server
constexpr std::chrono::milliseconds kFirstRepeat = 100ms;  // of a Leave that is not answered
constexpr std::chrono::milliseconds kLastRepeat = 1s;
constexpr auto kInterruptedTime = 1s;  // for the answer to a Leave, if it was asked to end

// The text of an experiment, whatever its seed and in whichever files its elements stand.
std::string WithoutSeed(std::string_view xml)
{
  std::string text(WithoutPlaces(xml));
  constexpr std::string_view kEnd = "</seed>";
  const std::size_t end = text.find(kEnd);
  if (end >= text.find("</framework>")) return text;
  const std::size_t begin = text.rfind('\n', end);
  return text.erase(begin, end + kEnd.size() - begin);
}

bool IsAlive(pid_t process) { return kill(process, 0) == 0 || errno == EPERM; }

}  // namespace

WorkerSession::WorkerSession(const BusOptions& options, const std::string& experiment, const std::string& name,
                             std::optional<int> server, unsigned incarnation, const std::string& machine,
                             const std::atomic<bool>* stop)
    : name_(name),
      incarnation_(incarnation),
      machine_(machine),
      stop_(stop != nullptr ? *stop : InterruptFlag()),
      bus_(options, name),
      domain_(options.domain)
{
  bus_.OnProcessGone(
      [this](const std::string& process, const std::string&, bool)
      {
        const std::lock_guard lock(mutex_);
        if (process != server_process_) return;
        server_lost_ = true;
        changed_.notify_all();
      });
  bus_.OnBadMessage([this](const BadMessageReport& report) { return FailedBy(report); });
  worlds_ = std::make_unique<Subscription<WorldMessage>>(bus_, experiment.empty() ? "*" : experiment,
                                                         [this](const WorldMessage& world)
                                                         {
                                                           const std::lock_guard lock(mutex_);
                                                           if (have_world_)
                                                           {
                                                             if (is_observer_ && GoesOnWith(world)) next_world_ = world;
                                                             return;
                                                           }
                                                           world_ = world;
                                                           have_world_ = true;
                                                           server_process_ =
                                                               fmt::format("{}:{}", world.host, world.pid);
                                                           changed_.notify_all();
                                                         });
  // A grant that has ended tells no world, but why it has.
  if (options.grant) HearLeaves(experiment);
  WaitUntil(
      [&]
      {
        const std::lock_guard lock(mutex_);
        if (!have_world_ && server && !IsAlive(*server))
          throw BusError(
              fmt::format("experiment '{}' has ended: its space server, process {}, has gone", experiment, *server));
        return have_world_;
      },
      [&]
      {
        return fmt::format("the space server of {} in domain {}",
                           experiment.empty() ? "any experiment" : "'" + experiment + "'", domain_);
      });
  if (world_.protocol != kProtocolVersion)
    throw BusError(fmt::format(
        "the space server of '{}' ({}) speaks protocol version {}, this program version {}; use programs of "
        "one release",
        world_.experiment, server_process_, world_.protocol, kProtocolVersion));

  if (!options.insecure && stop == nullptr) AllowOnly(world_.libraries, !options.key_file.empty() || options.grant);
  server_seen_ = ServerIsOnThisMachine();
  directory_ = std::make_unique<RunDirectory>(world_.experiment, world_.run);
  join_ = std::make_unique<Publisher<JoinMessage>>(bus_, world_.experiment);
  status_ = std::make_unique<Publisher<StatusMessage>>(bus_, world_.experiment);
  leave_ = std::make_unique<Publisher<LeaveMessage>>(bus_, world_.experiment);
  if (leaves_ == nullptr) HearLeaves(world_.experiment);
  join_->Write({ProcessId(), kProtocolVersion, world_.run, name_, false, incarnation_, machine_, reach_});
}

void WorkerSession::HearLeaves(const std::string& experiment)
{
  leaves_ = std::make_unique<Subscription<LeaveMessage>>(bus_, experiment,
                                                         [this](const LeaveMessage& leave)
                                                         {
                                                           const std::lock_guard lock(mutex_);
                                                           const bool of_run = leave.run == world_.run;
                                                           if (leave.name != "space server")
                                                           {
                                                             if (of_run && leave.error.empty())
                                                               left_[leave.name] = leave.tick;
                                                             return;
                                                           }
                                                           const bool own = leave.process == ProcessId();
                                                           if (!leave.process.empty() && !own) return;
                                                           const bool ends_share =
                                                               !have_world_ && !own && !leave.error.empty();
                                                           if (have_world_ ? !of_run : !ends_share) return;
                                                           const bool answered = own && leave.error.empty();
                                                           (answered ? answered_ : server_left_) = true;
                                                           if (!leave.error.empty()) others_error_ = leave.error;
                                                           changed_.notify_all();
                                                         });
}

WorkerSession::~WorkerSession()
{
  bus_.OnBadMessage(nullptr);
  bus_.OnProcessGone(nullptr);
}

void WorkerSession::ReleaseWorld()
{
  const std::lock_guard lock(mutex_);
  std::exchange(world_.xml, {});
  std::exchange(world_.entities, {});
  std::exchange(world_.checkpoint, {});
}

void WorkerSession::ObserveOnly()
{
  const std::lock_guard lock(mutex_);
  is_observer_ = true;
}

bool WorkerSession::GoesOnWith(const WorldMessage& world) const
{
  return world.run != world_.run && world.experiment == world_.experiment && world.protocol == world_.protocol &&
         world.entities.size() == world_.entities.size() && WithoutSeed(world.xml) == WithoutSeed(world_.xml);
}

bool WorkerSession::FollowNext(const std::function<bool()>& idle)
{
  {
    const std::lock_guard lock(mutex_);
    if (!server_lost_ || server_left_ || !world_.recorded) return false;
    Say(fmt::format("the space server has gone (process {}); waiting {} s for another one in its place",
                    server_process_, kPatienceForNext.count()));
  }
  const auto start = Clock::now();
  while (true)
  {
    if (idle() || IsStopped()) return false;
    std::unique_lock lock(mutex_);
    if (next_world_) break;
    if (Clock::now() - start > kPatienceForNext) return false;
    changed_.wait_for(lock, 15ms);
  }
  {
    const std::lock_guard lock(mutex_);
    world_ = std::move(*next_world_);
    next_world_.reset();
    server_process_ = fmt::format("{}:{}", world_.host, world_.pid);
    server_lost_ = false;
    server_seen_ = ServerIsOnThisMachine();
    others_error_.reset();
    reason_ = EndReason::kFailed;
  }
  directory_ = std::make_unique<RunDirectory>(world_.experiment, world_.run);
  join_->Write({ProcessId(), kProtocolVersion, world_.run, name_, true, incarnation_, machine_, reach_});
  Say("the run goes on with another space server");
  return true;
}

bool WorkerSession::RunHasEnded() const
{
  const std::lock_guard lock(mutex_);
  return server_left_ && !others_error_;
}

bool WorkerSession::IsOver() const
{
  const std::lock_guard lock(mutex_);
  return others_error_ || server_left_ || ServerHasGone();
}

bool WorkerSession::HasLeft(const std::string& name, std::uint64_t tick) const
{
  const std::lock_guard lock(mutex_);
  const auto found = left_.find(name);
  return found != left_.end() && found->second >= tick;
}

void WorkerSession::Trust(const std::string& name)
{
  const std::lock_guard lock(mutex_);
  trusted_.insert(name);
}

bool WorkerSession::IsOfTheRun(const BadMessageReport& report) const
{
  return (have_world_ && report.process == server_process_) || trusted_.count(report.name) > 0;
}

bool WorkerSession::FailedBy(const BadMessageReport& report)
{
  const std::lock_guard lock(mutex_);
  if (!IsOfTheRun(report)) return false;
  if (!own_error_)
  {
    own_error_ = fmt::format("{} sent a bad {} at tick {}: {}", report.name, report.topic, report.tick, report.what);
    NoteEnd(EndReason::kFailed, report.tick, *own_error_, true);
  }
  changed_.notify_all();
  return true;
}

HotScope WorkerSession::Scope(std::size_t capacity, unsigned writers) const
{
  return {world_.experiment, directory_->Path(), world_.spread, capacity, writers};
}

void WorkerSession::CheckOthers()
{
  const std::lock_guard lock(mutex_);
  if (IsStopped())
  {
    reason_ = EndReason::kInterrupted;
    throw BusError("interrupted by a signal");
  }
  // Whatever is thrown below, it is not this process that failed.
  const EndReason before = std::exchange(reason_, EndReason::kOthers);
  if (others_error_) throw BusError(*others_error_);
  // It may have gone since.
  if (server_left_) throw BusError("the run has ended");
  cut_off_ = server_lost_ = ServerHasGone();
  if (cut_off_) throw BusError(fmt::format("the space server has gone (process {})", server_process_));
  if (BusIsBroken())
  {
    if (!broken_since_) broken_since_ = Clock::now();
    stuck_ = Clock::now() - *broken_since_ > (world_.recorded ? kStuckTime : kBrokenTime);
    if (stuck_) throw BusError("a process died, or was stopped, while it held shared memory of the run");
  }
  reason_ = before;
}

// The leases of a run on one machine are long: its launcher sees who dies, but those who are attached have none.
bool WorkerSession::ServerHasGone() const
{
  return server_lost_ || next_world_ || (server_seen_ && !ServerIsOnThisMachine());
}

bool WorkerSession::ServerIsOnThisMachine() const
{
  return world_.host == MachineName() && IsAlive(static_cast<pid_t>(world_.pid));
}

void WorkerSession::Say(const std::string& text) const { PrintError("{}: {}\n", name_, text); }

void WorkerSession::WaitUntil(const std::function<bool()>& met, const std::function<std::string()>& what)
{
  const auto start = Clock::now();
  std::string said;
  while (!met())
  {
    CheckOthers();
    if (Clock::now() - start > kPatience)
      if (std::string text = what(); text != said)
      {
        Say("waiting for " + text + " …");
        said = text;
      }
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, 2ms);
  }
}

void WorkerSession::ReportReady()
{
  said_ready_ = Clock::now();
  join_->Write({ProcessId(), kProtocolVersion, world_.run, name_, true, incarnation_, machine_, reach_});
}

bool WorkerSession::HasBegun() const
{
  const std::lock_guard lock(mutex_);
  return first_tick_ && tick_ != *first_tick_;
}

void WorkerSession::Finish(std::uint64_t tick)
{
  const std::lock_guard lock(mutex_);
  tick_ = tick;
  done_ = true;
  changed_.notify_all();
}

void WorkerSession::Fail(std::uint64_t tick, const std::string& error, bool complete)
{
  const std::lock_guard lock(mutex_);
  tick_ = tick;
  if (!own_error_)
  {
    own_error_ = error;
    // At once: others may end because of it before this process does.
    NoteEnd(EndReason::kFailed, tick, complete ? error : fmt::format("{} failed at tick {}: {}", name_, tick, error),
            complete);
  }
  changed_.notify_all();
}

void WorkerSession::Notify()
{
  const std::lock_guard lock(mutex_);
  notified_ = true;
  changed_.notify_all();
}

void WorkerSession::SetTick(std::uint64_t tick)
{
  const std::lock_guard lock(mutex_);
  // The run goes on: another process has taken the place of the one that died with its lock.
  if (tick != tick_) broken_since_.reset();
  tick_ = tick;
  if (!first_tick_) first_tick_ = tick;
}

void WorkerSession::Wait(std::chrono::milliseconds period, const std::function<std::optional<std::string>()>& idle)
{
  try
  {
    WaitUntilDone(period, idle);
  }
  catch (const std::exception& error)
  {
    GiveUp(error);
  }
}

void WorkerSession::GiveUp(const std::exception& error)
{
  Say(error.what());
  ReportFailure(error);
  directory_->Leave();
  EndAtOnce(ExitCode());
}

std::optional<BusError> WorkerSession::Follow(std::chrono::milliseconds period, const std::function<void()>& idle)
{
  try
  {
    WaitUntilDone(period,
                  [&]
                  {
                    idle();
                    return std::nullopt;
                  });
    return std::nullopt;
  }
  catch (const BusError& error)
  {
    return error;
  }
}

void WorkerSession::WaitUntilDone(std::chrono::milliseconds period,
                                  const std::function<std::optional<std::string>()>& idle)
{
  while (true)
  {
    if (const std::optional<std::string> text = idle(); text && *text != last_status_)
    {
      last_status_ = *text;
      status_->Write({world_.run, tick_, name_, *text});
    }
    {
      const std::lock_guard lock(mutex_);
      if (own_error_)
      {
        reason_ = EndReason::kFailed;
        throw BusError(*own_error_);
      }
      if (done_) return;
    }
    CheckOthers();
    // Fast DDS may lose what was said while the reader was met, although the reader has acknowledged it.
    if (!HasBegun() && Clock::now() - said_ready_ > kAgain) ReportReady();
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, period,
                      [this]
                      { return notified_ || done_ || own_error_ || others_error_ || server_lost_ || server_left_; });
    notified_ = false;
  }
}

void WorkerSession::ReportFailure(const std::exception& error)
{
  const bool complete = dynamic_cast<const ActivityError*>(&error) != nullptr;
  const std::string text =
      dynamic_cast<const std::bad_alloc*>(&error) != nullptr ? OutOfMemoryText() : std::string(error.what());
  if (dynamic_cast<const ConfigurationError*>(&error) != nullptr)
    NoteEnd(EndReason::kInvalid, tick_, text, true);
  else
    NoteEnd(reason_, tick_, complete ? text : fmt::format("{} failed at tick {}: {}", name_, tick_, text), complete);
  {
    const std::lock_guard lock(mutex_);
    if (server_lost_ || server_left_) return;
  }
  LeaveRun(text);
}

void WorkerSession::LeaveRun(const std::string& error)
{
  const auto start = Clock::now();
  auto repeat_after = kFirstRepeat;
  std::unique_lock lock(mutex_);
  const LeaveMessage leave{world_.run, tick_, name_, ProcessId(), error};
  const auto over = [this] { return answered_ || server_left_ || server_lost_; };
  while (!over())
  {
    lock.unlock();
    if (server_seen_ && !ServerIsOnThisMachine()) return;
    if (BusIsBroken() || (IsStopped() && Clock::now() - start > kInterruptedTime)) return;
    leave_->Write(leave);
    lock.lock();
    changed_.wait_for(lock, repeat_after, over);
    repeat_after = std::min(2 * repeat_after, kLastRepeat);
  }
}

int WorkerSession::ExitCode() const
{
  if (reason_ == EndReason::kInterrupted) return kExitInterrupted;
  if (reason_ != EndReason::kOthers || is_observer_) return kExitProcessFailed;
  if (stuck_) return kExitStuck;
  return cut_off_ ? kExitCutOff : kExitOthersFailed;
}

int WorkerSession::Work(const std::function<void()>& work)
{
  try
  {
    work();
  }
  catch (const std::exception& error)
  {
    ReportFailure(error);
    if (reason_ == EndReason::kFailed) throw;
    Say(error.what());
    return ExitCode();
  }
  NoteEnd(EndReason::kDone, tick_, "");
  LeaveRun("");
  return kExitDone;
}

}  // namespace swarmanoid

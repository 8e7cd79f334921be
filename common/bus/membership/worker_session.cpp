// The main thread waits in WaitUntil or WaitUntilDone, and looks at the time, the signals and the server between short
// sleeps. Threads of the bus report messages to the membership under mutex_ and wake the main thread.
//
// Invariant: while mutex_ is locked, no message is written and no function of the caller runs. The bus holds locks of
// its own when it calls this class.
#include "common/bus/membership/worker_session.h"

#include <fmt/format.h>
#include <algorithm>
#include <new>
#include <utility>

#include "common/bus/membership/library_check.h"
#include "common/configuration/configuration_tree.h"
#include "common/errors/exit_codes.h"
#include "common/errors/print_error.h"
#include "common/experiment/source_places.h"
#include "common/memory/memory_limit.h"
#include "common/program/interrupts.h"

namespace swarmanoid
{

namespace
{

using namespace std::chrono_literals;
using Clock = RunClock;
using Phase = WorkerMembership::Phase;
using Event = WorkerMembership::Event;
using Action = WorkerMembership::Action;

constexpr auto kPatience = 1s;          // until the process says what it waits for
constexpr auto kPatienceForNext = 15s;  // how long observers wait for another space server
constexpr auto kLook = 100ms;           // period of the check whether the server exists, while this process leaves

// The period in which a process looks for what it waits for, at first and after a while. Hundreds of processes that
// look often would take the processor from those they wait for.
constexpr Clock::duration kShortestWait = 2ms;
constexpr Clock::duration kLongestWait = 20ms;

// Returns the text of an experiment without its seed. Its elements may come from several files.
std::string WithoutSeed(std::string_view xml)
{
  std::string text(WithoutPlaces(xml));
  constexpr std::string_view kEnd = "</seed>";
  const std::size_t end = text.find(kEnd);
  if (end >= text.find("</framework>")) return text;
  const std::size_t begin = text.rfind('\n', end);
  return text.erase(begin, end + kEnd.size() - begin);
}

}  // namespace

WorkerSession::WorkerSession(const BusOptions& options, const std::string& experiment, const std::string& name,
                             std::optional<int> server, unsigned incarnation, const std::string& machine,
                             const std::atomic<bool>* stop)
    : name_(name),
      incarnation_(incarnation),
      machine_(machine),
      stop_(stop != nullptr ? *stop : InterruptFlag()),
      bus_(options, name, experiment),
      domain_(options.domain)
{
  bus_.OnProcessGone(
      [this](const std::string& process, const std::string&, bool)
      {
        const std::lock_guard lock(mutex_);
        if (process != membership_.Server()) return;
        membership_.On(Event::kServerGone, Clock::now());
        changed_.notify_all();
      });
  bus_.OnBadMessage([this](const BadMessageReport& report) { return FailedBy(report); });
  worlds_ = std::make_unique<Subscription<WorldMessage>>(bus_, experiment.empty() ? "*" : experiment,
                                                         [this](const WorldMessage& world) { HeardWorld(world); });
  // A grant that has ended sends no world, but the reason of its end.
  if (options.grant) HearLeaves(experiment);
  WaitUntil(
      [&]
      {
        const std::lock_guard lock(mutex_);
        // If the run ends from here on, Work says how.
        const bool is_found = !membership_.Server().empty();
        if (!is_found && server && !IsAlive(*server))
          throw BusError(
              fmt::format("experiment '{}' has ended: its space server, process {}, has gone", experiment, *server));
        return is_found;
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
        world_.experiment, membership_.Server(), world_.protocol, kProtocolVersion));

  if (!options.insecure && stop == nullptr) AllowOnly(world_.libraries, !options.key_file.empty() || options.grant);
  server_seen_ = ServerIsOnThisMachine();
  directory_ = std::make_unique<RunDirectory>(world_.experiment, world_.run);
  join_ = std::make_unique<Publisher<JoinMessage>>(bus_, world_.experiment);
  status_ = std::make_unique<Publisher<StatusMessage>>(bus_, world_.experiment);
  leave_ = std::make_unique<Publisher<LeaveMessage>>(bus_, world_.experiment);
  if (leaves_ == nullptr) HearLeaves(world_.experiment);
  SayJoin(false);
}

void WorkerSession::HeardWorld(const WorldMessage& world)
{
  const std::lock_guard lock(mutex_);
  if (membership_.Now() == Phase::kSearching)
  {
    world_ = world;
    // The constructor sends Join as soon as it can write.
    membership_.HeardWorld(fmt::format("{}:{}", world.host, world.pid), world.recorded, Clock::now());
  }
  else if (membership_.Observes() && GoesOnWith(world))
  {
    next_world_ = world;
    membership_.On(Event::kServerGone, Clock::now());
  }
  changed_.notify_all();
}

void WorkerSession::HearLeaves(const std::string& experiment)
{
  leaves_ =
      std::make_unique<Subscription<LeaveMessage>>(bus_, experiment,
                                                   [this](const LeaveMessage& leave)
                                                   {
                                                     const std::lock_guard lock(mutex_);
                                                     membership_.Heard(leave, ProcessId(), world_.run, Clock::now());
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
  membership_.Observe();
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
    if (membership_.End() != Phase::kCutOff || !world_.recorded) return false;
    Say(fmt::format("the space server has gone (process {}); waiting {} s for another one in its place",
                    membership_.Server(), kPatienceForNext.count()));
  }
  const auto start = Clock::now();
  while (true)
  {
    if (idle() || stop_) return false;
    std::unique_lock lock(mutex_);
    if (next_world_) break;
    if (Clock::now() - start > kPatienceForNext) return false;
    changed_.wait_for(lock, 15ms);
  }
  {
    const std::lock_guard lock(mutex_);
    world_ = std::move(*next_world_);
    next_world_.reset();
    membership_.JoinNext(fmt::format("{}:{}", world_.host, world_.pid), world_.recorded, Clock::now());
    server_seen_ = ServerIsOnThisMachine();
  }
  directory_ = std::make_unique<RunDirectory>(world_.experiment, world_.run);
  SayJoin(true);
  Say("the run goes on with another space server");
  return true;
}

bool WorkerSession::RunHasEnded() const
{
  const std::lock_guard lock(mutex_);
  return membership_.End() == Phase::kRunOver;
}

bool WorkerSession::HasLeft(const std::string& name, std::uint64_t tick) const
{
  const std::lock_guard lock(mutex_);
  return membership_.HasLeft(name, tick);
}

void WorkerSession::Trust(const std::string& name)
{
  const std::lock_guard lock(mutex_);
  trusted_.insert(name);
}

bool WorkerSession::FailedBy(const BadMessageReport& report)
{
  const std::lock_guard lock(mutex_);
  const bool is_server = membership_.Now() != Phase::kSearching && report.process == membership_.Server();
  if (!is_server && trusted_.count(report.name) == 0) return false;
  const std::string text =
      fmt::format("{} sent a bad {} at tick {}: {}", report.name, report.topic, report.tick, report.what);
  if (membership_.Now() < Phase::kFailed) NoteEnd(EndReason::kFailed, report.tick, text, true);
  membership_.On(Event::kOwnFailure, Clock::now(), text);
  changed_.notify_all();
  return true;
}

HotScope WorkerSession::Scope(std::size_t capacity, unsigned writers) const
{
  return {world_.experiment, directory_->Path(), world_.spread, capacity, writers};
}

// The leases of a run on one machine are long, because its launcher sees which process dies. Observers have no
// launcher.
WorkerMembership::Sight WorkerSession::Sight() const
{
  return {stop_, BusIsBroken(), server_seen_ && !ServerIsOnThisMachine()};
}

void WorkerSession::CheckEnd()
{
  Action action = Action::kNone;
  {
    const std::lock_guard lock(mutex_);
    action = membership_.Look(Sight(), Clock::now());
    if (membership_.HasEnded()) throw BusError(membership_.Text());
  }
  // Fast DDS may lose messages that were sent while the reader was matched, although the reader has acknowledged them.
  if (action != Action::kNone && join_ != nullptr) SayJoin(action == Action::kSayReady);
}

bool WorkerSession::ServerIsOnThisMachine() const { return world_.host == MachineName() && IsAlive(world_.pid); }

void WorkerSession::Say(const std::string& text) const { PrintError("{}: {}\n", name_, text); }

void WorkerSession::WaitUntil(const std::function<bool()>& met, const std::function<std::string()>& what)
{
  const auto start = Clock::now();
  std::string said;
  while (!met())
  {
    CheckEnd();
    if (Clock::now() - start > kPatience)
      if (std::string text = what(); text != said)
      {
        Say("waiting for " + text + " …");
        said = text;
      }
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, std::clamp((Clock::now() - start) / 32, kShortestWait, kLongestWait));
  }
}

void WorkerSession::ReportReady()
{
  {
    const std::lock_guard lock(mutex_);
    if (membership_.On(Event::kPrepared, Clock::now()) != Action::kSayReady) return;
  }
  SayJoin(true);
}

void WorkerSession::SayJoin(bool ready)
{
  join_->Write({ProcessId(), kProtocolVersion, world_.run, name_, ready, incarnation_, machine_, reach_});
}

void WorkerSession::Finish(std::uint64_t tick)
{
  const std::lock_guard lock(mutex_);
  membership_.AtTick(tick, Clock::now());
  membership_.On(Event::kLastTick, Clock::now());
  changed_.notify_all();
}

void WorkerSession::Fail(std::uint64_t tick, const std::string& error, bool complete)
{
  const std::lock_guard lock(mutex_);
  membership_.AtTick(tick, Clock::now());
  // The failure is reported at once, because other processes may end because of it before this one does.
  if (membership_.Now() < Phase::kFailed)
    NoteEnd(EndReason::kFailed, tick, complete ? error : fmt::format("{} failed at tick {}: {}", name_, tick, error),
            complete);
  membership_.On(Event::kOwnFailure, Clock::now(), error);
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
  membership_.AtTick(tick, Clock::now());
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
    if (std::optional<std::string> text = idle())
    {
      // The same text at another tick is news: the server asks for what is said of its tick.
      const std::uint64_t tick = Tick();
      if (last_status_.run != world_.run || last_status_.tick != tick || last_status_.text != *text)
      {
        last_status_ = {world_.run, tick, name_, std::move(*text)};
        status_->Write(last_status_);
      }
    }
    CheckEnd();
    std::unique_lock lock(mutex_);
    if (membership_.Now() == Phase::kFinishing) return;
    changed_.wait_for(lock, period,
                      [this] { return notified_ || membership_.HasEnded() || membership_.Now() == Phase::kFinishing; });
    notified_ = false;
  }
}

std::uint64_t WorkerSession::Tick() const
{
  const std::lock_guard lock(mutex_);
  return membership_.Tick();
}

void WorkerSession::ReportFailure(const std::exception& error)
{
  const bool complete = dynamic_cast<const ActivityError*>(&error) != nullptr;
  const std::string text =
      dynamic_cast<const std::bad_alloc*>(&error) != nullptr ? OutOfMemoryText() : std::string(error.what());
  const std::uint64_t tick = Tick();
  EndReason reason = EndReason::kInvalid;
  {
    const std::lock_guard lock(mutex_);
    if (!membership_.HasEnded()) membership_.On(Event::kOwnFailure, Clock::now(), text);
    reason = membership_.Reason();
  }
  if (dynamic_cast<const ConfigurationError*>(&error) != nullptr)
    NoteEnd(EndReason::kInvalid, tick, text, true);
  else
    NoteEnd(reason, tick, complete ? text : fmt::format("{} failed at tick {}: {}", name_, tick, text), complete);
  LeaveRun(text);
}

void WorkerSession::LeaveRun(const std::string& error)
{
  std::unique_lock lock(mutex_);
  const LeaveMessage leave{world_.run, membership_.Tick(), name_, ProcessId(), error};
  Action action = membership_.On(Event::kWorkEnded, Clock::now());
  for (membership_.Look(Sight(), Clock::now()); membership_.Now() == Phase::kLeaving;
       action = membership_.Look(Sight(), Clock::now()))
  {
    lock.unlock();
    if (action == Action::kSayLeave)
    {
      // The server does not answer a replacement whose Join was lost.
      SayJoin(false);
      leave_->Write(leave);
    }
    lock.lock();
    changed_.wait_for(lock, kLook, [this] { return membership_.Now() == Phase::kLeft; });
  }
}

int WorkerSession::ExitCode() const
{
  const std::lock_guard lock(mutex_);
  return membership_.ExitCode();
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
    {
      const std::lock_guard lock(mutex_);
      if (membership_.Reason() == EndReason::kFailed) throw;
    }
    Say(error.what());
    return ExitCode();
  }
  NoteEnd(EndReason::kDone, Tick(), "");
  LeaveRun("");
  return kExitDone;
}

}  // namespace swarmanoid

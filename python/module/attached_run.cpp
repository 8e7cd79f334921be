// A Python program looks on at a run that another process started. A thread follows the run over the bus and keeps the
// latest state; calls of Python wait for a state with Python's lock released, and look for signals every 50 ms so that
// Ctrl+C works.
//
// `mutex_` guards the state that the thread writes and Python reads. `asking_` guards the client of control orders,
// which exists only while the thread follows; it is taken before `mutex_` if both are needed. A state is applied to the
// replica of the space when it is read, not when it arrives, because most states are never looked at.
#include "python/module/attached_run.h"

#include <fmt/format.h>
#include <pybind11/pybind11.h>

#include <utility>

#include "common/activity/failure_report.h"
#include "common/bus/membership/library_check.h"
#include "common/configuration/wording.h"
#include "common/plugins/plugin_library.h"
#include "common/program/usage_error.h"
#include "common/run/access/access_grant.h"
#include "common/space/space.h"
#include "common/threads/start_thread.h"
#include "launcher/command/control_words.h"
#include "launcher/system/network_namespace.h"
#include "simulation/register_all.h"

namespace py = pybind11;

namespace swarmanoid::python
{
namespace
{

using namespace std::chrono_literals;

constexpr auto kIdlePeriod = 15ms;
constexpr auto kLookAtSignals = 50ms;
constexpr double kTimeToLeave_s = 5;

bool SignalCame()
{
  const py::gil_scoped_acquire python;
  return PyErr_CheckSignals() != 0;
}

// The runs that this process looks on at. To the others it is one process, which cannot do so twice.
std::set<std::pair<std::string, int>>& AttachedTo()
{
  static std::set<std::pair<std::string, int>> runs;  // while Python is held
  return runs;
}

}  // namespace

AttachedRun::AttachedRun(const AttachedRunOptions& given)
{
  AttachedRunOptions options = given;
  RegisterBuiltins();
  FindRun(options);
  insecure_ = options.bus.insecure;
  own_folders_only_ = !options.bus.key_file.empty() || options.bus.grant;
  if (!AttachedTo().insert({choice_.experiment, choice_.domain}).second)
    throw UsageError(fmt::format("this program is attached to {} already; use that object, or close it first",
                                 Quoted(choice_.experiment)));
  thread_ = StartThread("follows the run", [this, options] { Run(options); });
  try
  {
    if (!Await(options.timeout_s, [this] { return ready_ || over_; }))
      throw TimeOver(fmt::format(
          "the space server of {} in domain {} was not heard within {:g} s; if it runs on another machine, give the "
          "key of the run and the interface or peers by which it is reached (docs/security.md)",
          options.experiment.empty() ? "any experiment" : Quoted(choice_.experiment), choice_.domain,
          options.timeout_s));
    if (error_) std::rethrow_exception(error_);
    if (!ready_) ThrowFailure();
  }
  catch (...)
  {
    stop_ = true;
    Close();
    throw;
  }
}

void AttachedRun::FindRun(AttachedRunOptions& options)
{
  const auto token = TokenOfEnvironment();
  if (token) UseToken(*token, options.bus);
  const auto deadline = Clock::now() + std::chrono::duration<double>(options.wait_s);
  while (true)
  {
    try
    {
      choice_ = token ? RunOf(*token, options.experiment) : ChooseRun(options.experiment, options.domain);
      break;
    }
    catch (const UsageError&)
    {
      if (token || Clock::now() >= deadline) throw;
    }
    {
      const py::gil_scoped_release others;
      std::this_thread::sleep_for(kLookAtSignals);
    }
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  }
  CheckInsecure(choice_, options.bus);
  options.bus.domain = choice_.domain;
  if (choice_.server && !options.bus.Spread() && IsInAnotherNetwork(*choice_.server))
    throw UsageError(
        fmt::format("{} runs in a network of its own (--isolated), which a program of many threads cannot enter; "
                    "`swarmanoid attach` and `swarmanoid control` can",
                    Quoted(choice_.experiment)));
  UseNetworkOf(choice_, options.bus);
}

void AttachedRun::Run(const AttachedRunOptions& options)
{
  try
  {
    WorkerSession session(options.bus, choice_.experiment, "attached Python program " + ProcessId(), choice_.server, 0,
                          {}, &stop_);
    session.ObserveOnly();
    session.Work([&] { Follow(session, options.views); });
  }
  catch (...)
  {
    const std::lock_guard lock(mutex_);
    error_ = std::current_exception();
    failure_ = CurrentExceptionText();
  }
  const std::lock_guard lock(mutex_);
  over_ = true;
  changed_.notify_all();
}

// Libraries are loaded while this thread holds Python's lock, as when a Simulation is made. So no other thread loads
// one.
void AttachedRun::MakeReplica(const WorldMessage& world)
{
  const py::gil_scoped_acquire python;
  if (!insecure_) AllowOnly(world.libraries, own_folders_only_);
  std::unique_ptr<WorkerWorld> replica;
  try
  {
    replica = std::make_unique<WorkerWorld>(world, false);
  }
  catch (...)
  {
    SetLibraryCheck(nullptr);
    throw;
  }
  SetLibraryCheck(nullptr);
  replica->RestoreSpace();
  const std::lock_guard lock(mutex_);
  replica_ = std::move(replica);
}

void AttachedRun::Follow(WorkerSession& session, double views)
{
  MakeReplica(session.World());
  world_ = session.World();
  ControlClient client(session.GetBus(), world_.experiment, world_.run);
  RemoteMonitor monitor(session.GetBus(), world_, false);
  Subscription<ViewMessage> views_in(session.GetBus(), world_.experiment,
                                     [this](const ViewMessage& view) { Heard(view); });
  monitor.RequestViews(views);
  {
    const std::lock_guard asking(asking_);
    client_ = &client;
    bus_ = &session.GetBus();
  }
  {
    const std::lock_guard lock(mutex_);
    ready_ = true;
    changed_.notify_all();
  }
  session.ReportReady();

  std::optional<BusError> over;
  while ((over = session.Follow(kIdlePeriod, [&] { Work(session, monitor); })))
  {
    monitor.ServerIsLost();
    if (!session.FollowNext([this] { return stop_.load(); })) break;
    const WorldMessage& world = session.World();
    if (world.seed != world_.seed) MakeReplica(world);
    {
      const std::lock_guard lock(mutex_);
      world_ = world;
      applied_ = 0;
    }
    monitor.FollowRun(world.run);
    client.FollowRun(world.run);
  }
  if (session.RunHasEnded()) over.reset();
  {
    const std::lock_guard lock(mutex_);
    // The last state may have come with the word that it is the last.
    ended_ = !leaving_;
    if (over && !leaving_) failure_ = over->what();
    over_ = true;
    changed_.notify_all();
  }
  const std::lock_guard asking(asking_);
  client_ = nullptr;
  bus_ = nullptr;
}

void AttachedRun::Work(WorkerSession& session, RemoteMonitor& monitor)
{
  monitor.RenewRequests();
  std::unique_lock lock(mutex_);
  const std::vector<std::uint32_t> watched(watched_.begin(), watched_.end());
  lock.unlock();
  if (!watched.empty()) monitor.Watch(watched);
  const RunStatus& status = monitor.Status();
  lock.lock();
  status_ = status;
  for (const std::uint32_t robot : watched)
    if (const RobotStatus* heard = monitor.Robot(robot)) robots_[robot] = *heard;
  changed_.notify_all();
  const bool last = states_ > 0 && snapshot_.last;
  const std::uint64_t tick = snapshot_.tick;
  const bool leaving = leaving_;
  lock.unlock();
  if (last || leaving) session.Finish(tick);
}

void AttachedRun::Heard(const ViewMessage& view)
{
  const std::lock_guard lock(mutex_);
  if (view.run != world_.run) return;
  replica_->limits->Check(view.snapshot);
  snapshot_ = view.snapshot;
  ++states_;
  changed_.notify_all();
}

template <class Condition>
bool AttachedRun::Await(double timeout_s, const Condition& met)
{
  const auto start = Clock::now();
  while (true)
  {
    {
      const py::gil_scoped_release others;
      std::unique_lock lock(mutex_);
      if (changed_.wait_for(lock, kLookAtSignals, met)) return true;
    }
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (timeout_s >= 0 && Clock::now() - start > std::chrono::duration<double>(timeout_s)) return false;
  }
}

WorldMessage AttachedRun::World()
{
  const std::lock_guard lock(mutex_);
  return world_;
}

std::uint64_t AttachedRun::States()
{
  const std::lock_guard lock(mutex_);
  return states_;
}

bool AttachedRun::WithState(const Reader& read)
{
  const std::lock_guard lock(mutex_);
  if (states_ == 0) return false;
  if (std::exchange(applied_, states_) != states_) replica_->space->Apply(snapshot_);
  read(*replica_->space, snapshot_, states_);
  return true;
}

bool AttachedRun::Wait(std::uint64_t taken, std::uint64_t stale, std::uint64_t tick, double timeout_s)
{
  const auto is_there = [&]
  { return states_ > taken && (states_ > stale || snapshot_.last) && snapshot_.tick >= tick; };
  if (!Await(timeout_s, [&] { return is_there() || over_; }))
    throw TimeOver(fmt::format("no new state of {} within {:g} s; it is at tick {}{}", Quoted(choice_.experiment),
                               timeout_s, Status().tick,
                               Status().phase == RunStatus::Phase::kPaused ? ", paused" : ""));
  const std::lock_guard lock(mutex_);
  if (is_there()) return true;
  if (!failure_.empty()) throw RunError(failure_);
  return false;
}

void AttachedRun::ThrowFailure() const
{
  if (!failure_.empty()) throw RunError(failure_);
  throw RunError(closed_ || leaving_ ? "this program has left the run; attach again"
                                     : fmt::format("the run of {} has ended", Quoted(choice_.experiment)));
}

ControlReplyMessage AttachedRun::Control(const std::vector<std::string>& words,
                                         const std::map<std::string, std::string>& options)
{
  const ControlOrder order = ParseControlWords(words, options).order;
  std::optional<ControlReplyMessage> reply;
  std::optional<RunStatus> status;
  std::uint64_t dropped = 0;
  {
    const py::gil_scoped_release others;
    const std::lock_guard asking(asking_);
    if (client_ == nullptr)
    {
      const std::lock_guard lock(mutex_);
      ThrowFailure();
    }
    if (!bus_->MaySpeakTo(choice_.experiment))
      throw UsageError(
          fmt::format("no run of experiment {} in domain {} on this machine is of user {}, and no key of it is given; "
                      "the user who started it can steer it, or give you its key (docs/security.md)",
                      Quoted(choice_.experiment), choice_.domain, UserName()));
    reply = client_->Ask(order, PatienceFor(order, kPatience_s), [this] { return stop_ || SignalCame(); });
    status = client_->LatestStatus();
    dropped = bus_->Dropped();
  }
  if (PyErr_Occurred() != nullptr) throw py::error_already_set();
  if (!reply)
    throw RunError(fmt::format("experiment {} in domain {} does not answer{}", Quoted(choice_.experiment),
                               choice_.domain, WhyNoAnswer(status, dropped, insecure_)));
  return *reply;
}

RunStatus AttachedRun::Status()
{
  const std::lock_guard lock(mutex_);
  return status_;
}

RobotStatus AttachedRun::Robot(std::uint32_t entity, double timeout_s)
{
  {
    const std::lock_guard lock(mutex_);
    watched_.insert(entity);
  }
  if (!Await(timeout_s, [&] { return over_ || robots_.contains(entity); }))
    throw TimeOver(
        fmt::format("nothing was told of '{}' within {:g} s: it has no controller, or the run does not get on",
                    Space().GetEntity(entity).GetId(), timeout_s));
  const std::lock_guard lock(mutex_);
  const auto found = robots_.find(entity);
  if (found == robots_.end()) ThrowFailure();
  return found->second;
}

bool AttachedRun::IsOver()
{
  const std::lock_guard lock(mutex_);
  return over_ || (states_ > 0 && snapshot_.last);
}

std::string AttachedRun::Failure()
{
  const std::lock_guard lock(mutex_);
  return failure_;
}

void AttachedRun::Close()
{
  if (std::exchange(closed_, true) || !thread_.joinable()) return;
  {
    const py::gil_scoped_release others;
    {
      std::unique_lock lock(mutex_);
      leaving_ = true;
      changed_.wait_for(lock, std::chrono::duration<double>(stop_ ? 0 : kTimeToLeave_s), [this] { return over_; });
    }
    stop_ = true;
    thread_.join();
  }
  AttachedTo().erase({choice_.experiment, choice_.domain});
}

}  // namespace swarmanoid::python

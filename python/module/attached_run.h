// swarmanoid.attach: this Python process as a member of a running experiment. It observes as an attached visualiser
// does, so the run never waits for it. It sends the requests of `swarmanoid control`. A thread of its own follows the
// run, and messages come in threads of the bus. Threads of Python call all public functions. They hold the
// interpreter's lock, and release it while they wait.
#pragma once

#include <pybind11/numpy.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "common/bus/membership/control_client.h"
#include "common/bus/membership/worker_session.h"
#include "common/bus/membership/worker_world.h"
#include "launcher/command/run_choice.h"
#include "visualiser/cluster/remote_monitor.h"

namespace swarmanoid::python
{

// The run has failed, is over, or cannot be reached.
class RunError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

// Nothing came in time; Python sees a TimeoutError.
class TimeOver : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

struct AttachedRunOptions
{
  std::string experiment;     // empty: the only one of this machine
  std::optional<int> domain;  // of a run of another machine
  BusOptions bus;
  double views = 30;      // states a second at most
  double wait_s = 0;      // for a run to begin
  double timeout_s = 10;  // for it to be heard
};

class AttachedRun
{
public:
  // Joins the run. Throws UsageError if the run or the key for it does not exist, TimeOver if the run does not answer
  // in time, RunError if it ended meanwhile, and ConfigurationError if its experiment cannot be read here.
  explicit AttachedRun(const AttachedRunOptions& options);
  ~AttachedRun() { Close(); }

  const RunChoice& Choice() const { return choice_; }
  // World is that of the latest server. Space has the entities, with the state of the latest call of WithState.
  WorldMessage World();
  const CSwarmanoidSpace& Space() const { return *replica_->space; }

  // How many states have come; 0: none yet.
  std::uint64_t States();
  // Calls `read` with the space at the newest state, and how many have come. False if none has.
  using Reader =
      std::function<void(const CSwarmanoidSpace& space, const SpaceSnapshot& snapshot, std::uint64_t number)>;
  bool WithState(const Reader& read);
  // Waits for a state of `tick` or later that is not among the first `taken` ones. It must not be among the first
  // `stale` ones either, unless no tick follows it. Returns false if the run is over. Throws TimeOver; a negative time
  // is no limit.
  bool Wait(std::uint64_t taken, std::uint64_t stale, std::uint64_t tick, double timeout_s);

  // Sends a request in the words of `swarmanoid control`. Throws UsageError for invalid words, RunError if the run does
  // not answer.
  ControlReplyMessage Control(const std::vector<std::string>& words, const std::map<std::string, std::string>& options);
  RunStatus Status();
  // Returns the inside of a robot, which the run sends from the first call on. Throws TimeOver.
  RobotStatus Robot(std::uint32_t entity, double timeout_s);

  // Returns whether no more states will come. Failure says why if the run has failed.
  bool IsOver();
  std::string Failure();
  // Leaves the run, which goes on. Idempotent.
  void Close();

private:
  using Clock = std::chrono::steady_clock;

  void FindRun(AttachedRunOptions& options);
  // This is the life of the thread.
  void Run(const AttachedRunOptions& options);
  void Follow(WorkerSession& session, double views);
  void Work(WorkerSession& session, RemoteMonitor& monitor);
  void Heard(const ViewMessage& view);
  void MakeReplica(const WorldMessage& world);
  // Waits for `met`, which is called with mutex_ held, while Python goes on; Ctrl-C ends it. False if the time is over.
  template <class Condition>
  bool Await(double timeout_s, const Condition& met);
  void ThrowFailure() const;

  RunChoice choice_;
  bool insecure_ = false;
  bool own_folders_only_ = false;
  std::atomic<bool> stop_ = false;  // without waiting for anybody
  bool closed_ = false;

  std::mutex asking_;  // guards client_
  ControlClient* client_ = nullptr;
  Bus* bus_ = nullptr;

  std::mutex mutex_;  // guards all members below
  std::condition_variable changed_;
  bool ready_ = false;
  bool leaving_ = false;
  bool over_ = false;
  bool ended_ = false;  // the run has, and no failure
  std::string failure_;
  std::exception_ptr error_;  // that kept it from looking on
  WorldMessage world_;
  std::unique_ptr<WorkerWorld> replica_;
  SpaceSnapshot snapshot_;
  std::uint64_t states_ = 0;
  std::uint64_t applied_ = 0;
  RunStatus status_;
  std::set<std::uint32_t> watched_;
  std::map<std::uint32_t, RobotStatus> robots_;

  std::thread thread_;
};

// Adds swarmanoid._module.AttachedRun and its exception.
void DefineAttachedRun(pybind11::module_& module);

}  // namespace swarmanoid::python

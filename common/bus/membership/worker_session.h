// WorkerSession connects a worker to a run, apart from its step. It sends, receives and measures time for its
// WorkerMembership, which decides. It reports what the worker waits for. The step itself runs in a thread of the bus.
// engine_worker, controller_host and visualiser use it.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>

#include "common/activity/failure_report.h"
#include "common/bus/bus.h"
#include "common/bus/membership/worker_membership.h"
#include "common/run/access/run_directory.h"
#include "common/threads/waiting.h"

namespace swarmanoid
{

class WorkerSession
{
public:
  // Waits for the space server of `experiment` (empty: the first server that is heard) and reports the wait. `name` is
  // that of JoinMessage. Throws BusError if the server's protocol differs, or when interrupted. `server`: the server's
  // process on this machine; BusError if it ends before it is heard. `incarnation`: how many processes of that name the
  // run has had before. `machine`: as in JoinMessage. `stop`: for a session within another program, which sets it to
  // interrupt the session. That program calls AllowOnly itself while it loads libraries.
  WorkerSession(const BusOptions& options, const std::string& experiment, const std::string& name,
                std::optional<int> server = std::nullopt, unsigned incarnation = 0, const std::string& machine = {},
                const std::atomic<bool>* stop = nullptr);
  ~WorkerSession();
  // Observer mode: the process exits with 4 if the run failed in another process.
  void ObserveOnly();

  const std::string& Name() const { return name_; }
  bool TakesAPlace() const { return incarnation_ > 0; }
  const WorldMessage& World() const { return world_; }
  // Releases what only building the world needs (xml, entities, checkpoint). Not for observers.
  void ReleaseWorld();
  Bus& GetBus() { return bus_; }
  HotScope Scope(std::size_t capacity, unsigned writers) const;
  MessageHeader Header(std::uint64_t tick, std::uint32_t source) const
  {
    return {world_.run, tick, source, false, incarnation_};
  }

  // Waits until `met` is true; after a while it reports "waiting for <what>". Throws BusError if the run ends before.
  void WaitUntil(const std::function<bool()>& met, const std::function<std::string()>& what);
  // Sets JoinMessage::reach of a host that hears LocalState. Call it before ReportReady.
  void SetReach(double reach_m) { reach_ = reach_m; }
  // Tells the server that this process can step.
  void ReportReady();

  // Does all work of the process after the constructor, and tells the server how it ended. Returns the exit code.
  // Exceptions of `work` pass through.
  int Work(const std::function<void()>& work);

  // Waits until the run ends. Call it within the work. `idle` is called by every Notify, and at least once in a
  // `period`. If this process is late, `idle` returns why ("waits for engine 'ground'", "controller of 'fb_3'"). The
  // reason goes to the server. Ends the program if this process or another one failed.
  void Wait(std::chrono::milliseconds period, const std::function<std::optional<std::string>()>& idle);
  // Waits like Wait, for a process that has more to do after the run. Returns nothing once Finish was called, or the
  // reason for the end of the run.
  std::optional<BusError> Follow(std::chrono::milliseconds period, const std::function<void()>& idle);
  // Returns whether the server said that the run ended without a failure.
  bool RunHasEnded() const;
  // Returns whether the process of that name has finished its work, at that tick or a later one.
  bool HasLeft(const std::string& name, std::uint64_t tick) const;
  // For observers, after Follow. If the server was lost and another may resume the run, reports so, waits for that
  // server and joins it. Returns false if no server has come in time, or if `idle` returns true. `idle` is called
  // repeatedly.
  bool FollowNext(const std::function<bool()>& idle);
  // Reports that this process failed, or has nothing left to do in a failed run, and ends the program.
  [[noreturn]] void GiveUp(const std::exception& error);
  int ExitCode() const;
  // Declares that `name` is a process of the run, which ends if that process sends a bad message. Call it before
  // messages come. The space server is trusted from the start.
  void Trust(const std::string& name);
  // Any thread may report that the work is done or failed, or that `idle` must be called.
  void Finish(std::uint64_t tick);
  // `complete`: the text itself names the process that failed.
  void Fail(std::uint64_t tick, const std::string& error, bool complete = false);
  void Notify();
  // Sets the tick of Status messages.
  void SetTick(std::uint64_t tick);

private:
  bool FailedBy(const BadMessageReport& report);
  void HearLeaves(const std::string& experiment);
  void HeardWorld(const WorldMessage& world);
  bool GoesOnWith(const WorldMessage& world) const;
  WorkerMembership::Sight Sight() const;
  bool ServerIsOnThisMachine() const;
  // Throws BusError once the membership has ended.
  void CheckEnd();
  void WaitUntilDone(std::chrono::milliseconds period, const std::function<std::optional<std::string>()>& idle);
  void SayJoin(bool ready);
  std::uint64_t Tick() const;
  // Reports to the launcher and the server why this process ends.
  void ReportFailure(const std::exception& error);
  // Stays until the server has answered or gone. A process that ends before its Leave is read would be reported as
  // dead.
  void LeaveRun(const std::string& error);
  void Say(const std::string& text) const;

  const std::string name_;
  const unsigned incarnation_;
  const std::string machine_;
  double reach_ = kReachesAll;
  const std::atomic<bool>& stop_;
  Bus bus_;
  const int domain_;
  mutable std::mutex mutex_;  // protects the membership, the worlds and the following members
  RunCondition changed_;
  WorkerMembership membership_;
  bool notified_ = false;  // wakes the main thread once
  WorldMessage world_;
  std::optional<WorldMessage> next_world_;  // the world of the server that resumes the run
  std::set<std::string> trusted_;
  bool server_seen_ = false;   // the server was seen among the processes of this machine; main thread
  StatusMessage last_status_;  // main thread
  std::unique_ptr<RunDirectory> directory_;
  std::unique_ptr<Subscription<WorldMessage>> worlds_;
  std::unique_ptr<Publisher<JoinMessage>> join_;
  std::unique_ptr<Publisher<StatusMessage>> status_;
  std::unique_ptr<Publisher<LeaveMessage>> leave_;
  std::unique_ptr<Subscription<LeaveMessage>> leaves_;
};

}  // namespace swarmanoid

// WorkerSession: how a worker takes part in a run beside its step. It sends, receives and measures time for its
// WorkerMembership, which decides, and it reports what the worker waits for. Used by engine_worker, controller_host and
// visualiser; the step itself runs in a thread of the bus.
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
#include "common/bus/membership/run_directory.h"
#include "common/bus/membership/worker_membership.h"
#include "common/threads/waiting.h"

namespace swarmanoid
{

class WorkerSession
{
public:
  // Waits for the space server of `experiment` (empty: of the first one that is heard), saying so. `name` as in
  // JoinMessage. Throws BusError if its protocol is another one, or when interrupted.
  // `server`: the process on this machine that is expected to be it; BusError if it ends before it is heard.
  // `incarnation`: how many processes of that name the run has had before this one. `machine`: as in JoinMessage.
  // `stop`: for a session within a program of somebody else, which sets it where others are interrupted by a signal,
  // and says itself by AllowOnly which libraries may be loaded while it loads some.
  WorkerSession(const BusOptions& options, const std::string& experiment, const std::string& name,
                std::optional<int> server = std::nullopt, unsigned incarnation = 0, const std::string& machine = {},
                const std::atomic<bool>* stop = nullptr);
  ~WorkerSession();
  // Observer mode: the process exits with 4 if the run failed in another process.
  void ObserveOnly();

  const std::string& Name() const { return name_; }
  bool TakesAPlace() const { return incarnation_ > 0; }
  const WorldMessage& World() const { return world_; }
  // Lets go of what serves to make the world alone (xml, entities, checkpoint). Not for observers.
  void ReleaseWorld();
  Bus& GetBus() { return bus_; }
  HotScope Scope(std::size_t capacity, unsigned writers) const;
  MessageHeader Header(std::uint64_t tick, std::uint32_t source) const
  {
    return {world_.run, tick, source, false, incarnation_};
  }

  // Waits until `met` is true; after a while it says "waiting for <what>". Throws BusError if the run ends before.
  void WaitUntil(const std::function<bool()>& met, const std::function<std::string()>& what);
  // Before ReportReady: of a host that hears LocalState (JoinMessage::reach).
  void SetReach(double reach_m) { reach_ = reach_m; }
  // Tells the server that this process can step.
  void ReportReady();

  // Does the work of the process, all of it after the constructor, and tells the server how it ended. Returns the exit
  // code; throws what `work` throws.
  int Work(const std::function<void()>& work);

  // Within the work: waits until the run ends. `idle` is called by every Notify, and at least once in a `period`. If
  // this process is late, it returns why ("waits for engine 'ground'", "controller of 'fb_3'"), which goes to the
  // server. Ends the program if this process or another one failed.
  void Wait(std::chrono::milliseconds period, const std::function<std::optional<std::string>()>& idle);
  // As Wait, for a process that still has something to do after the run: returns nothing once Finish was called, or the
  // reason for which the run ended.
  std::optional<BusError> Follow(std::chrono::milliseconds period, const std::function<void()>& idle);
  // Whether the server said that the run ended, and for no failure.
  bool RunHasEnded() const;
  // Whether the process of that name has said that its work is done, at that tick or a later one.
  bool HasLeft(const std::string& name, std::uint64_t tick) const;
  // For observers, after Follow: if the server was lost and its run may go on with another one, says so and
  // waits for that one, and joins it. False if none has come in time, or `idle`, which is called all the while, returns
  // true.
  bool FollowNext(const std::function<bool()>& idle);
  // Says that this process failed, or has nothing to do any more in a run that failed, and ends the program.
  [[noreturn]] void GiveUp(const std::exception& error);
  int ExitCode() const;
  // Before messages come: `name` is a process of the run, which ends when it sends a bad message. The space server is
  // one from the start.
  void Trust(const std::string& name);
  // From any thread: the work is done, or failed, or `idle` is to be called.
  void Finish(std::uint64_t tick);
  // `complete`: the text says by itself who failed.
  void Fail(std::uint64_t tick, const std::string& error, bool complete = false);
  void Notify();
  // The tick that Status messages have.
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
  // Why this process ends, to the launcher and to the server.
  void ReportFailure(const std::exception& error);
  // Stays until the server has answered, or has gone: a process that ends before its Leave is read would be reported as
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
  mutable std::mutex mutex_;  // of the membership, the worlds and what follows
  RunCondition changed_;
  WorkerMembership membership_;
  bool notified_ = false;  // wakes the main thread once
  WorldMessage world_;
  std::optional<WorldMessage> next_world_;  // of the server that goes on with the run
  std::set<std::string> trusted_;
  bool server_seen_ = false;  // among the processes of this machine; main thread
  std::string last_status_;   // main thread
  std::unique_ptr<RunDirectory> directory_;
  std::unique_ptr<Subscription<WorldMessage>> worlds_;
  std::unique_ptr<Publisher<JoinMessage>> join_;
  std::unique_ptr<Publisher<StatusMessage>> status_;
  std::unique_ptr<Publisher<LeaveMessage>> leave_;
  std::unique_ptr<Subscription<LeaveMessage>> leaves_;
};

}  // namespace swarmanoid

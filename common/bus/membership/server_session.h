// ServerSession connects the space server to a run, apart from its step. It publishes the world, and sends and receives
// for its ServerMembership. It receives the requests of users. Its step runs in threads of the bus.
#pragma once

#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/bus/bus.h"
#include "common/bus/guarded.h"
#include "common/bus/membership/server_membership.h"
#include "common/run/access/run_directory.h"

namespace swarmanoid
{

// Returns a random number for a new run.
std::uint64_t NewRun();

class ServerSession
{
public:
  // Threads of the bus call these functions.
  struct Callbacks
  {
    std::function<void(const ControlRequestMessage&)> asked;
    std::function<void()> changed;                         // a process joined, failed, left, or waits
    std::function<void(const std::string& process)> gone;  // a process has left the bus
    std::function<void(const ControlReplyMessage&)> replied{};
  };

  // `expected`: names of the processes that the run waits for. Throws BusError if an experiment of that name runs in
  // the domain already.
  ServerSession(const BusOptions& options, WorldMessage world, std::vector<std::string> expected, Callbacks callbacks);
  ~ServerSession();
  // A process that dies no longer fails the run. A process with a higher incarnation replaces it. Call it before Open.
  void AwaitReplacements() { state_.Lock()->membership.AwaitReplacements(); }
  // Lets others find the run; the callbacks may be called from now on.
  void Open();
  // Repeats the world for processes that have not received it.
  void SayWorldAgain();
  // Ends all callbacks.
  void Close();

  Bus& GetBus() { return bus_; }
  const WorldMessage& World() const { return world_; }
  // Returns the key of the run; none if every process is let in.
  const std::optional<RunKey>& Key() const { return key_; }
  HotScope Scope(std::size_t capacity, unsigned writers) const;

  // Returns the processes that are not ready yet, in the order of `expected`.
  std::vector<std::string> Missing() const;
  // Returns the first failure of a process, with its name.
  std::optional<std::string> Failure() const;
  // Returns what `name` last reported to wait for or to do at that tick; empty for nothing.
  std::string Status(const std::string& name, std::uint64_t tick) const;
  // Returns the processes of the run in the order of `expected`, then the attached visualisers. Only names and
  // processes are set.
  std::vector<ProcessStatus> Processes() const;
  // Returns an expected process that has left, if any has.
  std::optional<std::string> FirstLeft() const;
  // Returns the expected processes that have finished their work since the last call.
  std::vector<std::string> TakeLeft();
  // Returns the expected processes that were silent for the lease since the last call, if others may replace them.
  std::vector<std::string> TakeLost();
  // Returns the replacements that have become ready since the last call, with their incarnations.
  std::vector<std::pair<std::string, std::uint32_t>> TakeReplaced();
  // Another process is about to replace the one of that name. The end of the old process no longer matters.
  void Release(const std::string& name);
  // Returns "host:pid" of the process that now has the name.
  std::string ProcessOf(const std::string& name) const;
  // Returns the machine's name as its launcher calls it; empty if unknown.
  std::string MachineOf(const std::string& name) const;
  // Returns JoinMessage::reach of a host that hears LocalState.
  double ReachOf(const std::string& name) const;
  // Returns the incarnation of the process that now has the name.
  std::uint32_t Incarnation(const std::string& name) const;
  // Returns the requests of recovering processes. Their answer follows.
  std::vector<RecoveryRequestMessage> TakeRecoveryRequests();
  void Answer(const RecoveryBlockMessage& block) { blocks_->Write(block); }
  // Answers the Leaves of processes. The server's own thread must call it repeatedly.
  void AnswerLeaves();
  // Returns the expected processes that have joined and not left.
  std::vector<std::string> NotLeft() const;

  // An earlier server of this run has accepted the request, and answered it unless `waits`. A retried request is not
  // executed again; the stored text is sent. Call it before Open.
  void Remember(const ControlRequestMessage& request, bool waits, const std::string& text);
  // Handles a request as if it had come over the bus. It is executed once, and answered each time.
  void Ask(const ControlRequestMessage& request);
  void Reply(const ControlRequestMessage& request, bool ok, std::uint64_t tick, const std::string& text);
  void LeaveDirectory() { directory_.Leave(); }
  // Stores the path of the run's journal for processes of this machine.
  void AnnounceFolder(const std::string& folder) { directory_.AnnounceFolder(folder); }
  // Leaves because another server resumes the run. Observers wait for that server.
  void LeaveToNext();
  // Tells all processes that the run is over, and why.
  void Leave(std::uint64_t tick, const std::string& error);

private:
  // The recent requests of users, with their answers.
  struct Request
  {
    std::string client;
    std::uint32_t number = 0;
    std::optional<ControlReplyMessage> reply;
  };
  static constexpr std::size_t kRequestsKept = 256;

  // The state that the server's own thread and the threads of the bus share.
  struct State
  {
    ServerMembership membership;
    std::deque<Request> requests_seen{};
    std::vector<RecoveryRequestMessage> recoveries{};

    Request* FindRequest(const ControlRequestMessage& request);
  };

  void Asked(const ControlRequestMessage& request);
  void WriteReply(const ControlReplyMessage& reply);
  void Joined(const JoinMessage& join);
  void MemberLeft(const LeaveMessage& leave);
  void Missed(const std::string& process, bool died);
  void Refuse(const JoinMessage& join, const std::string& reason);
  bool FailedBy(const BadMessageReport& report);

  WorldMessage world_;
  std::vector<std::string> expected_;
  Callbacks callbacks_;
  std::optional<RunKey> key_;
  Guarded<State> state_;
  RunDirectory directory_;
  Bus bus_;
  std::unique_ptr<Publisher<LeaveMessage>> leave_;
  std::unique_ptr<Publisher<ControlReplyMessage>> replies_;
  std::unique_ptr<Publisher<WorldMessage>> worlds_;
  std::unique_ptr<Publisher<RecoveryBlockMessage>> blocks_;
  std::unique_ptr<Subscription<JoinMessage>> joins_;
  std::unique_ptr<Subscription<StatusMessage>> statuses_;
  std::unique_ptr<Subscription<LeaveMessage>> leaves_;
  std::unique_ptr<Subscription<ControlRequestMessage>> requests_;
  std::unique_ptr<Subscription<RecoveryRequestMessage>> recoveries_;
};

}  // namespace swarmanoid

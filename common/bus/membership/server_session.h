// ServerSession: how the space server takes part in a run beside its step. It publishes the world, sends and receives
// for its ServerMembership, which knows the processes, and hears what users ask for. Its step runs in threads of the
// bus.
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
#include "common/bus/membership/run_directory.h"
#include "common/bus/membership/server_membership.h"

namespace swarmanoid
{

class ServerSession
{
public:
  // Called in threads of the bus.
  struct Callbacks
  {
    std::function<void(const ControlRequestMessage&)> asked;
    std::function<void()> changed;                         // somebody joined, failed, left, or is waiting
    std::function<void(const std::string& process)> gone;  // a process has left the bus
    std::function<void(const ControlReplyMessage&)> replied{};
  };

  // `expected`: names of the processes that the run waits for. Throws BusError if an experiment of that name runs in
  // the domain already.
  ServerSession(const BusOptions& options, WorldMessage world, std::vector<std::string> expected, Callbacks callbacks);
  ~ServerSession();
  // From now on a process that dies does not fail the run: another one with a higher incarnation takes its place.
  // Before Open.
  void AwaitReplacements() { state_.Lock()->membership.AwaitReplacements(); }
  // Lets others find the run; the callbacks may be called from now on.
  void Open();
  // For those who have not heard of it.
  void SayWorldAgain();
  // No callback is called any more.
  void Close();

  Bus& GetBus() { return bus_; }
  const WorldMessage& World() const { return world_; }
  // Of the run; none if anybody is let in.
  const std::optional<RunKey>& Key() const { return key_; }
  HotScope Scope(std::size_t capacity, unsigned writers) const;

  // Those that are not ready yet, in the order of `expected`.
  std::vector<std::string> Missing() const;
  // The first failure of a process, with its name.
  std::optional<std::string> Failure() const;
  // What `name` said last that it waits for or is busy with, at that tick; empty for nothing.
  std::string Status(const std::string& name, std::uint64_t tick) const;
  // Those of the run in the order of `expected`, then the visualisers that are attached; names and processes only.
  std::vector<ProcessStatus> Processes() const;
  // One of those expected that has left, if any has.
  std::optional<std::string> FirstLeft() const;
  // Those expected that have said since the last call that their work is done.
  std::vector<std::string> TakeLeft();
  // Those expected that have been silent for the lease since the last call, if others may take their places.
  std::vector<std::string> TakeLost();
  // Those that take the places of others, with their incarnations, and have become ready since the last call.
  std::vector<std::pair<std::string, std::uint32_t>> TakeReplaced();
  // Another process is about to take the place of the one that has the name: nobody cares any more how this one ends.
  void Release(const std::string& name);
  // "host:pid" of the one that has the name now.
  std::string ProcessOf(const std::string& name) const;
  // As whoever started it calls it; empty if nobody said.
  std::string MachineOf(const std::string& name) const;
  // Of a host that hears LocalState: JoinMessage::reach.
  double ReachOf(const std::string& name) const;
  // Of the process that has the name now.
  std::uint32_t Incarnation(const std::string& name) const;
  // What such processes ask for, and the answer.
  std::vector<RecoveryRequestMessage> TakeRecoveryRequests();
  void Answer(const RecoveryBlockMessage& block) { blocks_->Write(block); }
  // Lets those go who said that they leave. To be called again and again by the server's own thread.
  void AnswerLeaves();
  // Those expected that have joined and not left.
  std::vector<std::string> NotLeft() const;

  // Before Open: a server of this run before this one has taken the request, and answered it unless `waits`. Whoever
  // repeats it is not taken for somebody who asks anew, and is told the text.
  void Remember(const ControlRequestMessage& request, bool waits, const std::string& text);
  // As if it had come over the bus: done once, and answered each time.
  void Ask(const ControlRequestMessage& request);
  void Reply(const ControlRequestMessage& request, bool ok, std::uint64_t tick, const std::string& text);
  void LeaveDirectory() { directory_.Leave(); }
  // Where the run keeps its journal, for processes of this machine.
  void AnnounceFolder(const std::string& folder) { directory_.AnnounceFolder(folder); }
  // The run is over, and begins again with another server: observers wait for that one.
  void LeaveToNext();
  // Tells all that the run is over, and why.
  void Leave(std::uint64_t tick, const std::string& error);

private:
  // What users asked for of late, with the answers that they got.
  struct Request
  {
    std::string client;
    std::uint32_t number = 0;
    std::optional<ControlReplyMessage> reply;
  };
  static constexpr std::size_t kRequestsKept = 256;

  // What the threads of the bus and the server's own share.
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

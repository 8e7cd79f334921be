// Access grants: the space server's part for observers and users who steer the run without being members
// (access_grant.h). Each grant has topics and a key of its own. Only this class connects them with the topics of the
// run, and it checks each message of a holder before the run gets it. Members make and revoke grants by requests.
// Threads of the bus deliver requests and replies; the main thread of the space_server program calls all other
// functions.
#pragma once

#include <atomic>
#include <chrono>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "common/bus/membership/server_session.h"
#include "common/run/access/access_grant.h"
#include "common/threads/waiting.h"
#include "space_server/event_log.h"

namespace swarmanoid
{

class AccessGrants
{
public:
  using Clock = RunClock;

  // Any thread may call these.
  struct Callbacks
  {
    std::function<void(const ViewRequestMessage&)> view_requested;
    std::function<void(const ControlRequestMessage&)> noted;  // for the log of events
    std::function<void()> woken;                              // wakes the main thread, since Work has something to do
  };

  AccessGrants(ServerSession& session, const BusOptions& options, Callbacks callbacks);
  ~AccessGrants() { Stop(); }
  // Ends all callbacks.
  void Stop();

  // The orders that made the grants of an earlier server of this run. Before Work.
  void Restore(const std::vector<ControlOrder>& grants);
  // Takes a request of a member whose verb is of Asker::kOwner. Any thread may call it.
  void Ask(const ControlRequestMessage& request);
  // Sends the reply to a request to all observers. Any thread may call it.
  void Replied(const ControlReplyMessage& reply);

  // Opens, answers and ends grants as far as that is due.
  void Work(std::uint64_t tick);
  unsigned ViewReaders() const;
  unsigned StatusReaders() const;
  void Write(const ViewMessage& view);
  void Write(const RunStatusMessage& status);
  // Tells the holders of all grants that the run is over.
  void Leave(std::uint64_t tick, const std::string& error, double patience_s);

private:
  // Each grant has one side. When it has ended only its requests are heard, to be refused.
  struct Side
  {
    AccessGrant grant{};
    std::string by{};     // the member that made it
    std::string ended{};  // why the grant has ended; empty if it has not
    bool told = false;    // whether its first refusal was reported
    bool is_new = true;
    std::atomic<bool> is_over = false;  // it has ended: no view is requested for it any more
    std::optional<GrantChannel> channel{};
    std::unique_ptr<Publisher<WorldMessage>> worlds{};
    std::unique_ptr<Publisher<ViewMessage>> views{};
    std::unique_ptr<Publisher<RunStatusMessage>> statuses{};
    std::unique_ptr<Publisher<RobotStatusMessage>> robots{};
    std::unique_ptr<Publisher<ControlReplyMessage>> replies{};
    std::unique_ptr<Publisher<LeaveMessage>> leave{};
    std::unique_ptr<Subscription<ControlRequestMessage>> requests{};
    std::unique_ptr<Subscription<ViewRequestMessage>> view_requests{};
    std::unique_ptr<Subscription<LeaveMessage>> leaves{};
  };
  template <class Message>
  struct Heard
  {
    std::string grant;
    Message message;
  };
  struct Watched
  {
    std::vector<std::uint32_t> robots;
    Clock::time_point heard;
  };
  // Messages that threads of the bus left for the main thread. Guarded by mutex_.
  struct Inbox
  {
    std::deque<ControlRequestMessage> of_members;
    std::deque<Heard<ControlRequestMessage>> requests;
    std::deque<Heard<LeaveMessage>> leaves;
    std::deque<ControlReplyMessage> replies;
    std::map<std::uint32_t, RobotStatusMessage> robots;  // by host
  };

  void Add(const AccessGrant& grant, const std::string& by);
  void Open(Side& side);
  void TryToOpen(Side& side, std::uint64_t tick);
  void End(Side& side, std::uint64_t tick, const std::string& why);
  // Deletes the endpoints that ended grants do not need, and the oldest ended grants.
  void Tidy();
  // Each verb has an action. It returns the reply, and throws std::invalid_argument with the reason if the request is
  // refused.
  using Action = std::string (AccessGrants::*)(const ControlRequestMessage& request, std::uint64_t tick);
  static Action ActionOf(const std::string& verb);

  void Execute(const ControlRequestMessage& request, std::uint64_t tick);
  std::string Make(const ControlRequestMessage& request, std::uint64_t tick);
  std::string List(const ControlRequestMessage& request, std::uint64_t tick);
  std::string Revoke(const ControlRequestMessage& request, std::uint64_t tick);
  // Hands the request of a holder on to the run, if the grant allows it.
  void Forward(Side& side, ControlRequestMessage request, std::uint64_t tick);
  void Refuse(Side& side, const ControlRequestMessage& request, std::uint64_t tick, const std::string& why);
  void ViewRequested(const Side& side, const ViewRequestMessage& request);
  void RenewRobots(Clock::time_point now);
  Side* Find(const std::string& id);
  template <class Message>
  void Keep(std::deque<Heard<Message>>& queue, const std::string& grant, const Message& message);

  ServerSession& session_;
  const BusOptions& options_;
  Callbacks callbacks_;
  std::vector<std::unique_ptr<Side>> sides_;
  std::atomic<unsigned> open_ = 0;  // number of open sides

  std::mutex mutex_;  // guards the members down to stopped_
  Inbox inbox_;
  std::deque<std::pair<std::string, std::uint32_t>> of_members_;  // requests about grants, by client and number
  std::map<std::string, Watched> watched_;                        // robots by client
  bool watched_changed_ = false;
  bool stopped_ = false;

  // Holders of grants get the inside of robots by these topics. They are made when one first asks for it.
  std::unique_ptr<Publisher<ViewRequestMessage>> robots_wanted_;
  std::unique_ptr<Subscription<RobotStatusMessage>> robots_in_;
  Clock::time_point robots_requested_;
};

}  // namespace swarmanoid

// ViewPublisher: sends views to observers outside the run. They get the whole state at the rate that they ask for, and
// the status of the run. They never slow the run. Requests come in threads of the bus; the main thread of the
// space_server program calls all other functions.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "common/bus/membership/server_session.h"
#include "common/threads/waiting.h"
#include "space_server/cluster/access_grants.h"

namespace swarmanoid
{

class ViewPublisher
{
public:
  using Clock = RunClock;

  // `woken` is called in a thread of the bus when the requested rate changes. Holders of grants get the same views.
  ViewPublisher(ServerSession& session, AccessGrants& grants, std::function<void()> woken);
  ~ViewPublisher();

  // Returns the number of readers of views.
  unsigned Viewers() const { return views_.Readers() + grants_.ViewReaders(); }
  // Returns true if a view is due. The first one is due when an observer has joined. Later ones come at the requested
  // rate during ticks, and for some seconds after a join or a reply.
  bool ViewIsDue(std::uint64_t tick, Clock::time_point now);
  void SendView(SpaceSnapshot& snapshot, Clock::time_point now);
  // Makes a view due after a reply: the state may have changed at the same tick, and the client waits for it. Any
  // thread may call it.
  void Renew() { changed_ = true; }

  // Returns true if a status is due. `phase` is the current phase.
  bool StatusIsDue(RunStatus::Phase phase, Clock::time_point now);
  void SendStatus(const RunStatus& status, Clock::time_point now);

  // The latest view and status were read by all observers, or that time is over.
  void WaitUntilRead(double seconds);

  // Returns the next time, later than `now`, at which a view or a status may be due.
  Clock::time_point Next(Clock::time_point now) const;
  // Takes the rate that a client asks for. Any thread may call it.
  void Requested(const ViewRequestMessage& request);
  // A process is lost or has left, so its requests end.
  void Lost(const std::string& process);

private:
  struct Request
  {
    double views = 0;
    Clock::time_point heard;
  };

  Clock::duration ViewPeriod(Clock::time_point now) const;
  bool TakeAskedFirst();

  ServerSession& session_;
  AccessGrants& grants_;
  std::function<void()> woken_;
  mutable std::mutex mutex_;                 // guards requests_ and asked_first_
  std::map<std::string, Request> requests_;  // by client
  bool asked_first_ = false;                 // a new client has asked since the last check

  Publisher<ViewMessage> views_;
  ViewMessage view_;
  std::atomic<bool> changed_ = false;
  unsigned viewers_ = 0;
  std::uint64_t viewed_tick_ = 0;
  Clock::time_point viewed_;
  Clock::time_point repeats_until_;  // until then an unchanged state is sent again
  int views_left_ = 0;               // at least as many views are still to be sent
  Clock::duration shortest_period_{};

  Publisher<RunStatusMessage> statuses_;
  RunStatusMessage status_;
  unsigned status_readers_ = 0;
  RunStatus::Phase said_phase_ = RunStatus::Phase::kUnknown;
  Clock::time_point said_;

  std::unique_ptr<Subscription<ViewRequestMessage>> requests_in_;
};

}  // namespace swarmanoid

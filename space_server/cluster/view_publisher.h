// ViewPublisher: sends views to those who watch the run from outside it. They get the whole state at the pace that they
// ask for, and how the run goes; they never slow it. Requests come in threads of the bus; all else is called by the
// main thread of the space_server program.
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

  // `woken`: called in a thread of the bus when somebody asks for something else. Holders of grants get the same.
  ViewPublisher(ServerSession& session, AccessGrants& grants, std::function<void()> woken);
  ~ViewPublisher();

  // Views. One is due when somebody has come; then, at the pace that is asked for, while ticks pass, and for some
  // seconds after somebody came or was answered.
  bool ViewIsDue(std::uint64_t tick, Clock::time_point now);
  void SendView(SpaceSnapshot& snapshot, Clock::time_point now);
  // In any thread: a request was answered. The state may have changed though the tick is the same, and whoever asked
  // waits for a view that is newer than the answer.
  void Renew() { changed_ = true; }

  // RunStatus. `phase`: as it would be told.
  bool StatusIsDue(RunStatus::Phase phase, Clock::time_point now);
  void SendStatus(const RunStatus& status, Clock::time_point now);

  // The latest view and status were read by all observers, or that time is over.
  void WaitUntilRead(double seconds);

  // When one of them may be due.
  Clock::time_point Next() const;
  // In any thread: somebody wants views.
  void Requested(const ViewRequestMessage& request);
  // A process is lost or has left.
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
  mutable std::mutex mutex_;
  std::map<std::string, Request> requests_;  // by client
  bool asked_first_ = false;                 // somebody has, since the last look

  Publisher<ViewMessage> views_;
  ViewMessage view_;
  std::atomic<bool> changed_ = false;
  unsigned viewers_ = 0;
  std::uint64_t viewed_tick_ = 0;
  Clock::time_point viewed_;
  Clock::time_point repeats_until_;  // of a state that does not change
  int views_left_ = 0;               // at least
  Clock::duration shortest_period_{};

  Publisher<RunStatusMessage> statuses_;
  RunStatusMessage status_;
  unsigned status_readers_ = 0;
  RunStatus::Phase said_phase_ = RunStatus::Phase::kUnknown;
  Clock::time_point said_;

  std::unique_ptr<Subscription<ViewRequestMessage>> requests_in_;
};

}  // namespace swarmanoid

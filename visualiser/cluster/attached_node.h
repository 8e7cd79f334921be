// A visualiser that is attached to a run from outside. It draws the newest state whenever it has time. The main thread
// draws; a thread of the bus receives the states.
#pragma once

#include <atomic>
#include <chrono>
#include <mutex>

#include "common/bus/membership/worker_session.h"
#include "common/bus/membership/worker_world.h"
#include "visualiser/cluster/remote_monitor.h"
#include "visualiser/visualiser.h"

namespace swarmanoid
{

class AttachedNode
{
public:
  // `rate` limits the pictures drawn in a second.
  AttachedNode(WorkerSession& session, WorkerWorld& replica, Visualiser& visualiser, RemoteMonitor& monitor,
               double rate);

  // The main thread calls it when a state has come, and periodically.
  void Work();
  // Follows another server that continues the run, under this number.
  void FollowRun(std::uint64_t run) { run_ = run; }
  // Returns true if the user closed the visualiser, false if the run has ended.
  bool Terminated() const { return terminated_; }

private:
  using Clock = std::chrono::steady_clock;

  WorkerSession& session_;
  WorkerWorld& replica_;
  Visualiser& visualiser_;
  RemoteMonitor& monitor_;
  Clock::duration period_;
  std::atomic<std::uint64_t> run_;  // threads of the bus read it
  Clock::time_point drawn_{};
  bool terminated_ = false;
  std::mutex mutex_;  // guards snapshot_ and fresh_, which a thread of the bus writes
  SpaceSnapshot snapshot_;
  bool fresh_ = false;
  Subscription<ViewMessage> views_in_;
};

}  // namespace swarmanoid

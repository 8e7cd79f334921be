// A visualisation of the experiment file on the bus. It draws every tick and reports that it did. The main thread
// draws; threads of the bus receive the states.
#pragma once

#include <memory>
#include <mutex>

#include "common/bus/membership/worker_session.h"
#include "common/bus/membership/worker_world.h"
#include "visualiser/cluster/remote_monitor.h"
#include "visualiser/visualiser.h"

namespace swarmanoid
{

class SynchronousNode
{
public:
  SynchronousNode(WorkerSession& session, WorkerWorld& replica, std::size_t number, Visualiser& visualiser,
                  ExperimentControl& control, RemoteMonitor& monitor, std::uint64_t first_tick);

  void WaitForServer();
  // The main thread calls it when a state has come, and periodically.
  void Work();

private:
  SpaceState* PlaceOfState(const MessageHeader& header);
  void StateArrived(const MessageHeader& header, SpaceState& state);
  void Idle();
  void ShowHeldState();

  WorkerSession& session_;
  WorkerWorld& replica_;
  std::uint32_t number_;
  Visualiser& visualiser_;
  ExperimentControl& control_;
  RemoteMonitor& monitor_;
  std::mutex mutex_;  // guards the members below; the main thread alone uses answer_.terminate while fresh_
  SpaceState state_;
  SpaceState repeated_;
  bool fresh_ = false;  // state_ is not drawn yet
  bool finished_ = false;
  std::uint64_t next_;
  DrawnMessage answer_;
  SpaceSnapshot held_;  // the state that the paused run holds back, including moved entities
  bool held_fresh_ = false;
  std::unique_ptr<Subscription<ViewMessage>> views_in_;  // while the run is paused
  HotPublisher<DrawnMessage> drawn_;
  HotSubscription<SpaceState> states_in_;
};

}  // namespace swarmanoid

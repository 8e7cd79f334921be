// RobotInspection: sends visualisers the inside of the robots that they watch, after the commands of a tick are sent.
// Without visualisers it costs one test of a flag. Used by the controller_host program; requests come in threads of the
// bus.
#pragma once

#include <memory>
#include <mutex>

#include "common/bus/membership/worker_session.h"
#include "controller_host/controller_host.h"
#include "controller_host/watched_robots.h"

namespace swarmanoid
{

class RobotInspection
{
public:
  // `step` is held while the host steps. The object locks it too, since a visualiser may ask while the run is paused.
  RobotInspection(WorkerSession& session, const ControllerHost& role, std::uint32_t host, std::mutex& step);
  ~RobotInspection();

  // A step is done and sent. The caller holds `step`.
  void Stepped()
  {
    if (watched_.AreAny()) Publish(false);
  }

private:
  void Requested(const ViewRequestMessage& request);
  // The caller holds `step`.
  void Publish(bool at_once);

  WorkerSession& session_;
  const ControllerHost& role_;
  std::mutex& step_;
  WatchedRobots watched_;
  RobotStatusMessage message_;  // guarded by step_
  Publisher<RobotStatusMessage> statuses_;
  std::unique_ptr<Subscription<ViewRequestMessage>> requests_in_;
};

}  // namespace swarmanoid

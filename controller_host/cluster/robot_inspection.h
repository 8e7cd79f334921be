// RobotInspection: sends visualisers the inside of the robots that they watch, after the commands of a tick are sent.
// Without visualisers it costs one test of a flag. Used by the controller_host program; requests come in threads of the
// bus.
#pragma once

#include <atomic>
#include <chrono>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "common/bus/membership/worker_session.h"
#include "controller_host/controller_host.h"

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
    if (watched_) Publish();
  }

private:
  using Clock = std::chrono::steady_clock;
  struct Request
  {
    std::vector<std::uint32_t> robots;
    bool every_tick = false;
    Clock::time_point heard;
  };

  void Requested(const ViewRequestMessage& request);
  // Collects the robots that all visualisers together ask for.
  void Collect(Clock::time_point now);
  void Publish();
  void Send(Clock::time_point now);

  WorkerSession& session_;
  const ControllerHost& role_;
  std::mutex& step_;
  std::atomic<bool> watched_ = false;

  std::mutex mutex_;  // guards the members below; taken after step_ if both are needed
  std::map<std::string, Request> requests_;
  std::vector<std::uint32_t> robots_;  // of this host, ascending
  bool every_tick_ = false;
  Clock::time_point collected_;
  Clock::time_point sent_;
  RobotStatusMessage message_;
  Publisher<RobotStatusMessage> statuses_;
  std::unique_ptr<Subscription<ViewRequestMessage>> requests_in_;
};

}  // namespace swarmanoid

// Steering: controls a run in one process. It carries out users' requests from visualisations between two ticks, as the
// space server does in a cluster, and gives visualisations the status of the run. CSimulator uses it, in one thread.
#pragma once

#include <atomic>
#include <chrono>
#include <map>
#include <memory>
#include <vector>

#include "controller_host/controller_host.h"
#include "simulation/run_link.h"
#include "space_server/pace_meter.h"
#include "space_server/run_control.h"
#include "visualiser/control_by_requests.h"
#include "visualiser/visualiser.h"

namespace swarmanoid
{

class Steering : public RunMonitor
{
public:
  // `stop`: see SimulatorOptions. The references must outlive the object.
  Steering(const Experiment& experiment, SpaceServer& server, RunControlSetup setup, const std::atomic<bool>* stop);
  ~Steering() override
  {
    if (link_ != nullptr) link_->Detach();
  }
  Steering(const Steering&) = delete;
  Steering& operator=(const Steering&) = delete;

  ExperimentControl& Control() { return control_; }
  // Sets the controller host whose robots can be watched.
  void SetHost(const ControllerHost& host) { host_ = &host; }
  // Lets users outside of this process watch and steer the run, once the host is set. Call it before WaitForGo.
  void Open(RunLink& link, const Assignment& assignment);

  // Returns when the state of the space's tick may be shown and stepped. It waits while the run is paused or ahead of
  // its pace, and carries out requests meanwhile. Visualisers stay responsive. A request for the end makes the tick the
  // last one.
  void WaitForGo(const std::vector<std::unique_ptr<Visualiser>>& visualisers);
  // Records that a visualiser asked for the end after the tick was shown.
  void Stopped(const std::string& visualiser);
  void Ended();
  // Sends users outside of this process the last state.
  void CloseLink();
  const std::optional<ResetRequest>& Reset() const { return run_control_.Reset(); }
  bool Interrupted() const { return stop_ != nullptr && *stop_; }

  const RunStatus& Status() override;
  std::span<const RunNote> Notes() override { return notes_; }
  void Watch(std::span<const std::uint32_t> robots) override { watched_.assign(robots.begin(), robots.end()); }
  const RobotStatus* Robot(std::uint32_t robot) override;

private:
  using Clock = RunControl::Clock;

  void Answer(const ControlRequestMessage& request, bool done, std::uint64_t tick, const std::string& text);

  SpaceServer& server_;
  const ControllerHost* host_ = nullptr;
  RunLink* link_ = nullptr;  // nullptr if no other process can find the run
  const std::atomic<bool>* stop_;
  RunControl run_control_;
  ControlByRequests control_;
  PaceMeter pace_;
  bool started_ = false;
  std::uint64_t until_ = 0;
  bool ended_ = false;
  RunStatus status_;
  std::vector<RunNote> notes_;
  std::vector<std::uint32_t> watched_;
  std::map<std::uint32_t, RobotStatus> robots_;
};

}  // namespace swarmanoid

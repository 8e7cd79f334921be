// RunOnBus: lets users attach visualisers to a run in one process, steer it and grant access to it, as to a cluster. It
// is the part of a space server that observers know: the announcement of the run, views, the status, the inside of
// robots, and replies. The run never waits for them. Runs with loop functions of ARGoS3 use it.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "common/bus/bus.h"
#include "launcher/supervision/prepared_run.h"
#include "simulation/run_link.h"

namespace swarmanoid
{

class RunOnBus : public RunLink
{
public:
  // `run` has a domain, and must outlive the object. Without a key every process in the domain may take part.
  RunOnBus(const PreparedRun& run, const std::optional<RunKey>& key);
  ~RunOnBus() override;

  void Open(const Roles& roles) override;
  bool IsOpen() const override { return parts_ != nullptr; }
  void Publish(RunMonitor& run) override;
  void Reply(const ControlRequestMessage& request, bool done, std::uint64_t tick, const std::string& text) override;
  std::vector<ProcessStatus> Attached() const override;
  void Detach() override;
  void Close(RunMonitor& run, bool begins_again) override;
  void Fail(const std::string& why) override;

private:
  struct Parts;

  // Threads of the bus call these.
  void Ask(const ControlRequestMessage& request);
  void Note(const ControlRequestMessage& note);
  void Send(RunMonitor& run, bool last);
  void SendRobots(bool at_once);
  // Runs code of the bus, whose errors must not end the run. They are reported once.
  void Try(const std::function<void()>& code);

  const PreparedRun& run_;
  BusOptions options_;
  std::mutex mutex_;            // guards roles_ from threads of the bus
  std::optional<Roles> roles_;  // set while the run exists
  std::uint64_t tick_ = 0;
  bool has_complained_ = false;
  std::atomic<bool> woken_ = true;        // threads of the bus set it
  std::atomic<bool> robots_due_ = false;  // as well
  std::chrono::steady_clock::time_point due_{};
  std::unique_ptr<Parts> parts_;  // nullptr if no program can attach
};

}  // namespace swarmanoid

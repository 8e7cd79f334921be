// ReplayMonitor: what a visualiser knows about a run that is read from its journal. The journal has nothing of the
// inside of robots.
#pragma once

#include "common/space/space.h"
#include "simulation/playback/recorded_run.h"
#include "visualiser/render.h"

namespace swarmanoid
{

class ReplayMonitor : public RunMonitor
{
public:
  // The run must outlive the object. `speed`: the wanted multiple of real time.
  ReplayMonitor(const RecordedRun& run, double speed) : run_(run)
  {
    status_.phase = RunStatus::Phase::kRunning;
    status_.speed_wanted = speed;
  }

  const RunStatus& Status() override
  {
    status_.tick = run_.Space().GetTick();
    return status_;
  }
  std::span<const RunNote> Notes() override { return {}; }
  void Watch(std::span<const std::uint32_t>) override {}
  const RobotStatus* Robot(std::uint32_t) override { return nullptr; }
  std::string RunFolder() override { return run_.Folder(); }
  void Ended() { status_.phase = RunStatus::Phase::kFinished; }

private:
  const RecordedRun& run_;
  RunStatus status_;
};

}  // namespace swarmanoid

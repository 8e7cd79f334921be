// ReplayMonitor: what a visualiser knows about a run that is read from its journal. The journal has nothing of the
// inside of robots.
#pragma once

#include <chrono>

#include "common/space/space.h"
#include "simulation/playback/recorded_run.h"
#include "space_server/pace_meter.h"
#include "visualiser/render.h"

namespace swarmanoid
{

class ReplayMonitor : public RunMonitor
{
public:
  using Clock = PaceMeter::Clock;

  // The run must outlive the object.
  explicit ReplayMonitor(const RecordedRun& run) : run_(run), pace_(run.GetExperiment().TickSeconds())
  {
    status_.phase = RunStatus::Phase::kRunning;
  }

  const RunStatus& Status() override
  {
    status_.tick = run_.Space().GetTick();
    return status_;
  }
  // Call it after each tick. `speed`: the wanted multiple of real time; 0: as fast as possible.
  void Shown(double speed, Clock::time_point now)
  {
    pace_.Observe(run_.Space().GetTick(), now);
    status_.speed_wanted = speed;
    status_.real_time_factor = pace_.RealTimeFactor();
    status_.ticks_per_second = pace_.TicksPerSecond();
  }
  std::span<const RunNote> Notes() override { return {}; }
  void Watch(std::span<const std::uint32_t>) override {}
  const RobotStatus* Robot(std::uint32_t) override { return nullptr; }
  std::string RunFolder() override { return run_.Folder(); }
  void Ended() { status_.phase = RunStatus::Phase::kFinished; }

private:
  const RecordedRun& run_;
  PaceMeter pace_;
  RunStatus status_;
};

}  // namespace swarmanoid

#include "simulation/single_process.h"

#include <chrono>

#include "common/space/space.h"

namespace swarmanoid
{

RunSummary RunSingleProcess(const Experiment& experiment, const SingleProcessOptions& options)
{
  using Clock = std::chrono::steady_clock;

  CSimulator simulator = WatchedSimulator::Running(experiment, options, options.companions);
  Clock::time_point reported = Clock::now();
  while (simulator.Step())
  {
    const std::uint64_t tick = simulator.GetSpace().GetTick();
    if (options.progress && (tick & 15U) == 0 && Clock::now() - reported >= std::chrono::milliseconds(100))
    {
      reported = Clock::now();
      options.progress(tick);
    }
  }
  return simulator.Finish();
}

}  // namespace swarmanoid

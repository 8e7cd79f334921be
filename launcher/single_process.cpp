#include "launcher/single_process.h"

#include <chrono>

namespace swarmanoid
{

RunSummary RunSingleProcess(const Experiment& experiment, const SingleProcessOptions& options)
{
  using Clock = std::chrono::steady_clock;

  CSimulator simulator(experiment, options);
  if (options.watch) options.watch(simulator);
  Clock::time_point reported = Clock::now();
  while (simulator.Step())
  {
    if (options.watch) options.watch(simulator);
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

// Runs a whole experiment in one process with CSimulator, from the first tick to the last, and reports the progress.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "simulation/watched_simulator.h"

namespace swarmanoid
{

struct SingleProcessOptions : SimulatorOptions
{
  // Its watch function is called at each tick from the first one on, before the state of the tick is written or drawn.
  RunCompanions companions;
  // It is called at most ten times a second with the tick just finished.
  std::function<void(std::uint64_t tick)> progress;
};

// Throws the exceptions of CSimulator.
RunSummary RunSingleProcess(const Experiment& experiment, const SingleProcessOptions& options);

}  // namespace swarmanoid

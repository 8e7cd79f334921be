// A whole run in one process, from the first tick to the last: CSimulator, with someone told how far it is.
#pragma once

#include <cstdint>
#include <functional>

#include "simulation/simulator.h"

namespace swarmanoid
{

struct SingleProcessOptions : SimulatorOptions
{
  // Called at each tick from the first one on, before its state is written or drawn.
  std::function<void(CSimulator&)> watch;
  // Called now and then (at most ten times a second) with the tick just finished.
  std::function<void(std::uint64_t tick)> progress;
};

// Throws as CSimulator.
RunSummary RunSingleProcess(const Experiment& experiment, const SingleProcessOptions& options);

}  // namespace swarmanoid

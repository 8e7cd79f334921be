// Runs a whole experiment in one process with CSimulator, from the first tick to the last, and reports the progress.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "simulation/simulator.h"

namespace swarmanoid
{

struct SingleProcessOptions : SimulatorOptions
{
  // It is called at each tick from the first one on, before the state of the tick is written or drawn.
  std::function<void(CSimulator&)> watch;
  // It is called at most ten times a second with the tick just finished.
  std::function<void(std::uint64_t tick)> progress;
  std::string journal_file;  // empty: none
};

// Throws the exceptions of CSimulator.
RunSummary RunSingleProcess(const Experiment& experiment, const SingleProcessOptions& options);

}  // namespace swarmanoid

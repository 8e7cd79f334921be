// What surrounds a run, however it is run: reading the experiment, its folder, the manifest, the last line, the exit
// code.
#pragma once

#include "launcher/single_run.h"
#include "simulation/watched_simulator.h"

namespace swarmanoid
{

// Runs an experiment, in this process or as a cluster, and tells the user how it went. `watch`, if there is one, is
// called at each tick. Returns the exit code. Throws UsageError.
int RunExperiment(const RunSettings& options, const WatchFunction& watch = {});

}  // namespace swarmanoid

// A run as a cluster of processes, supervised from here.
#pragma once

#include "launcher/single_run.h"
#include "launcher/watched_simulator.h"

namespace swarmanoid
{

// With a `watch`, the space server is this process, and calls it in this thread at each tick.
// Adds the domain and the processes to the manifest, and writes it. Throws UsageError.
RunResult RunCluster(const RunSettings& options, const Experiment& experiment, const RunFolder& folder,
                     Manifest& manifest, const WatchFunction& watch);

}  // namespace swarmanoid

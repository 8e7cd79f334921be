// A run as a cluster of processes, supervised from here.
#pragma once

#include "launcher/single_run.h"

namespace swarmanoid
{

// Adds the domain and the processes to the manifest, and writes it. Throws UsageError.
RunResult RunCluster(const RunSettings& options, const Experiment& experiment, const RunFolder& folder,
                     Manifest& manifest);

}  // namespace swarmanoid

// A run from the request to the exit code, in this process or as a cluster: reads the experiment, makes the folder and
// the manifest, runs, and writes the last line.
#pragma once

#include "launcher/supervision/run_request.h"

namespace swarmanoid
{

// Returns the exit code. Throws UsageError.
int RunExperiment(RunRequest request);

}  // namespace swarmanoid

// A run in this process, with progress and Ctrl-C.
#pragma once

#include "launcher/prepared_run.h"

namespace swarmanoid
{

// From now on users' code in this process runs within the limits of the settings, and slow code is reported.
void ApplyLimitsHere(const RunSettings& settings);

RunResult RunHere(const PreparedRun& prepared);

}  // namespace swarmanoid

// Runs an experiment in this process, with progress and Ctrl-C.
#pragma once

#include "launcher/supervision/prepared_run.h"

namespace swarmanoid
{

// From now on users' code in this process runs within the limits of the settings, and slow code is reported.
void ApplyLimitsHere(const RunSettings& settings);

// Returns whether an experiment has loop functions of ARGoS3, which need one process.
bool HasLoopFunctions(const Experiment& experiment);

class RunLink;

// `link`: by which users outside of this process watch and steer the run; nullptr: they cannot.
RunResult RunHere(const PreparedRun& prepared, RunLink* link = nullptr);

}  // namespace swarmanoid

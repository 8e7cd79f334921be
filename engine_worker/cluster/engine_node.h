// The engine worker's role at the bus: a process that runs one engine of an experiment, or one region of an engine that
// is split.
#pragma once

#include "common/bus/membership/worker_program.h"

namespace swarmanoid
{

// The whole part of the process in a run. Returns the exit code. Throws std::exception if the process fails by itself.
int RunEngineWorker(const WorkerSettings& settings, const BusOptions& bus);

}  // namespace swarmanoid

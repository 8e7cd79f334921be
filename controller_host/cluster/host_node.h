// The controller host's role at the bus: a process that runs the controllers of some robots of an experiment.
#pragma once

#include "common/bus/membership/worker_program.h"

namespace swarmanoid
{

// The whole part of the process in a run. Returns the exit code. Throws std::exception if the process fails by itself.
int RunControllerHost(const WorkerSettings& settings, const BusOptions& bus);

}  // namespace swarmanoid

// The options of a run that any program may offer which runs an experiment: `swarmanoid run` and the simulation
// programs of users.
#pragma once

#include "common/experiment/load_experiment.h"
#include "launcher/run_options.h"

namespace CLI
{
class App;
}

namespace swarmanoid
{

// EXPERIMENT and the options that a run in a single process knows.
void AddRunOptions(CLI::App& app, RunOptions& options);
// What the options change in the experiment, as settings. Throws UsageError.
LoadOptions ChangesOf(const RunOptions& options);

}  // namespace swarmanoid

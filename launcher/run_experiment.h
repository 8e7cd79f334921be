// What surrounds a run, however it is run: reading the experiment, its folder, the manifest, the last line, the exit
// code.
#pragma once

#include <functional>

#include "launcher/single_run.h"

namespace swarmanoid
{

// Runs an experiment and tells the user how it went; `execute` may add to the manifest. Returns the exit code. Throws
// UsageError.
int RunExperiment(const RunSettings& options,
                  const std::function<RunResult(const Experiment&, const RunFolder&, Manifest&)>& execute);

}  // namespace swarmanoid

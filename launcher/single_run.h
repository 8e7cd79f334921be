// A run in this process, with progress and Ctrl-C.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "common/run/run_settings.h"
#include "simulation/run_folder.h"
#include "simulation/single_process.h"

namespace swarmanoid
{

// How a run ended, whichever way it was run.
struct RunResult
{
  int exit_code = 0;
  std::optional<RunSummary> summary;  // if there is a final state
  std::string failure;                // as shown on standard error
};

// From now on the code of users in this process runs within the limits of the settings; one that takes long is told.
void ApplyLimitsHere(const RunSettings& options);

// `watch`: as in SingleProcessOptions.
RunResult RunHere(const RunSettings& options, const Experiment& experiment, const RunFolder& folder,
                  const std::function<void(CSimulator&)>& watch = {});

}  // namespace swarmanoid

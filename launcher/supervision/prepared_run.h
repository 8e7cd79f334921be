// A run between its preparation and its end, in this process or as a cluster.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "common/experiment/experiment.h"
#include "common/run/run_summary.h"
#include "launcher/supervision/run_request.h"
#include "simulation/run_folder.h"

namespace swarmanoid
{

// A run whose folder exists. Its `request` has this folder as output folder and, for a cluster, the domain.
struct PreparedRun
{
  RunRequest request;
  std::unique_ptr<const Experiment> experiment;  // null once the processes of a cluster run
  RunFolder folder;
  Manifest manifest;
};

struct RunResult
{
  int exit_code = 0;
  std::optional<RunSummary> summary;  // if there is a final state
  std::string failure;                // as shown on standard error
};

}  // namespace swarmanoid

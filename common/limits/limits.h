// The limits of users' code: the memory of a process and the time of a step. `swarmanoid run` sets them by options.
// Processes of a cluster and programs started by hand get them by the environment.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/limits/step_timeout.h"

namespace swarmanoid
{

struct Limits
{
  std::uint64_t memory_bytes = 0;  // for each process; 0: DefaultMemoryLimit
  double step_s = 0;               // wall-clock time; 0: no limit
};

// Returns names and values of the environment for the processes of a cluster.
std::vector<std::pair<std::string, std::string>> EnvironmentOf(const Limits& limits);
// Reads the limits from the environment. A text that is no number means no limit.
Limits LimitsOfEnvironment();

// Applies the limits until the process ends; later calls do nothing. `stalled` as in StepTimeout::Settings.
void ApplyLimits(const Limits& limits, std::function<void(const std::string& activity, double seconds)> stalled = {});

}  // namespace swarmanoid

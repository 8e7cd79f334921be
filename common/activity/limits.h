// The limits of the code of users: how much memory a process may take, how long a step may. `swarmanoid run` sets them
// by options; the processes of a cluster, and programs that are started by hand, get them by the environment.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/activity/step_timeout.h"

namespace swarmanoid
{

struct Limits
{
  std::uint64_t memory_bytes = 0;  // of a process; 0: DefaultMemoryLimit
  double step_s = 0;               // wall-clock time; 0: no limit
};

// Names and values, for the processes of a cluster.
std::vector<std::pair<std::string, std::string>> EnvironmentOf(const Limits& limits);
// From the environment; what is no number there is taken for no limit.
Limits LimitsOfEnvironment();

// From now on, as long as the process lives; later calls do nothing. `stalled` as in StepTimeout::Settings.
void ApplyLimits(const Limits& limits, std::function<void(const std::string& activity, double seconds)> stalled = {});

}  // namespace swarmanoid

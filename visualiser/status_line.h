// The status of a run in one line for people. The renderers share it.
#pragma once

#include <string>

#include "common/messages/run_status.h"

namespace swarmanoid
{

// Returns "running", "paused", "waiting", "finished" or "unknown".
std::string_view PhaseName(RunStatus::Phase phase);

// Returns a line such as "tick 120, running, 12.5x real time (wanted: 20x), 125 ticks/s; late: controller host 1 (2.1
// s, runs the controller of fb_3)".
std::string StatusLine(const RunStatus& status);

}  // namespace swarmanoid

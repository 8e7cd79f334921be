// How a run goes, in one line for people. Shared by the renderers.
#pragma once

#include <string>

#include "common/messages/run_status.h"

namespace swarmanoid
{

// "running", "paused", "waiting", "finished", "unknown".
std::string_view PhaseName(RunStatus::Phase phase);

// "tick 120, running, 12.5x real time (wanted: 20x), 125 ticks/s; late: controller host 1 (2.1 s, runs the controller
// of fb_3)".
std::string StatusLine(const RunStatus& status);

}  // namespace swarmanoid

// The inside of Activity, for the sources of this folder.
#pragma once

#include "common/activity/activity.h"
#include "common/activity/line_writer.h"

namespace swarmanoid::activity
{

// Safe in signal handlers; the actor may be one that goes in the same moment, but never one that has gone.
struct Current
{
  const Actor* actor = nullptr;  // nullptr: nobody's code runs
  ActivityStep step = ActivityStep::kNone;
  std::uint64_t tick = 0;
};
Current Now();

// Whether this thread is the one that runs the activity. Safe in signal handlers.
bool IsMine();

void Write(LineWriter& line, const Actor& actor, ActivityStep step, std::uint64_t tick);

}  // namespace swarmanoid::activity

// This header has the internals of Activity, for the sources of this folder.
#pragma once

#include "common/activity/activity.h"
#include "common/activity/line_writer.h"

namespace swarmanoid::activity
{

// Signal handlers may use it. The actor may be destroyed at the same moment, but never before.
struct Current
{
  const Actor* actor = nullptr;  // nullptr: no plug-in's code runs
  ActivityStep step = ActivityStep::kNone;
  std::uint64_t tick = 0;
};
Current Now();

// Returns whether this thread is the one that runs the activity. Safe in signal handlers.
bool IsMine();

void Write(LineWriter& line, const Actor& actor, ActivityStep step, std::uint64_t tick);

}  // namespace swarmanoid::activity

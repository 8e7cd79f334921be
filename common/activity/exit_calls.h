// Catches exit, quick_exit and _exit in a plug-in's code, none of which may end a run. This library defines functions
// of these names, which the dynamic linker finds before those of the C library. They call the C library's functions if
// no plug-in's code runs. Internal to failure_report.h.
#pragma once

namespace swarmanoid
{

// Notices at least calls of exit in programs that found the functions of the C library first.
void WatchExit();

}  // namespace swarmanoid

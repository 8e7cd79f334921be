// Calls of exit, quick_exit and _exit within somebody's code: none of them may end a run. This library has functions of
// these names, which the dynamic linker finds before those of the C library; they go on to those of the C library
// where nobody's code runs. The inside of failure_report.h.
#pragma once

namespace swarmanoid
{

// For programs that found the functions of the C library first: exit at least is noticed.
void WatchExit();

}  // namespace swarmanoid

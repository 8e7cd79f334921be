// Reads the state of a process from proc(5).
#pragma once

#include <sys/types.h>

namespace swarmanoid
{

// Returns true if the process waits for something by its own will, and does not work, nor was it stopped.
bool IsAsleep(pid_t pid);
// Returns true if a signal has stopped the process.
bool IsStoppedBySignal(pid_t pid);

}  // namespace swarmanoid

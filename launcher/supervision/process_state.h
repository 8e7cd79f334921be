// What a process does, as proc(5) has it.
#pragma once

#include <sys/types.h>

namespace swarmanoid
{

// True if the process waits for something by its own will, and does not work, nor was it stopped.
bool IsAsleep(pid_t pid);
// By a signal.
bool IsStoppedBySignal(pid_t pid);

}  // namespace swarmanoid

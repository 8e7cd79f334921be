// A stack of its own for the signal handlers of each thread that runs the code of plug-ins: one that overflows its
// stack can still be told.
#pragma once

#include <cstdint>

namespace swarmanoid
{

// Once for each thread; cheap afterwards.
void EnsureSignalStack();

// Whether an access to this address overflows the stack of this thread, which has a signal stack. Safe in signal
// handlers.
bool IsStackOverflow(std::uintptr_t address);

}  // namespace swarmanoid

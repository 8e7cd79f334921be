// A signal stack for each thread that runs the code of plug-ins, so that a stack overflow can be reported.
#pragma once

#include <cstdint>

namespace swarmanoid
{

// Call it once in each thread; further calls are cheap.
void EnsureSignalStack();

// Returns whether an access to this address overflows the stack of this thread, which has a signal stack. Safe in
// signal handlers.
bool IsStackOverflow(std::uintptr_t address);

}  // namespace swarmanoid

// Libraries of ours that a process loads when it first needs them, since they need large libraries of others.
#pragma once

#include <string>

namespace swarmanoid
{

// Returns the address of an extern "C" function of the library libswarmanoid_NAME.so of this version, which it loads.
// The library stays loaded. Throws std::runtime_error with the reason.
void* FunctionOfOwnLibrary(const std::string& name, const char* function);

}  // namespace swarmanoid

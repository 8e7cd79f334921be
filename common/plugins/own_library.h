// Libraries of ours that a process loads when it first needs them, since they need large libraries of others.
#pragma once

#include <string>

namespace swarmanoid
{

// Returns the file of the library libswarmanoid_NAME.so of this version.
std::string OwnLibraryFile(const std::string& name);

// Returns the address of an extern "C" function of that library, which it loads. The library stays loaded.
// Throws std::runtime_error with the reason.
void* FunctionOfOwnLibrary(const std::string& name, const char* function);

}  // namespace swarmanoid

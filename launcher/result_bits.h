// Some functions of the C library choose instructions by the processor, and their results differ in the last bit.
// Controllers use them, so every process that runs controllers is started with that choice taken away
// (docs/determinism.md).
#pragma once

#include <string>
#include <vector>

namespace swarmanoid
{

// GLIBC_TUNABLES for such a process, from the value that it has now.
std::string ResultBitsTunables(const std::string& current);
// Starts this program anew where it was started without; does not return then.
void EnsureResultBits();

// The arguments of this process, the program first.
std::vector<std::string> OriginalCommand();

}  // namespace swarmanoid

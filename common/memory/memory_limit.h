// A process may limit its memory. Beyond the limit, allocations fail by std::bad_alloc in the code that asks for too
// much. Otherwise the kernel would kill an arbitrary process.
#pragma once

#include <cstdint>
#include <string>

namespace swarmanoid
{

// Returns nine tenths of the memory of this machine, or of the process's control group; 0 if it is unknown.
std::uint64_t DefaultMemoryLimit();

// Limits the private memory of this process, in bytes; 0: the default. With sanitizers nothing is limited, since they
// map more than the machine has.
void LimitMemory(std::uint64_t bytes);

// Returns "no memory is left: …", with the limit and the cure. Frees some memory for the report.
std::string OutOfMemoryText();

}  // namespace swarmanoid

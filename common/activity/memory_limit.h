// The memory that a process may take: beyond it, allocations fail by std::bad_alloc in the code that asks for too much,
// instead of the kernel killing whom it likes.
#pragma once

#include <cstdint>
#include <string>

namespace swarmanoid
{

// Nine tenths of the memory of this machine, or of the control group that the process is in; 0 if it is not known.
std::uint64_t DefaultMemoryLimit();

// The private memory of this process, in bytes; 0: the default. Sanitizers map more than there is: then nothing is
// limited.
void LimitMemory(std::uint64_t bytes);

// "no memory is left: …", with the limit and the cure. Frees some room for those who report it.
std::string OutOfMemoryText();

}  // namespace swarmanoid

// The folder in memory that the processes of a run share, as far as reports need it: a full one kills whoever touches
// it, by SIGBUS.
#pragma once

#include <cstdint>
#include <string>

namespace swarmanoid
{

// Where it is. Once, before threads use it.
void SetSharedMemoryFolder(const std::string& folder);
const char* SharedMemoryFolder();
// Bytes that can still be written there. Safe in signal handlers.
std::uint64_t SharedMemoryFree();
bool SharedMemoryIsFull();

}  // namespace swarmanoid

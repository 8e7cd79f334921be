// The folder in memory that the processes of a run share. Reports need its free space: in a full folder, a write kills
// the process by SIGBUS.
#pragma once

#include <cstdint>
#include <string>

namespace swarmanoid
{

// Sets the folder. Call it once, before threads use it.
void SetSharedMemoryFolder(const std::string& folder);
const char* SharedMemoryFolder();
// Returns the bytes that can still be written there. Safe in signal handlers.
std::uint64_t SharedMemoryFree();
bool SharedMemoryIsFull();

}  // namespace swarmanoid

#include "common/memory/shared_memory.h"

#include <sys/vfs.h>

#include <algorithm>
#include <cstring>
#include <limits>

namespace swarmanoid
{
namespace
{

constexpr std::uint64_t kFull = 256 * 1024;

char folder_of_run[512] = "";

}  // namespace

void SetSharedMemoryFolder(const std::string& folder)
{
  const std::size_t length = std::min(folder.size(), sizeof folder_of_run - 1);
  std::memcpy(folder_of_run, folder.data(), length);
  folder_of_run[length] = 0;
}

const char* SharedMemoryFolder() { return folder_of_run; }

std::uint64_t SharedMemoryFree()
{
  struct statfs status
  {
  };
  if (folder_of_run[0] == 0 || statfs(folder_of_run, &status) != 0) return std::numeric_limits<std::uint64_t>::max();
  // A tmpfs without a limit reports no blocks.
  if (status.f_blocks == 0) return std::numeric_limits<std::uint64_t>::max();
  return static_cast<std::uint64_t>(status.f_bavail) * static_cast<std::uint64_t>(status.f_bsize);
}

bool SharedMemoryIsFull() { return SharedMemoryFree() < kFull; }

}  // namespace swarmanoid

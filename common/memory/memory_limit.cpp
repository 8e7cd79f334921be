#include "common/memory/memory_limit.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>

namespace swarmanoid
{
namespace
{

constexpr rlim_t kRoomForReports = 64U << 20;

// Returns the bytes that a file of the control group states; 0 for a missing file or "max".
std::uint64_t Bytes(const char* file)
{
  std::ifstream stream(file);
  std::uint64_t bytes = 0;
  return stream >> bytes ? bytes : 0;
}

}  // namespace

std::uint64_t DefaultMemoryLimit()
{
  std::uint64_t memory =
      static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
  for (const char* file : {"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"})
    if (const std::uint64_t bytes = Bytes(file); bytes != 0) memory = std::min(memory, bytes);
  return memory / 10 * 9;
}

void LimitMemory(std::uint64_t bytes)
{
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  if (bytes == 0) bytes = DefaultMemoryLimit();
  rlimit limit{};
  if (bytes == 0 || getrlimit(RLIMIT_DATA, &limit) != 0) return;
  // The parent process may have set a smaller limit.
  limit.rlim_cur = std::min(limit.rlim_cur, static_cast<rlim_t>(bytes));
  setrlimit(RLIMIT_DATA, &limit);
#else
  static_cast<void>(bytes);
#endif
}

std::string OutOfMemoryText()
{
  rlimit limit{};
  if (getrlimit(RLIMIT_DATA, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return "no memory is left";
  const std::uint64_t allowed = limit.rlim_cur;
  limit.rlim_cur = limit.rlim_max == RLIM_INFINITY ? allowed + kRoomForReports
                                                   : std::min<rlim_t>(limit.rlim_max, allowed + kRoomForReports);
  setrlimit(RLIMIT_DATA, &limit);
  return fmt::format("no memory is left: it may take {} MiB (--memory-limit)", allowed >> 20);
}

}  // namespace swarmanoid

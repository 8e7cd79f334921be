#include "common/bus/machine_id.h"

#include <unistd.h>

#include <fstream>
#include <string>

#include "common/math/random.h"

namespace swarmanoid
{

std::uint16_t MachineId()
{
  std::string identity;
  std::ifstream("/proc/sys/kernel/random/boot_id") >> identity;
  char link[128] = {};
  if (readlink("/proc/self/ns/net", link, sizeof(link) - 1) > 0) identity += link;
  identity += std::to_string(getuid());
  const auto hash = static_cast<std::uint32_t>(StreamName(identity));
  return static_cast<std::uint16_t>(hash ^ (hash >> 16));
}

}  // namespace swarmanoid

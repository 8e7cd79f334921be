#include "common/messages/machine_name.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstddef>

namespace swarmanoid
{

std::string MachineNameMistake(const std::string& name)
{
  constexpr std::size_t kLongest = 63;
  const bool plain = std::all_of(name.begin(), name.end(),
                                 [](unsigned char c)
                                 { return (c < 128 && std::isalnum(c) != 0) || c == '-' || c == '_' || c == '.'; });
  if (!plain || name.empty() || name.size() > kLongest || name[0] == '-')
    return fmt::format("it must be a name of up to {} letters, digits, '-', '_' and '.'", kLongest);
  return name == kHere || name == "localhost" ? "it must be another name: that one is the launcher's machine" : "";
}

}  // namespace swarmanoid

// The command line of this process, as it stands in manifests and in hints.
#pragma once

#include <string>
#include <vector>

namespace swarmanoid
{

// Returns the arguments of this process, the program first.
std::vector<std::string> OriginalCommand();

}  // namespace swarmanoid

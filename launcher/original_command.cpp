#include "launcher/original_command.h"

#include <fstream>

namespace swarmanoid
{

std::vector<std::string> OriginalCommand()
{
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  std::vector<std::string> command;
  for (std::string argument; std::getline(file, argument, '\0');) command.push_back(argument);
  return command;
}

}  // namespace swarmanoid

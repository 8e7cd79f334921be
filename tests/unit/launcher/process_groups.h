// Checks whether processes are left, for tests of their start and end.
#pragma once

#include <signal.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "tests/eventually.h"

namespace swarmanoid
{

inline bool GroupRuns(pid_t group)
{
  for (const auto& entry : std::filesystem::directory_iterator("/proc"))
  {
    std::ifstream stat(entry.path() / "stat");
    std::string line;
    if (!std::getline(stat, line)) continue;
    std::istringstream fields(line.substr(line.rfind(')') + 1));
    std::string state, parent;
    pid_t of = 0;
    if (fields >> state >> parent >> of && of == group && state != "Z") return true;
  }
  return false;
}

// A killed process takes a moment to disappear.
inline bool GroupIsGone(pid_t group)
{
  return test::Eventually([=] { return !GroupRuns(group); });
}

}  // namespace swarmanoid

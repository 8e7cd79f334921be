#include "launcher/supervision/process_state.h"

#include <fmt/format.h>

#include <fstream>
#include <string>

namespace swarmanoid
{
namespace
{

bool IsInState(pid_t pid, char letter)
{
  std::ifstream stat(fmt::format("/proc/{}/stat", pid));
  std::string line;
  std::getline(stat, line);
  return line.find(fmt::format(") {} ", letter)) != std::string::npos;
}

}  // namespace

bool IsAsleep(pid_t pid) { return IsInState(pid, 'S'); }

bool IsStoppedBySignal(pid_t pid) { return IsInState(pid, 'T'); }

}  // namespace swarmanoid

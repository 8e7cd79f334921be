// The runs of this user on this machine that may be adopted: those whose supervising process can be asked.
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>
#include <vector>

#include "launcher/processes/console_link.h"

namespace swarmanoid
{

struct SupervisedRun
{
  std::string experiment;
  std::string folder;
  int domain = 0;
  pid_t supervisor = 0;
  pid_t launcher = 0;                // 0: it has none
  std::optional<double> orphaned_s;  // since it has none
  double ends_in_s = 0;              // unless it is adopted
};

// What a supervising process says of itself. None if it makes no sense.
std::optional<SupervisedRun> ReadSupervisedRun(const nlohmann::json& message);
// Those that answer.
std::vector<SupervisedRun> FindSupervisedRuns();

}  // namespace swarmanoid

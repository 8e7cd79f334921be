// The words after `swarmanoid control`.
#pragma once

#include <string>
#include <vector>

namespace swarmanoid
{

struct ControlRequest
{
  std::string experiment;  // empty: the one that runs
  std::string verb;
  std::string entity;  // move, detach, add, remove
  std::vector<double>
      numbers;  // step: ticks; speed: factor; move, detach, add: x, y, z in m, alpha, beta, gamma in degrees
};

// Throws UsageError with the right form.
ControlRequest ParseControlRequest(std::vector<std::string> words);

}  // namespace swarmanoid

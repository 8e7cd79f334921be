// The words after `swarmanoid control`.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace swarmanoid
{

struct ControlRequest
{
  std::string experiment;  // empty: the one that runs
  std::string verb;
  std::string entity;  // move, detach, add, remove; reset: the seed, or nothing for that of the run
  std::vector<double>
      numbers;  // step: ticks; speed: factor; move, detach, add: x, y, z in m, alpha, beta, gamma in degrees
};

// `seed`: of --seed. Throws UsageError with the right form.
ControlRequest ParseControlRequest(std::vector<std::string> words, std::optional<std::uint64_t> seed = std::nullopt);

}  // namespace swarmanoid

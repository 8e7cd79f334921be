// The words after `swarmanoid control`, and what is said if nobody answers them. Also for requests from Python.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/messages/run_status.h"

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

// For those who got no answer: what the run does, after "does not answer". `dropped`: messages that were not
// understood.
std::string WhyNoAnswer(const std::optional<RunStatus>& status, std::uint64_t dropped, bool insecure);

}  // namespace swarmanoid

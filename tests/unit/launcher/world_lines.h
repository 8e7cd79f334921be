// The texts of mistakes and notes, for tests.
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "common/experiment/load_experiment.h"

namespace swarmanoid::test
{

// Returns "line:column: text" for each.
inline std::vector<std::string> LinesOf(const std::vector<Diagnostic>& all)
{
  std::vector<std::string> lines;
  for (const Diagnostic& one : all)
    lines.push_back(fmt::format("{}:{}: {}", one.location.line, one.location.column, one.message));
  return lines;
}

}  // namespace swarmanoid::test

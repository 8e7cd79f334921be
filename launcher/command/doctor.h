// `swarmanoid doctor` checks here by trial whether this machine can do runs.
#pragma once

#include <string>
#include <vector>

namespace swarmanoid
{

enum class Verdict
{
  kGood,
  kLimited,  // runs work, but other functions do not
  kBad       // no cluster can run here
};

struct Finding
{
  std::string subject;
  Verdict verdict = Verdict::kGood;
  std::string what;
  std::string cure{};  // empty if there is nothing to do
};

// Returns the findings in a fixed order; takes some seconds. Files are written to `folder` and removed.
std::vector<Finding> Examine(const std::string& folder);

}  // namespace swarmanoid

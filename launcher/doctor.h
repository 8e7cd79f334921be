// What a run needs of this machine, tried out. Used by `swarmanoid doctor`.
#pragma once

#include <string>
#include <vector>

namespace swarmanoid
{

enum class Verdict
{
  kGood,
  kLimited,  // runs go; something else does not
  kBad       // no cluster runs here
};

struct Finding
{
  std::string subject;
  Verdict verdict = Verdict::kGood;
  std::string what;
  std::string cure{};  // empty if there is nothing to do
};

// In this order; takes some seconds. `folder`: of what it writes, which is removed.
std::vector<Finding> Examine(const std::string& folder);

}  // namespace swarmanoid

// What a branch of a run changes in its experiment, and what of that may change in the middle of a run. Used by
// `swarmanoid run --branch`.
#pragma once

#include <string>
#include <vector>

#include "common/experiment/experiment.h"

namespace swarmanoid
{

struct BranchChange
{
  std::string path;   // as --set takes it
  std::string value;  // "0.05 instead of 0.1", "new", "left out"
  bool matters;       // to the state: it is no visualisation, length or name
};

// In the order of the file. Throws UsageError that names one that may not change, and why.
std::vector<BranchChange> ChangesBetween(const Experiment& before, const Experiment& after);

}  // namespace swarmanoid

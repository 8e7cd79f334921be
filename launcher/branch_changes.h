// The differences between the experiment of a branch and that of its run, and a check of which of them may change in
// mid-run. Used by `swarmanoid run --branch`.
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

// Returns the changes in the order of the file. Throws UsageError that names a change that is not allowed, and the
// reason.
std::vector<BranchChange> ChangesBetween(const Experiment& before, const Experiment& after);

}  // namespace swarmanoid

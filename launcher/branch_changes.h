// The differences between the experiment of a branch and that of its run, and a check of which of them may change in
// mid-run. `swarmanoid run --branch` uses it.
#pragma once

#include <string>
#include <vector>

#include "common/experiment/experiment.h"

namespace swarmanoid
{

struct BranchChange
{
  std::string path;   // in the form of --set
  std::string value;  // "0.05 instead of 0.1", "new", "left out"
  bool matters;       // whether it affects the state: visualisations, length and name do not
};

// Returns the changes in the order of the file. Throws UsageError that names a change that is not allowed, and the
// reason.
std::vector<BranchChange> ChangesBetween(const Experiment& before, const Experiment& after);

}  // namespace swarmanoid

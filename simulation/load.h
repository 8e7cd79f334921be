// Reading an experiment for a verb of the command: built-in plug-ins known, all errors shown.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "common/experiment/experiment.h"
#include "common/experiment/load_experiment.h"

namespace swarmanoid
{

// nullptr if the file is wrong: then all its errors are on standard error.
std::unique_ptr<Experiment> LoadOrComplain(const std::string& file, const LoadOptions& options);
// Every process of a run reads the maps of terrains and the pictures of the floor; what is wrong with them is told on
// standard error before any of them starts.
bool FilesAreGood(const Experiment& experiment);

}  // namespace swarmanoid

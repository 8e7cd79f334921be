// Reads an experiment for a sub-command. The simulator's plug-ins are registered, and all errors are printed.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "common/experiment/experiment.h"
#include "common/experiment/load_experiment.h"

namespace swarmanoid
{

// Returns nullptr if the file has mistakes, after all of them were printed on standard error. `places` gets
// LoadedExperiment::places.
std::unique_ptr<Experiment> LoadOrComplain(const std::string& file, const LoadOptions& options,
                                           std::string* places = nullptr);
// Returns false if a map of a terrain or a picture of the floor cannot be read, after the mistakes were printed on
// standard error. Every process of a run reads these files, so the check comes before any of them starts.
bool FilesAreGood(const Experiment& experiment);

}  // namespace swarmanoid

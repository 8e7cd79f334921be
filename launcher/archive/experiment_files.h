// Finds the files that an experiment reads, beside its libraries: maps, pictures, meshes, scripts and URDF files.
#pragma once

#include <string>
#include <vector>

#include "common/experiment/experiment.h"

namespace swarmanoid
{

struct ExperimentFiles
{
  // The folder that has all of them and the experiment's own folder. Their paths from each other stay equal below it.
  std::string root;
  std::vector<std::string> paths;  // absolute, ascending
  // The values of the experiment that are absolute paths. They mean another file on another machine.
  std::vector<std::string> absolute;
};

// Returns the files that values of the experiment name, that its scripts load by a name in quotes, the meshes of URDF
// files, and `more`. Values of visualisations do not count. Throws UsageError if one of `more` cannot be read, or if a
// URDF file names a mesh by an absolute path.
ExperimentFiles FilesOf(const Experiment& experiment, const std::vector<std::string>& more);

}  // namespace swarmanoid

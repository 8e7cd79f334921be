// Experiments in ARGoS3's XML, as ours. Used by the launcher.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "common/configuration/configuration_tree.h"
#include "common/experiment/load_experiment.h"

namespace swarmanoid
{

struct ConvertedExperiment
{
  std::shared_ptr<const ConfigurationNode> root;
  std::vector<Diagnostic> mistakes;  // what has no counterpart here, with its cure
  std::vector<Diagnostic> notes;     // what has no effect here
};

// `root`: <argos-configuration>. Libraries are looked for as ARGoS3 does: in the working folder and in those of
// ARGOS_PLUGIN_PATH, and in `folder`, that of the file, and the one above it.
ConvertedExperiment ConvertArgos3(const ConfigurationNode& root, const std::string& folder);

// From now on files of ARGoS3 are read wherever experiments are; notes go to standard error.
void ReadArgos3Experiments();

}  // namespace swarmanoid

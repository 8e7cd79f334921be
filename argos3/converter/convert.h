// Experiments in ARGoS3's XML, as ours. Used by the launcher.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "argos3/converter/counted_bodies.h"
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

// Runs the Init of the loop functions of a converted experiment and tells what boxes and cylinders they made that the
// file does not declare. `settings`: as the run itself will have them.
using Argos3Rehearsal = std::function<argos3::MadeBodies(const ConfigurationNode& experiment, const std::string& folder,
                                                         const ExperimentSettings& settings)>;

// `root`: <argos-configuration>. Libraries are looked for as ARGoS3 does: in the working folder and in those of
// ARGOS_PLUGIN_PATH, and in `folder`, that of the file, and the one above it.
// `rehearse` is asked if the loop functions make boxes or cylinders; without it none can be made.
ConvertedExperiment ConvertArgos3(const ConfigurationNode& root, const std::string& folder,
                                  const Argos3Rehearsal& rehearse = {}, const ExperimentSettings& settings = {});

// From now on files of ARGoS3 are read wherever experiments are; notes go to standard error.
void ReadArgos3Experiments(Argos3Rehearsal rehearse);

}  // namespace swarmanoid

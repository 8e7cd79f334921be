// Converts experiments in ARGoS3's XML to ours. Used by the launcher.
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
  std::vector<Diagnostic> mistakes;  // content without a counterpart here, with its cure
  std::vector<Diagnostic> notes;     // content without effect here
};

// Runs Init of the loop functions of a converted experiment. Returns the boxes and cylinders that they made and the
// file does not declare. `settings`: those of the later run.
using Argos3Rehearsal = std::function<argos3::MadeBodies(const ConfigurationNode& experiment, const std::string& folder,
                                                         const ExperimentSettings& settings)>;

// Converts an experiment. `root` is <argos-configuration>. Libraries are searched as in ARGoS3, in the working folder
// and in those of ARGOS_PLUGIN_PATH, and also in `folder`, the file's folder, and its parent. `rehearse` is called if
// the loop functions make boxes or cylinders; without it they cannot make any.
ConvertedExperiment ConvertArgos3(const ConfigurationNode& root, const std::string& folder,
                                  const Argos3Rehearsal& rehearse = {}, const ExperimentSettings& settings = {});

// Prints notes to standard error: each text once, with its places.
void PrintNotes(const std::vector<Diagnostic>& notes);

// Returns whether an experiment of ARGoS3 asks for real time.
bool KeepsRealTime(const std::string& text);

// Without visualisers, Qt user functions whose library does not exist are left out, with a note.
void LetUserFunctionsBeMissing();

// Makes all readers of experiments accept files of ARGoS3; notes go to standard error.
void ReadArgos3Experiments(Argos3Rehearsal rehearse);

}  // namespace swarmanoid

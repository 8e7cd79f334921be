#include "launcher/argos3_rehearsal.h"

#include "common/configuration/xml_writer.h"
#include "launcher/scratch_folder.h"
#include "launcher/trial_start.h"
#include "roles/builtins.h"

namespace swarmanoid
{

argos3::MadeBodies RehearseArgos3(const ConfigurationNode& experiment, const std::string& folder)
{
  RegisterBuiltins();
  const LoadedExperiment loaded = LoadExperimentText(WriteXml(experiment), "rehearsal.xml", folder);
  if (!loaded.experiment) return {};
  const ScratchFolder scratch;
  // Init of loop functions comes in the first step.
  TryRun(*loaded.experiment, {.folder = scratch.Path(), .steps = 1, .is_silent = true});
  return argos3::ReadMadeBodies(scratch.Path());
}

}  // namespace swarmanoid

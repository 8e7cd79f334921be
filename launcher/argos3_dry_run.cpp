#include "launcher/argos3_dry_run.h"

#include "common/configuration/xml_writer.h"
#include "launcher/smoke_test.h"
#include "launcher/system/scratch_folder.h"
#include "simulation/register_all.h"

namespace swarmanoid
{
namespace
{

LoadedExperiment Load(const ConfigurationNode& experiment, const std::string& folder,
                      const ExperimentSettings& settings)
{
  return LoadExperimentText(WriteXml(experiment), "rehearsal.xml", folder, {.settings = settings});
}

// Returns the settings that this experiment has. Other settings concern objects that only the rehearsal makes, or are
// mistakes, which the run reports.
ExperimentSettings Fitting(const ConfigurationNode& experiment, const std::string& folder,
                           const ExperimentSettings& settings)
{
  ExperimentSettings fitting;
  for (const auto& setting : settings)
  {
    fitting.push_back(setting);
    if (!Load(experiment, folder, fitting).experiment) fitting.pop_back();
  }
  return fitting;
}

}  // namespace

argos3::MadeBodies RehearseArgos3(const ConfigurationNode& experiment, const std::string& folder,
                                  const ExperimentSettings& settings)
{
  RegisterBuiltins();
  LoadedExperiment loaded = Load(experiment, folder, settings);
  if (!loaded.experiment) loaded = Load(experiment, folder, Fitting(experiment, folder, settings));
  if (!loaded.experiment) return {};
  const ScratchFolder scratch;
  // Init of loop functions runs in the first step.
  TryRun(*loaded.experiment, {.folder = scratch.Path(), .steps = 1, .is_silent = true});
  return argos3::ReadMadeBodies(scratch.Path());
}

}  // namespace swarmanoid

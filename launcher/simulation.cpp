#include "launcher/simulation.h"

#include <filesystem>
#include <string>

#include "common/program/program.h"
#include "common/run/run_settings.h"
#include "launcher/result_bits.h"
#include "launcher/run_experiment.h"
#include "roles/builtins.h"

namespace swarmanoid
{

int RunSimulation(int count, char** arguments, const std::function<void(CSimulator&)>& watch)
{
  const std::string name = std::filesystem::path(count > 0 ? arguments[0] : "simulation").filename();
  RunSettings settings;
  settings.single_process = true;
  return RunProgram(
      {.name = name,
       .purpose = "Runs an experiment in this process.",
       .footer = "The same as `swarmanoid run EXPERIMENT.xml --single-process`.",
       .register_plugins = RegisterBuiltins,
       .catches_interrupts = false},
      count, arguments, [&](CLI::App& app) { AddOptions(app, RunOptionTable(settings)); },
      [&]
      {
        EnsureResultBits();
        return RunExperiment(settings, [&](const Experiment& experiment, const RunFolder& folder, Manifest&)
                             { return RunHere(settings, experiment, folder, watch); });
      });
}

}  // namespace swarmanoid

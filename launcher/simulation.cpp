#include "launcher/simulation.h"

#include <filesystem>
#include <string>

#include "common/program/program.h"
#include "common/program/trust_flag.h"
#include "common/run/run_options.h"
#include "launcher/run_experiment.h"
#include "simulation/register_all.h"

namespace swarmanoid
{

int RunSimulation(int count, char** arguments, const std::function<void(CSimulator&)>& watch)
{
  const std::string name = std::filesystem::path(count > 0 ? arguments[0] : "simulation").filename();
  RunSettings settings;
  return RunProgram(
      {.name = name,
       .purpose = "Runs an experiment as a cluster, of which this process is the space server.",
       .footer = "The same options, output and exit codes as those of `swarmanoid run`.",
       .register_plugins = RegisterBuiltins,
       .catches_interrupts = false},
      count, arguments,
      [&](CLI::App& app)
      {
        AddOptions(app, RunOptionTable(settings));
        AddTrustFlag(app);
      },
      [&] { return RunExperiment(RunRequest(settings, watch)); });
}

}  // namespace swarmanoid

// `swarmanoid run`: as a cluster or in this process.
#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "common/activity/exit_codes.h"
#include "launcher/commands.h"
#include "launcher/run_experiment.h"

namespace swarmanoid
{
void AddRunCommand(CLI::App& app, int& exit_code)
{
  auto options = std::make_shared<RunSettings>();
  CLI::App* verb = app.add_subcommand("run", "Run an experiment");
  AddOptions(*verb, RunOptionTable(*options));
  verb->footer(
      std::string(
          "The last line on standard output is\n"
          "  finished: <ticks> ticks, <entities> entities, hash <16 hex digits>, <wall> s, <factor>x real time\n"
          "Ctrl-C once ends the run after the current tick and keeps all output, twice kills it.\n") +
      kExitCodesText +
      "Examples:\n"
      "  swarmanoid run configs/diffusion_10.xml\n"
      "  swarmanoid run configs/diffusion_10.xml --single-process --ticks 1000 --seed 7\n"
      "  swarmanoid run configs/diffusion_1000.xml --controller-hosts 2 --output results/first\n"
      "  swarmanoid run configs/diffusion_10.xml --real-time 1 --set framework.clocktick=50\n"
      "  swarmanoid run configs/diffusion_10.xml --events runs/first/events.csv    with what users did in that run\n"
      "  swarmanoid run configs/diffusion_10.xml --output first --checkpoint-every 500\n"
      "  swarmanoid run first/experiment.xml --restore first/checkpoint-00000500");
  verb->callback([options, &exit_code] { exit_code = RunExperiment(*options); });
}

}  // namespace swarmanoid

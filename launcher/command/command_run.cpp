// `swarmanoid run`: as a cluster or in this process.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "common/errors/exit_codes.h"
#include "common/errors/print_error.h"
#include "common/program/trust_flag.h"
#include "launcher/command/sub_command.h"
#include "launcher/run_experiment.h"
#include "launcher/showing.h"
#include "simulation/load.h"
#include "simulation/run_folder.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;

constexpr const char* kRuns = "runs";

// Returns whether the user is at a terminal, has no runs yet, and gives no option of scripts.
bool IsFirst(const RunSettings& options)
{
  std::error_code none;
  return IsAtTerminal() && !options.quiet && options.branch.empty() && options.output_folder.empty() &&
         options.visualisations && options.expected_hash.empty() && options.hosts_file.empty() &&
         options.engine_hosts.empty() && !fs::exists(kRuns, none);
}

std::uint64_t TicksOf(const fs::path& run) { return ReadManifest(run).value("ticks", std::uint64_t{0}); }

// Shows the first run. Errors here do not change its exit code.
void ShowFirst(const RunSettings& options)
{
  const auto experiment = LoadOrComplain(options.file, ChangesOf(options));
  if (!experiment || HasPictures(*experiment)) return;
  try
  {
    for (const fs::directory_entry& run : fs::directory_iterator(kRuns))
      if (!run.is_symlink())
        Show(*experiment, KindForSession(), fs::absolute(run.path()), TicksOf(fs::absolute(run.path())));
  }
  catch (const std::exception& error)
  {
    PrintError("It cannot be shown: {}\n", error.what());
  }
  PrintError(
      "Next: `swarmanoid demo --list` has more to see, `swarmanoid new user my_robots` makes a place for your "
      "own controllers\n");
}

void AddRunCommand(CLI::App& app, int& exit_code)
{
  auto options = std::make_shared<RunSettings>();
  CLI::App* verb = app.add_subcommand("run", "Run an experiment");
  std::vector<OptionSpec> table = RunOptionTable(*options);
  for (OptionSpec& option : table) option.required = false;  // a run that branches off has its experiment
  AddOptions(*verb, table);
  AddTrustFlag(*verb);
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
      "  swarmanoid run first/experiment.xml --restore first/checkpoint-00000500\n"
      "  swarmanoid run --branch runs/first@500 --set controllers.diffusion.parameters.velocity=0.1    from its tick "
      "500 on\n"
      "  swarmanoid run configs/diffusion_1000.xml --ticks 0 --journal-budget 2GiB");
  verb->callback(
      [options, &exit_code]
      {
        const bool is_first = IsFirst(*options);
        exit_code = RunExperiment(RunRequest(*options));
        if (is_first && (exit_code == kExitDone || exit_code == kExitExperimentFailed)) ShowFirst(*options);
      });
}

const RegisterSubCommand kRun(1, "run", AddRunCommand);

}  // namespace
}  // namespace swarmanoid

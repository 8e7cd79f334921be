// `swarmanoid run`: as a cluster or in this process.
#include <CLI/CLI.hpp>
#include <map>
#include <memory>
#include <string>

#include "launcher/cluster_run.h"
#include "launcher/commands.h"
#include "launcher/run_command_line.h"
#include "launcher/run_experiment.h"

namespace swarmanoid
{
namespace
{

void RefuseContradictions(const RunOptions& options)
{
  if (!options.single_process) return;
  const std::string why = "; leave out --single-process to run a cluster";
  if (options.controller_hosts != 1) throw UsageError("--controller-hosts: a single process has one" + why);
  if (!options.hosts_file.empty() || !options.engine_hosts.empty())
    throw UsageError("--hosts and --engine-host: a single process runs on this machine" + why);
  if (options.domain) throw UsageError("--domain: a single process uses no DDS" + why);
}

int Run(const RunOptions& options)
{
  RefuseContradictions(options);
  return RunExperiment(options,
                       [&options](const Experiment& experiment, const RunFolder& folder, Manifest& manifest)
                       {
                         if (options.single_process) return RunHere(options, experiment, folder);
                         return RunCluster(options, experiment, folder, manifest);
                       });
}

void AddClusterOptions(CLI::App& verb, RunOptions& options)
{
  const std::map<std::string, Placement> placements{
      {"auto", Placement::kAuto}, {"one-core", Placement::kOneCore}, {"spread", Placement::kSpread}};

  verb.add_flag("--single-process", options.single_process, "Run everything in this process, without DDS");
  verb.add_option("--controller-hosts", options.controller_hosts, "Processes that share the robots' controllers")
      ->check(CLI::Range(1U, 1000U))
      ->capture_default_str();
  verb.add_option("--engine-host", options.engine_hosts, "ENGINE=HOST: run an engine on another machine")
      ->expected(1)
      ->take_all();
  verb.add_option("--hosts", options.hosts_file,
                  "File that says which process runs on which machine (docs/command.md)");
  verb.add_option("--domain", options.domain, "DDS domain (default: a free one)")->check(CLI::Range(0, 232));
  verb.add_option("--placement", options.placement,
                  "Processor cores of the processes: auto (one core where the experiment is small), one-core or spread")
      ->transform(CLI::CheckedTransformer(placements).description(""));
}

}  // namespace

void AddRunCommand(CLI::App& app, int& exit_code)
{
  auto options = std::make_shared<RunOptions>();
  CLI::App* verb = app.add_subcommand("run", "Run an experiment");
  AddRunOptions(*verb, *options);
  AddClusterOptions(*verb, *options);
  verb->footer(
      "The last line on standard output is\n"
      "  finished: <ticks> ticks, <entities> entities, hash <16 hex digits>, <wall> s, <factor>x real time\n"
      "Ctrl-C once ends the run after the current tick and keeps all output, twice kills it.\n"
      "Exit codes: 0 done, 1 the experiment failed by its own measure, 2 usage, 3 the experiment file is invalid,\n"
      "4 a process failed, 5 the hash differs, 130 interrupted.\n"
      "Examples:\n"
      "  swarmanoid run configs/diffusion_10.xml\n"
      "  swarmanoid run configs/diffusion_10.xml --single-process --ticks 1000 --seed 7\n"
      "  swarmanoid run configs/diffusion_1000.xml --controller-hosts 2 --output results/first\n"
      "  swarmanoid run configs/diffusion_10.xml --real-time 1 --set framework.clocktick=50\n"
      "  swarmanoid run configs/diffusion_10.xml --events runs/first/events.csv    with what users did in that run\n"
      "  swarmanoid run configs/diffusion_10.xml --output first --checkpoint-every 500\n"
      "  swarmanoid run first/experiment.xml --restore first/checkpoint-00000500");
  verb->callback([options, &exit_code] { exit_code = Run(*options); });
}

}  // namespace swarmanoid

// `swarmanoid run`: the options, and what surrounds both ways of running: reading the experiment, the run folder, the
// result.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "launcher/cluster_run.h"
#include "launcher/commands.h"
#include "launcher/exit_codes.h"
#include "launcher/load.h"
#include "launcher/result_bits.h"
#include "launcher/run_folder.h"
#include "launcher/run_options.h"
#include "launcher/single_run.h"

namespace swarmanoid
{
namespace
{

// What an option changes in the experiment, as settings.
LoadOptions Changes(const RunOptions& options)
{
  LoadOptions changes;
  for (const std::string& setting : options.settings) changes.settings.push_back(SplitSetting(setting));
  if (options.seed) changes.settings.emplace_back("framework.seed", std::to_string(*options.seed));
  if (options.ticks) changes.settings.emplace_back("framework.maxclock", std::to_string(*options.ticks));
  return changes;
}

void RefuseContradictions(const RunOptions& options)
{
  if (!options.single_process) return;
  const std::string why = "; leave out --single-process to run a cluster";
  if (options.paused) throw UsageError("--paused: a run in a single process cannot be resumed" + why);
  if (options.controller_hosts != 1) throw UsageError("--controller-hosts: a single process has one" + why);
  if (!options.hosts_file.empty() || !options.engine_hosts.empty())
    throw UsageError("--hosts and --engine-host: a single process runs on this machine" + why);
  if (options.domain) throw UsageError("--domain: a single process uses no DDS" + why);
}

Manifest StartOfManifest(const RunOptions& options, const Experiment& experiment,
                         const std::vector<std::string>& command)
{
  Manifest manifest;
  manifest.experiment = experiment.name;
  manifest.file = std::filesystem::absolute(options.experiment).lexically_normal();
  manifest.experiment_hash = TextHash(experiment.effective_xml);
  manifest.seed = experiment.seed;
  manifest.command = command;
  manifest.started = TimeStamp();
  return manifest;
}

// The run as far as its exit code; failures have been told on standard error.
RunResult Execute(const RunOptions& options, const Experiment& experiment, const RunFolder& folder, Manifest& manifest)
{
  if (options.single_process) return RunHere(options, experiment, folder);
  return RunCluster(options, experiment, folder, manifest);
}

int Conclude(const RunOptions& options, const RunResult& result, const RunFolder& folder, Manifest& manifest)
{
  int exit_code = result.exit_code;
  if (result.summary && !options.expected_hash.empty() && exit_code == kDone &&
      result.summary->hash != std::stoull(options.expected_hash, nullptr, 16))
  {
    fmt::print(stderr, "the hash differs: expected {:0>16}, got {:016x}\n", options.expected_hash,
               result.summary->hash);
    exit_code = kHashDiffers;
  }

  manifest.ended = TimeStamp();
  manifest.exit_code = exit_code;
  manifest.failure = result.failure;
  if (result.summary)
  {
    manifest.ticks = result.summary->ticks;
    manifest.state_hash = result.summary->hash;
    manifest.wall_s = result.summary->wall_s;
    manifest.real_time_factor = result.summary->real_time_factor;
  }
  try
  {
    folder.Write("manifest.json", manifest.Text());
  }
  catch (const RunFolderError& error)
  {
    fmt::print(stderr, "swarmanoid: {}\n", error.what());
    if (exit_code == kDone) exit_code = kProcessFailed;
  }
  if (result.summary) fmt::print("{}\n", FinishedLine(*result.summary));
  return exit_code;
}

int Run(const RunOptions& options, const std::vector<std::string>& command)
{
  RefuseContradictions(options);
  // The programs of a cluster get their environment from us.
  if (options.single_process) EnsureResultBits();
  const auto experiment = LoadOrComplain(options.experiment, Changes(options));
  if (!experiment) return kInvalid;

  try
  {
    const RunFolder folder(options.output, experiment->name);
    Manifest manifest = StartOfManifest(options, *experiment, command);
    folder.Write("experiment.xml", experiment->effective_xml);
    folder.Write("manifest.json", manifest.Text());
    const RunResult result = Execute(options, *experiment, folder, manifest);
    return Conclude(options, result, folder, manifest);
  }
  catch (const RunFolderError& error)
  {
    throw UsageError(error.what());
  }
}

void AddOptions(CLI::App& verb, RunOptions& options)
{
  const CLI::Validator hash_digits(
      [](const std::string& text)
      {
        const bool good =
            !text.empty() && text.size() <= 16 && text.find_first_not_of("0123456789abcdefABCDEF") == std::string::npos;
        return good ? std::string() : "'" + text + "' is no hash: write up to 16 hexadecimal digits";
      },
      "HASH");
  const std::map<std::string, Placement> placements{
      {"auto", Placement::kAuto}, {"one-core", Placement::kOneCore}, {"spread", Placement::kSpread}};

  verb.add_option("EXPERIMENT", options.experiment, "The experiment file")->required();
  verb.add_flag("--single-process", options.single_process, "Run everything in this process, without DDS");
  verb.add_option("--controller-hosts", options.controller_hosts, "Processes that share the robots' controllers")
      ->check(CLI::Range(1U, 1000U))
      ->capture_default_str();
  verb.add_option("--engine-host", options.engine_hosts, "ENGINE=HOST: run an engine on another machine")
      ->expected(1)
      ->take_all();
  verb.add_option("--hosts", options.hosts_file,
                  "File that says which process runs on which machine (docs/command.md)");
  verb.add_option("--seed", options.seed, "Seed of all random numbers, instead of the file's");
  verb.add_option("--ticks", options.ticks, "Ticks to run, instead of the file's maxclock; 0: until stopped");
  verb.add_option("--set", options.settings, "PATH=VALUE: change the experiment, for example arena.fb.position=1,2,0")
      ->expected(1)
      ->take_all();
  verb.add_option("--output", options.output, "Folder of the run, new or empty (default: runs/<experiment>-<time>)");
  verb.add_option("--domain", options.domain, "DDS domain (default: a free one)")->check(CLI::Range(0, 232));
  verb.add_option("--real-time", options.real_time, "Run at this multiple of real time; 0: as fast as possible")
      ->check(CLI::NonNegativeNumber);
  verb.add_flag("--paused", options.paused, "Start paused; `swarmanoid control resume` goes on");
  verb.add_flag("--no-visualisers", options.no_visualisers, "Leave out the <visualisations> of the file");
  verb.add_option("--hash-log", options.hash_log, "File that gets the hash of the state at every tick");
  verb.add_option("--expect-hash", options.expected_hash, "Exit with 5 unless the run ends with this hash")
      ->check(hash_digits);
  verb.add_flag("--quiet", options.quiet, "Show no progress");
  verb.add_option("--placement", options.placement,
                  "Processor cores of the processes: auto (one core where the experiment is small), one-core or spread")
      ->transform(CLI::CheckedTransformer(placements).description(""));
}

}  // namespace

void AddRunCommand(CLI::App& app, int& exit_code)
{
  auto options = std::make_shared<RunOptions>();
  CLI::App* verb = app.add_subcommand("run", "Run an experiment");
  AddOptions(*verb, *options);
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
      "  swarmanoid run configs/diffusion_10.xml --real-time 1 --set framework.clocktick=50");
  verb->callback([options, &exit_code] { exit_code = Run(*options, OriginalCommand()); });
}

}  // namespace swarmanoid

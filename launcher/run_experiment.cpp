#include "launcher/run_experiment.h"

#include <fmt/format.h>

#include <csignal>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include "common/activity/exit_codes.h"
#include "common/activity/print_error.h"
#include "common/bus/free_domain.h"
#include "common/checkpoint/checkpoint.h"
#include "common/checkpoint/library_builds.h"
#include "common/journal/journal_reader.h"
#include "common/math/reproducible_math.h"
#include "common/program/standard_output.h"
#include "common/program/usage_error.h"
#include "launcher/branch.h"
#include "launcher/original_command.h"
#include "launcher/showing.h"
#include "launcher/supervision/cluster_run.h"
#include "launcher/supervision/manifest_at_death.h"
#include "simulation/load.h"
#include "space_server/event_log.h"

namespace swarmanoid
{
namespace
{

Manifest StartOfManifest(const RunSettings& options, const Experiment& experiment)
{
  Manifest manifest;
  manifest.experiment = experiment.name;
  manifest.file = std::filesystem::absolute(options.file).lexically_normal();
  manifest.experiment_hash = TextHash(experiment.effective_xml);
  manifest.seed = experiment.seed;
  manifest.command = OriginalCommand();
  for (const LibraryBuild& library : LibraryBuildsOf(experiment))
    manifest.libraries.emplace_back(library.name, library.build);
  manifest.started = TimeStamp();
  return manifest;
}

void ReadCheckpointOf(const RunSettings& options, const Experiment& experiment)
{
  const Checkpoint checkpoint =
      ReadCheckpoint(options.restore_file, experiment, {options.controller_hosts, options.any_build});
  const std::string difference = DifferenceOfBuilds(checkpoint.origin.libraries, LibraryBuildsOf(experiment));
  if (!difference.empty())
    PrintError(
        "swarmanoid: warning: the checkpoint was taken with {}: what it saved may mean "
        "something else to this one, and the run need not have the bits of one that was never interrupted\n",
        difference);
}

// Before the folder of the run is made and processes are started.
void RefuseBadCheckpoints(const RunSettings& options, const Experiment& experiment)
{
  try
  {
    CheckCheckpointPeriod(options.checkpoint_every, experiment);
    if (!options.restore_file.empty()) ReadCheckpointOf(options, experiment);
  }
  catch (const std::invalid_argument& error)
  {
    throw UsageError(std::string("--checkpoint-every: ") + error.what());
  }
  catch (const std::runtime_error& error)
  {
    throw UsageError(std::string("--restore: ") + error.what());
  }
}

// A run: what was asked, and where it is.
struct Begun
{
  RunSettings options;
  std::unique_ptr<const Experiment> experiment;
  RunFolder folder;
  Manifest manifest;
};

std::string FolderOfReset(const RunFolder& first, unsigned number)
{
  return first.File(fmt::format("reset-{}", number));
}

// The experiment of the first run at tick 0, as `swarmanoid run` with that seed begins it.
Begun BeginAgain(const Begun& first, const ResetOrigin& from, std::uint64_t seed, RunFolder folder)
{
  RunSettings options = first.options;
  options.file = first.folder.File("experiment.xml");
  options.settings.clear();
  options.ticks.reset();
  options.seed = seed;
  options.paused = from.paused;
  options.real_time_factor = from.real_time_factor;
  options.restore_file.clear();
  options.any_build = false;
  options.branch.clear();
  options.faults_of.clear();
  auto experiment = LoadOrComplain(options.file, ChangesOf(options));
  if (!experiment) throw RunFolderError(fmt::format("the run cannot begin again: see '{}'", options.file));
  Manifest manifest = StartOfManifest(options, *experiment);
  manifest.domain = first.manifest.domain;
  manifest.reset_of = from;
  return {std::move(options), std::move(experiment), std::move(folder), std::move(manifest)};
}

// After `run`, the last one that came of `first`, has ended.
Begun NextOf(const Begun& first, const Begun& run, const RunSummary& ended, unsigned number)
{
  const ResetRequest& asked = *ended.reset;
  const ResetOrigin from{run.folder.Path(), ended.ticks, asked.paused, asked.real_time_factor};
  RunFolder folder(FolderOfReset(first.folder, number), first.experiment->name);
  if (!first.options.quiet)
    PrintError("reset at tick {}: it begins again with seed {}, in {}\n", ended.ticks, asked.seed, folder.Path());
  Begun next = BeginAgain(first, from, asked.seed, std::move(folder));
  next.folder.Write("experiment.xml", next.experiment->effective_xml);
  next.folder.Write("manifest.json", next.manifest.Text());
  return next;
}

// Why a run ended with the exit code of a failed experiment. Only experiment functions decide that.
std::string FailureOf(const Experiment& experiment)
{
  std::vector<std::string> names;
  for (const auto& functions : experiment.functions) names.push_back(Quoted(functions.id));
  return fmt::format("the experiment failed by its own measure: {}experiment functions {} ended it as failed",
                     names.size() > 1 ? "one of the " : "", Listed(names));
}

int Conclude(const RunSettings& options, const Experiment& experiment, const RunResult& result, const RunFolder& folder,
             Manifest& manifest)
{
  int exit_code = result.exit_code;
  const bool ended = result.summary && !result.summary->reset;
  if (ended && !options.expected_hash.empty() && exit_code == kExitDone &&
      result.summary->hash != std::stoull(options.expected_hash, nullptr, 16))
  {
    PrintError("the hash differs: expected {:0>16}, got {:016x}\n", options.expected_hash, result.summary->hash);
    exit_code = kExitHashDiffers;
  }

  manifest.ended = TimeStamp();
  manifest.exit_code = exit_code;
  manifest.failure = result.failure;
  if (exit_code == kExitExperimentFailed)
  {
    manifest.failure = FailureOf(experiment);
    PrintError("{}\n", manifest.failure);
  }
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
    PrintError("swarmanoid: {}\n", error.what());
    if (exit_code == kExitDone) exit_code = kExitProcessFailed;
  }
  if (!ended) return exit_code;
  std::fputs((FinishedLine(*result.summary) + "\n").c_str(), stdout);
  return ExitCodeWithOutput(exit_code);
}

// Told before anything is started.
bool EventsAreGood(const std::string& file, const Experiment& experiment)
{
  try
  {
    ReadEvents(file, experiment);
    return true;
  }
  catch (const ConfigurationError& error)
  {
    PrintError("{}\n", error.what());
    return false;
  }
}

// Checks --faults-of before anything is started.
void RefuseBadFaults(const RunSettings& options, const Experiment& experiment)
{
  if (options.faults_of.empty()) return;
  try
  {
    // An experiment without guards has no faults to repeat, but the run must be one of it.
    if (experiment.HasGuards())
      FaultsOfRun(options.faults_of, experiment, 0);
    else if (JournalReader(JournalFile(options.faults_of)).Start().origin.experiment != FingerprintOf(experiment))
      throw std::runtime_error("its journal is of another experiment, or of other settings of it");
  }
  catch (const std::runtime_error& error)
  {
    throw UsageError(fmt::format("--faults-of '{}': {}; name the folder of a run as a cluster that kept its journal",
                                 options.faults_of, error.what()));
  }
}

void RefuseContradictions(const RunSettings& options)
{
  if (options.any_build && options.restore_file.empty())
    throw UsageError("--any-build is about a checkpoint; name it with --restore");
  if (options.file.empty() && options.branch.empty())
    throw UsageError("name an experiment file, or a run to branch off with --branch RUN@TICK");
  if (!options.journal_budget.empty() && (options.single_process || !options.journal))
    throw UsageError("--journal-budget: the run keeps no journal; leave out --single-process and --no-journal");
  if (!options.key_file.empty() && options.insecure)
    throw UsageError("--key and --insecure: a run has a key, or lets anybody in; give one of them");
  if (!options.single_process) return;
  const std::string why = "; leave out --single-process to run a cluster";
  if (options.controller_hosts != 1) throw UsageError("--controller-hosts: a single process has one" + why);
  if (!options.hosts_file.empty() || !options.engine_hosts.empty())
    throw UsageError("--hosts and --engine-host: a single process runs on this machine" + why);
  if (options.domain) throw UsageError("--domain: a single process uses no DDS" + why);
  if (!options.key_file.empty()) throw UsageError("--key: a single process needs none" + why);
}

// Runs, and runs again as often as users reset it. `run` gets a run and returns how it ended. Returns the exit code of
// the last one.
int RunUntilEnd(Begun& first, const std::function<RunResult(Begun&)>& run)
{
  std::optional<Begun> next;
  for (unsigned resets = 1;; ++resets)
  {
    Begun& begun = next ? *next : first;
    const RunResult result = run(begun);
    const int exit_code = Conclude(begun.options, *begun.experiment, result, begun.folder, begun.manifest);
    if (!result.summary || !result.summary->reset) return exit_code;
    next = NextOf(first, begun, *result.summary, resets);
  }
}

std::optional<RunKey> KeyFor(const RunSettings& options)
{
  if (options.insecure) return std::nullopt;
  return options.key_file.empty() ? NewRunKey() : KeyOfFile(options.key_file);
}

int RunAsCluster(Begun& first, const WatchFunction& watch)
{
  const std::optional<RunKey> key = KeyFor(first.options);
  // The runs after resets have the same domain. It is kept until the end, so that no other run takes it.
  std::optional<FreeDomain> free_domain;
  if (!first.options.domain) first.options.domain = free_domain.emplace().Id();
  // Until the process ends: the last line may find no reader either.
  std::signal(SIGPIPE, SIG_IGN);
  // A signal that comes between two runs ends the second one.
  SignalDescriptor interrupts;
  const auto run = [&](Begun& begun)
  {
    const auto conclude = [&](const RunResult& result)
    { return Conclude(begun.options, *begun.experiment, result, begun.folder, begun.manifest); };
    return RunCluster(begun.options, *begun.experiment, begun.folder, begun.manifest, interrupts, key, watch, conclude);
  };
  return RunUntilEnd(first, run);
}

// Where the run comes from goes into its folder and onto the console.
void Begin(const Branch& branch, const Experiment& experiment, const RunFolder& folder, RunSettings& options,
           Manifest& manifest)
{
  branch.Install(options, experiment, folder.Path());
  manifest.branch_of = {branch.Of().run, branch.Of().tick, branch.Hash(), branch.FirstTick(), {}};
  for (const BranchChange& change : branch.Changes())
    manifest.branch_of->changes.push_back(change.path + ": " + change.value);
  if (options.quiet) return;
  PrintError("branch of {} at tick {}, hash {:016x}{}\n", branch.Of().run, branch.Of().tick, branch.Hash(),
             branch.FirstTick() == branch.Of().tick
                 ? ""
                 : fmt::format("; it begins at tick {}, the newest before it whose state can be saved whole",
                               branch.FirstTick()));
}

bool IsOfArgos3(const RunSettings& asked) { return std::filesystem::path(asked.file).extension() == ".argos"; }

// Loop functions of ARGoS3 may reach into controllers, which takes one process.
bool WantsOneProcess(const RunSettings& asked, const Experiment& experiment)
{
  return IsOfArgos3(asked) && !experiment.functions.empty() && !asked.single_process && asked.controller_hosts == 1 &&
         asked.hosts_file.empty() && asked.engine_hosts.empty() && !asked.domain;
}

}  // namespace

int RunExperiment(const RunSettings& given, const WatchFunction& watch)
{
  RequireReproducibleMath();
  RefuseContradictions(given);
  const RunSettings asked = given.branch.empty() ? given : SettingsOfBranch(given);
  auto experiment = LoadOrComplain(asked.file, ChangesOf(asked));
  if (!experiment) return kExitInvalidFile;
  std::vector<std::string> shown = asked.show;
  if (asked.ros2) shown.emplace_back("ros2");
  RunSettings options = asked;
  if (!shown.empty())
  {
    experiment = WithShown(*experiment, shown, asked.visualisations);
    options.visualisations = true;
  }
  if (WantsOneProcess(asked, *experiment))
  {
    options.single_process = true;
    PrintError(
        "{}: note: it has loop functions or user functions, so it runs in one process; `swarmanoid convert` makes an "
        "experiment "
        "that runs as a cluster if they reach into no controller\n",
        asked.file);
  }
  RefuseBadCheckpoints(options, *experiment);
  RefuseBadFaults(options, *experiment);
  if (!options.events.empty() && !EventsAreGood(options.events, *experiment)) return kExitInvalidFile;

  std::optional<Branch> branch;
  if (!options.branch.empty()) branch.emplace(options, *experiment);
  if (branch && branch->ExitCode() != kExitDone) return branch->ExitCode();

  try
  {
    const RunFolder folder(options.output_folder, experiment->name);
    Manifest manifest = StartOfManifest(options, *experiment);
    if (branch) Begin(*branch, *experiment, folder, options, manifest);
    folder.Write("experiment.xml", experiment->effective_xml);
    // The space server reads our files alone.
    if (IsOfArgos3(asked) || !shown.empty()) options.file = folder.File("experiment.xml");
    folder.Write("manifest.json", manifest.Text());
    folder.BecomeLatest();
    Begun first{std::move(options), std::move(experiment), folder, std::move(manifest)};
    if (!first.options.single_process) return RunAsCluster(first, watch);
    const auto run_here = [&](Begun& begun)
    {
      const ManifestAtDeath at_death(begun.folder, begun.manifest);
      return RunHere(begun.options, *begun.experiment, begun.folder, watch);
    };
    return RunUntilEnd(first, run_here);
  }
  catch (const RunFolderError& error)
  {
    throw UsageError(error.what());
  }
}

}  // namespace swarmanoid

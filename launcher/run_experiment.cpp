#include "launcher/run_experiment.h"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>

#include "common/activity/exit_codes.h"
#include "common/activity/print_error.h"
#include "common/checkpoint/checkpoint.h"
#include "common/checkpoint/library_builds.h"
#include "common/journal/journal_reader.h"
#include "common/math/reproducible_math.h"
#include "common/program/usage_error.h"
#include "launcher/cluster_run.h"
#include "launcher/load.h"
#include "launcher/manifest_at_death.h"
#include "launcher/original_command.h"
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
        "swarmanoid: warning: the checkpoint was taken with another build of {}: what it saved may mean "
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

int Conclude(const RunSettings& options, const RunResult& result, const RunFolder& folder, Manifest& manifest)
{
  int exit_code = result.exit_code;
  if (result.summary && !options.expected_hash.empty() && exit_code == kExitDone &&
      result.summary->hash != std::stoull(options.expected_hash, nullptr, 16))
  {
    PrintError("the hash differs: expected {:0>16}, got {:016x}\n", options.expected_hash, result.summary->hash);
    exit_code = kExitHashDiffers;
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
    PrintError("swarmanoid: {}\n", error.what());
    if (exit_code == kExitDone) exit_code = kExitProcessFailed;
  }
  if (result.summary) fmt::print("{}\n", FinishedLine(*result.summary));
  return exit_code;
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

// Likewise.
void RefuseBadFaults(const RunSettings& options, const Experiment& experiment)
{
  if (options.faults_of.empty()) return;
  try
  {
    FaultsOfRun(options.faults_of, experiment, 0);
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
  if (!options.single_process) return;
  const std::string why = "; leave out --single-process to run a cluster";
  if (options.controller_hosts != 1) throw UsageError("--controller-hosts: a single process has one" + why);
  if (!options.hosts_file.empty() || !options.engine_hosts.empty())
    throw UsageError("--hosts and --engine-host: a single process runs on this machine" + why);
  if (options.domain) throw UsageError("--domain: a single process uses no DDS" + why);
}

bool IsOfArgos3(const RunSettings& asked) { return std::filesystem::path(asked.file).extension() == ".argos"; }

// Loop functions of ARGoS3 may reach into controllers, which takes one process.
bool WantsOneProcess(const RunSettings& asked, const Experiment& experiment)
{
  return IsOfArgos3(asked) && !experiment.functions.empty() && !asked.single_process && asked.controller_hosts == 1 &&
         asked.hosts_file.empty() && asked.engine_hosts.empty() && !asked.domain;
}

}  // namespace

int RunExperiment(const RunSettings& asked, const WatchFunction& watch)
{
  RequireReproducibleMath();
  RefuseContradictions(asked);
  const auto experiment = LoadOrComplain(asked.file, ChangesOf(asked));
  if (!experiment) return kExitInvalidFile;
  RunSettings options = asked;
  if (WantsOneProcess(asked, *experiment))
  {
    options.single_process = true;
    PrintError(
        "{}: note: it has loop functions, so it runs in one process; `swarmanoid convert` makes an experiment "
        "that runs as a cluster if they reach into no controller\n",
        asked.file);
  }
  RefuseBadCheckpoints(options, *experiment);
  RefuseBadFaults(options, *experiment);
  if (!options.events.empty() && !EventsAreGood(options.events, *experiment)) return kExitInvalidFile;

  try
  {
    const RunFolder folder(options.output_folder, experiment->name);
    Manifest manifest = StartOfManifest(options, *experiment);
    folder.Write("experiment.xml", experiment->effective_xml);
    // The space server reads our files alone.
    if (IsOfArgos3(asked)) options.file = folder.File("experiment.xml");
    folder.Write("manifest.json", manifest.Text());
    const auto conclude = [&](const RunResult& result) { return Conclude(options, result, folder, manifest); };
    if (!options.single_process) return conclude(RunCluster(options, *experiment, folder, manifest, watch, conclude));
    const auto run_here = [&]
    {
      const ManifestAtDeath at_death(folder, manifest);
      return RunHere(options, *experiment, folder, watch);
    };
    return conclude(run_here());
  }
  catch (const RunFolderError& error)
  {
    throw UsageError(error.what());
  }
}

}  // namespace swarmanoid

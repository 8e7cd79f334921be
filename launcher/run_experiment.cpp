#include "launcher/run_experiment.h"

#include <fmt/format.h>

#include <csignal>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include "argos3/converter/convert.h"
#include "common/checkpoint/checkpoint.h"
#include "common/checkpoint/library_builds.h"
#include "common/configuration/wording.h"
#include "common/configuration/xml_reader.h"
#include "common/errors/exit_codes.h"
#include "common/errors/print_error.h"
#include "common/experiment/foreign_experiments.h"
#include "common/journal/journal_reader.h"
#include "common/math/reproducible_math.h"
#include "common/program/standard_output.h"
#include "common/program/usage_error.h"
#include "common/run/access/free_domain.h"
#include "launcher/branch.h"
#include "launcher/original_command.h"
#include "launcher/showing.h"
#include "launcher/supervision/bus_library.h"
#include "launcher/supervision/cluster_plan.h"
#include "launcher/supervision/cluster_run.h"
#include "launcher/supervision/prepared_run.h"
#include "launcher/supervision/single_run.h"
#include "launcher/system/network_namespace.h"
#include "simulation/load.h"
#include "space_server/event_log.h"

namespace swarmanoid
{
namespace
{

Manifest StartOfManifest(const RunRequest& request, const Experiment& experiment)
{
  Manifest manifest;
  manifest.experiment = experiment.name;
  manifest.file = std::filesystem::absolute(request->file).lexically_normal();
  manifest.experiment_hash = TextHash(experiment.effective_xml);
  manifest.seed = experiment.seed;
  manifest.command = OriginalCommand();
  manifest.domain = request->domain;
  for (const LibraryBuild& library : LibraryBuildsOf(experiment))
    manifest.libraries.emplace_back(library.name, library.build);
  manifest.started = TimeStamp();
  return manifest;
}

void ReadCheckpointOf(const RunRequest& request, const Experiment& experiment)
{
  const Checkpoint checkpoint =
      ReadCheckpoint(request->restore_file, experiment, {request->controller_hosts, request->any_build});
  const std::string difference = DifferenceOfBuilds(checkpoint.origin.libraries, LibraryBuildsOf(experiment));
  if (!difference.empty())
    PrintError(
        "swarmanoid: warning: the checkpoint was taken with {}: what it saved may mean "
        "something else to this one, and the run need not have the bits of one that was never interrupted\n",
        difference);
}

// Checks checkpoints before the folder of the run is made and processes are started.
void RefuseBadCheckpoints(const RunRequest& request, const Experiment& experiment)
{
  try
  {
    CheckCheckpointPeriod(request->checkpoint_every, experiment);
    if (!request->restore_file.empty()) ReadCheckpointOf(request, experiment);
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

// Makes the folder `output`, or a new one if that is empty, and writes experiment and manifest into it. `ready` changes
// the settings and the manifest once the folder exists.
PreparedRun Prepare(const RunRequest& request, std::unique_ptr<const Experiment> experiment, const std::string& output,
                    const std::function<void(RunSettings&, Manifest&, const RunFolder&)>& ready)
{
  const RunFolder folder(output, experiment->name);
  Manifest manifest = StartOfManifest(request, *experiment);
  RunRequest prepared = request.With(
      [&](RunSettings& settings)
      {
        settings.output_folder = folder.Path();
        ready(settings, manifest, folder);
      });
  const auto absolute = [](const std::string& path)
  { return path.empty() ? path : std::filesystem::absolute(path).lexically_normal().string(); };
  manifest.hash_log = absolute(prepared->hash_log);
  manifest.restored_from = absolute(prepared->restore_file);
  folder.Write("experiment.xml", experiment->effective_xml);
  folder.Write("manifest.json", manifest.Text());
  folder.BecomeLatest();
  return {std::move(prepared), std::move(experiment), folder, std::move(manifest)};
}

// The run after `run`, which a user has reset: the experiment of the first run at tick 0, as `swarmanoid run` with that
// seed begins it.
PreparedRun PrepareReset(const PreparedRun& first, const PreparedRun& run, const RunSummary& ended, unsigned number)
{
  const ResetRequest& reset = *ended.reset;
  const RunRequest request = first.request.With(
      [&](RunSettings& settings)
      {
        settings.file = first.folder.File("experiment.xml");
        settings.settings.clear();
        settings.ticks.reset();
        settings.seed = reset.seed;
        settings.paused = reset.paused;
        settings.real_time_factor = reset.real_time_factor;
        settings.restore_file.clear();
        settings.any_build = false;
        settings.faults_of.clear();
      });
  auto experiment = LoadOrComplain(request->file, request.Changes());
  if (!experiment) throw RunFolderError(fmt::format("the run cannot begin again: see '{}'", request->file));
  const std::string output = first.folder.File(fmt::format("reset-{}", number));
  return Prepare(request, std::move(experiment), output,
                 [&](RunSettings&, Manifest& manifest, const RunFolder& folder)
                 {
                   manifest.reset_of = {run.folder.Path(), ended.ticks, reset.paused, reset.real_time_factor};
                   if (!request->quiet)
                     PrintError("reset at tick {}: it begins again with seed {}, in {}\n", ended.ticks, reset.seed,
                                folder.Path());
                 });
}

// Completes the manifest and prints the last line. Returns the exit code of the run.
int Conclude(PreparedRun& run, const RunResult& result)
{
  Manifest& manifest = run.manifest;
  const std::string& expected = run.request->expected_hash;
  int exit_code = result.exit_code;
  const bool ended = result.summary && !result.summary->reset;
  if (ended && !expected.empty() && exit_code == kExitDone &&
      result.summary->hash != std::stoull(expected, nullptr, 16))
  {
    PrintError("the hash differs: expected {:0>16}, got {:016x}\n", expected, result.summary->hash);
    exit_code = kExitHashDiffers;
  }

  manifest.ended = TimeStamp();
  manifest.exit_code = exit_code;
  manifest.failure = result.failure;
  if (exit_code == kExitExperimentFailed)
  {
    manifest.failure = "the experiment failed by its own measure: " + result.summary->failure;
    PrintError("{}\n", manifest.failure);
  }
  if (result.summary)
  {
    manifest.ticks = result.summary->ticks;
    manifest.state_hash = result.summary->hash;
    manifest.wall_s = result.summary->wall_s;
    manifest.real_time_factor = result.summary->real_time_factor;
    manifest.threads = result.summary->threads;
    manifest.shared_ticks = result.summary->shared_ticks;
  }
  try
  {
    run.folder.Write("manifest.json", manifest.Text());
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

// Reports mistakes before anything is started.
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
void RefuseBadFaults(const RunRequest& request, const Experiment& experiment)
{
  if (request->faults_of.empty()) return;
  try
  {
    // An experiment without guards has no faults to repeat, but the run must still be one of this experiment.
    if (experiment.HasGuards())
      FaultsOfRun(request->faults_of, experiment, 0);
    else if (JournalReader(JournalFile(request->faults_of)).Start().origin.experiment != FingerprintOf(experiment))
      throw std::runtime_error("its journal is of another experiment, or of other settings of it");
  }
  catch (const std::runtime_error& error)
  {
    throw UsageError(fmt::format("--faults-of '{}': {}; name the folder of a run as a cluster that kept its journal",
                                 request->faults_of, error.what()));
  }
}

// Runs, and runs again as often as users reset it. `run` returns how a run ended. Returns the exit code of the last
// one.
int RunUntilEnd(PreparedRun& first, const std::function<RunResult(PreparedRun&)>& run)
{
  std::optional<PreparedRun> next;
  for (unsigned resets = 1;; ++resets)
  {
    PreparedRun& current = next ? *next : first;
    const RunResult result = run(current);
    const int exit_code = Conclude(current, result);
    if (!result.summary || !result.summary->reset) return exit_code;
    next = PrepareReset(first, current, *result.summary, resets);
  }
}

std::optional<RunKey> KeyFor(const RunSettings& settings)
{
  if (settings.insecure) return std::nullopt;
  return settings.key_file.empty() ? NewRunKey() : KeyOfFile(settings.key_file);
}

int RunAsCluster(PreparedRun& first)
{
  const std::optional<RunKey> key = KeyFor(first.request.Settings());
  // The runs after resets have the same domain. It is kept until the end, so that no other run takes it.
  std::optional<FreeDomain> free_domain;
  if (!first.request->domain)
    first.request = first.request.With([&](RunSettings& settings) { settings.domain = free_domain.emplace().Id(); });
  first.manifest.domain = first.request->domain;
  // The signal stays ignored until the process ends, since the last line may have no reader either.
  std::signal(SIGPIPE, SIG_IGN);
  // A signal between two runs ends the second one.
  SignalDescriptor interrupts;
  return RunUntilEnd(first,
                     [&](PreparedRun& run)
                     {
                       const auto conclude = [&run](const RunResult& result) { return Conclude(run, result); };
                       const ClusterPlan plan = MakePlan(run.request, *run.experiment);
                       return RunCluster(plan, run, key, interrupts, conclude);
                     });
}

// Runs in this process, so that users can watch and steer the run from outside as they do a cluster.
int RunHereOnBus(PreparedRun& first)
{
  if (first.request->isolated) IsolateNetwork();
  std::optional<FreeDomain> free_domain;
  try
  {
    const int domain = free_domain.emplace().Id();
    first.request = first.request.With([&](RunSettings& settings) { settings.domain = domain; });
    first.manifest.domain = domain;
    first.folder.Write("manifest.json", first.manifest.Text());
  }
  catch (const BusError& error)
  {
    PrintError("no visualiser can be attached to this run: {}\n", error.what());
    return RunUntilEnd(first, [](PreparedRun& run) { return RunHere(run); });
  }
  const std::optional<RunKey> key = KeyFor(first.request.Settings());
  return RunUntilEnd(first,
                     [&](PreparedRun& run)
                     {
                       const std::unique_ptr<RunLink> link = LoadBusLibrary().LinkOf(run, key);
                       return RunHere(run, link.get());
                     });
}

// The folder and the terminal get the origin of the run.
void Install(const Branch& branch, const Experiment& experiment, const RunFolder& folder, RunSettings& settings,
             Manifest& manifest)
{
  branch.Install(settings, experiment, folder.Path());
  manifest.branch_of = {branch.Of().run, branch.Of().tick, branch.Hash(), branch.FirstTick(), {}};
  for (const BranchChange& change : branch.Changes())
    manifest.branch_of->changes.push_back(change.path + ": " + change.value);
  if (settings.quiet) return;
  PrintError("branch of {} at tick {}, hash {:016x}{}\n", branch.Of().run, branch.Of().tick, branch.Hash(),
             branch.FirstTick() == branch.Of().tick
                 ? ""
                 : fmt::format("; it begins at tick {}, the newest before it whose state can be saved whole",
                               branch.FirstTick()));
}

// Returns whether the run needs one process: loop functions of ARGoS3 may access controllers.
bool WantsOneProcess(const RunRequest& request, const Experiment& experiment, bool is_of_argos3)
{
  return is_of_argos3 && !experiment.functions.empty() && !request->single_process && request->controller_hosts == 1 &&
         request->hosts_file.empty() && request->engine_hosts.empty() && !request->domain;
}

}  // namespace

int RunExperiment(RunRequest request)
{
  RequireReproducibleMath();
  if (!request->branch.empty()) request = RequestOfBranch(request);
  if (!request->visualisations && request->show.empty()) LetUserFunctionsBeMissing();
  auto experiment = LoadOrComplain(request->file, request.Changes());
  if (!experiment) return kExitInvalidFile;
  std::vector<std::string> shown = request->show;
  if (request->ros2) shown.emplace_back("ros2");
  if (!shown.empty())
  {
    experiment = WithShown(*experiment, shown, request->visualisations);
    request = request.With([](RunSettings& settings) { settings.visualisations = true; });
  }
  const std::string text = ReadTextFile(request->file);
  const bool is_of_argos3 = IsForeignExperiment(text);
  if (is_of_argos3 && request->real_time_factor == 0 && KeepsRealTime(text))
    request = request.With([](RunSettings& settings) { settings.real_time_factor = 1; });
  const bool needs_one_process = WantsOneProcess(request, *experiment, is_of_argos3);
  if (needs_one_process)
  {
    request = request.With([](RunSettings& settings) { settings.single_process = true; });
    PrintError(
        "{}: note: it has loop functions, user functions or registered devices, so it runs in one process; `swarmanoid "
        "convert` makes an experiment that runs as a cluster if they reach into no controller\n",
        request->file);
  }
  RefuseBadCheckpoints(request, *experiment);
  RefuseBadFaults(request, *experiment);
  if (!request->events.empty() && !EventsAreGood(request->events, *experiment)) return kExitInvalidFile;

  std::optional<Branch> branch;
  if (!request->branch.empty()) branch.emplace(request.Settings(), *experiment);
  if (branch && branch->ExitCode() != kExitDone) return branch->ExitCode();

  try
  {
    const Experiment& loaded = *experiment;
    PreparedRun run = Prepare(request, std::move(experiment), request->output_folder,
                              [&](RunSettings& settings, Manifest& manifest, const RunFolder& folder)
                              {
                                if (branch) Install(*branch, loaded, folder, settings, manifest);
                                // The space server reads only files of Swarmanoid.
                                if (is_of_argos3 || !shown.empty()) settings.file = folder.File("experiment.xml");
                              });
    if (needs_one_process) return RunHereOnBus(run);
    return run.request->single_process ? RunUntilEnd(run, [](PreparedRun& one) { return RunHere(one); })
                                       : RunAsCluster(run);
  }
  catch (const RunFolderError& error)
  {
    throw UsageError(error.what());
  }
}

}  // namespace swarmanoid

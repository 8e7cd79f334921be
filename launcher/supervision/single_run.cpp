#include "launcher/supervision/single_run.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>

#include "common/activity/failure_report.h"
#include "common/errors/exit_codes.h"
#include "common/errors/print_error.h"
#include "common/journal/journal_reader.h"
#include "common/limits/limits.h"
#include "common/logging/log.h"
#include "common/program/interrupts.h"
#include "common/program/usage_error.h"
#include "launcher/supervision/manifest_at_death.h"
#include "launcher/supervision/progress_display.h"
#include "simulation/run_link.h"
#include "simulation/single_process.h"

namespace swarmanoid
{

void ApplyLimitsHere(const RunSettings& settings)
{
  std::function<void(const std::string&, double)> stalled;
  if (!settings.quiet)
    stalled = [](const std::string& activity, double seconds)
    { PrintError("waiting since {} for {}\n", DurationText(seconds), activity); };
  ApplyLimits(LimitsOf(settings), stalled);
}

bool HasLoopFunctions(const Experiment& experiment)
{
  return std::ranges::any_of(experiment.functions,
                             [](const auto& functions) { return functions.tag == "argos3_loop_functions"; });
}

RunResult RunHere(const PreparedRun& prepared, RunLink* link)
{
  using Clock = ProgressDisplay::Clock;

  const RunRequest& request = prepared.request;
  const Experiment& experiment = *prepared.experiment;
  const ManifestAtDeath at_death(prepared.folder, prepared.manifest);
  CatchInterrupts(SecondInterrupt::kKills);
  ReportDeaths("swarmanoid");
  OpenLog({.process = "swarmanoid", .folder = prepared.folder.Path()});
  ApplyLimitsHere(request.Settings());
  ProgressDisplay display(ProgressDisplay::StyleFor(STDERR_FILENO, request->quiet), STDERR_FILENO);
  const Clock::time_point start = Clock::now();

  SingleProcessOptions run;
  static_cast<SimulatorOptions&>(run) = request.Settings();
  run.event_log = prepared.folder.File("events.csv");
  // Users of loop functions want to look back, too.
  if (request->journal && HasLoopFunctions(experiment))
    run.companions.journal_file = JournalFile(prepared.folder.Path());
  run.companions.link = link;
  run.stop = &InterruptFlag();
  run.companions.watch = request.Watch();
  run.may_reset = !request.Watch();
  run.progress = [&](std::uint64_t tick)
  {
    const Clock::time_point now = Clock::now();
    RunProgress progress;
    progress.phase = "running";
    progress.tick = tick;
    progress.max = experiment.max_clock;
    progress.real_time_factor =
        static_cast<double>(tick) * experiment.TickSeconds() / std::chrono::duration<double>(now - start).count();
    display.Show(progress, now);
  };

  RunResult result;
  try
  {
    result.summary = RunSingleProcess(experiment, run);
    if (result.summary->failed) result.exit_code = kExitExperimentFailed;
    if (result.summary->interrupted) result.exit_code = kExitInterrupted;
  }
  catch (const UsageError& error)
  {
    result.exit_code = kExitUsage;
    result.failure = error.what();
  }
  catch (const ConfigurationError& error)
  {
    result.exit_code = kExitInvalidFile;
    result.failure = error.what();
  }
  catch (const std::exception& error)
  {
    result.exit_code = kExitProcessFailed;
    result.failure = error.what();
  }
  if (link != nullptr) link->Fail(result.failure);
  display.Clear();
  if (!result.failure.empty()) PrintError("{}\n", result.failure);
  return result;
}

}  // namespace swarmanoid

#include "launcher/single_run.h"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>

#include "common/activity/failure_report.h"
#include "common/activity/limits.h"
#include "launcher/exit_codes.h"
#include "launcher/processes/progress_display.h"
#include "launcher/usage_error.h"

namespace swarmanoid
{
namespace
{

std::atomic<bool> stop_asked = false;
static_assert(std::atomic<bool>::is_always_lock_free);

// The first signal ends the run after its tick, a second one at once.
void CatchFirstInterrupt()
{
  struct sigaction action
  {
  };
  action.sa_handler = [](int)
  {
    if (!stop_asked.exchange(true)) return;
    // Who does not end his step is told.
    DieInterrupted();
  };
  action.sa_flags = static_cast<int>(SA_RESTART | SA_ONSTACK);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaction(signal, &action, nullptr);
}

}  // namespace

RunResult RunHere(const RunOptions& options, const Experiment& experiment, const RunFolder& folder,
                  const std::function<void(CSimulator&)>& watch)
{
  using Clock = ProgressDisplay::Clock;

  CatchFirstInterrupt();
  ReportDeaths("swarmanoid");
  std::function<void(const std::string&, double)> stalled;
  if (!options.quiet)
    stalled = [](const std::string& activity, double seconds)
    { fmt::print(stderr, "waiting since {} for {}\n", DurationText(seconds), activity); };
  ApplyLimits(options.limits, stalled);
  ProgressDisplay display(ProgressDisplay::StyleFor(STDERR_FILENO, options.quiet), STDERR_FILENO);
  const Clock::time_point start = Clock::now();

  SingleProcessOptions run;
  run.output_folder = folder.Path();
  run.hash_log = options.hash_log;
  run.real_time_factor = options.real_time;
  run.paused = options.paused;
  run.event_log = folder.File("events.csv");
  run.events = options.events;
  run.visualisations = !options.no_visualisers;
  run.checkpoint_every = options.checkpoint_every;
  run.restore_file = options.restore_file;
  run.stop = &stop_asked;
  run.watch = watch;
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
    if (result.summary->failed) result.exit_code = kExperimentFailed;
    if (result.summary->interrupted) result.exit_code = kInterruptedByUser;
  }
  catch (const UsageError& error)
  {
    result.exit_code = kUsage;
    result.failure = error.what();
  }
  catch (const ConfigurationError& error)
  {
    result.exit_code = kInvalid;
    result.failure = error.what();
  }
  catch (const std::exception& error)
  {
    result.exit_code = kProcessFailed;
    result.failure = error.what();
  }
  display.Clear();
  if (!result.failure.empty()) fmt::print(stderr, "{}\n", result.failure);
  return result;
}

}  // namespace swarmanoid

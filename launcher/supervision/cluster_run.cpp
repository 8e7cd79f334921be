#include "launcher/supervision/cluster_run.h"

#include <fmt/format.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <thread>

#include "common/activity/failure_report.h"
#include "common/errors/exit_codes.h"
#include "common/errors/print_error.h"
#include "common/program/program.h"
#include "common/run/access/run_directory.h"
#include "common/threads/start_thread.h"
#include "launcher/supervision/bus_library.h"
#include "launcher/supervision/in_process_server.h"
#include "launcher/supervision/manifest_at_death.h"
#include "launcher/supervision/run_actors.h"
#include "launcher/supervision/single_run.h"
#include "launcher/supervision/supervisor.h"
#include "launcher/system/installation.h"
#include "launcher/system/network_namespace.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;

void Complain(const ClusterOutcome& outcome)
{
  if (outcome.reason.empty()) return;
  PrintError("{}\n", outcome.reason);
  for (const std::string& line : outcome.log_lines) PrintError("  | {}\n", line);
}

RunResult ResultOf(const ClusterOutcome& outcome)
{
  // The codes are in the order of ClusterOutcome::Kind.
  constexpr std::array kCodes{kExitDone, kExitExperimentFailed, kExitInterrupted, kExitProcessFailed, kExitInvalidFile};
  RunResult result{.exit_code = kCodes[outcome.kind], .summary = {}, .failure = outcome.reason};
  if (!outcome.finished) return result;
  const auto& [ticks, entities, hash, wall_s, real_time_factor, failure] = *outcome.finished;
  result.summary = {ticks, entities, hash, wall_s, real_time_factor};
  result.summary->interrupted = outcome.kind == ClusterOutcome::kInterrupted;
  result.summary->failed = outcome.kind == ClusterOutcome::kUnsuccessful;
  result.summary->failure = failure;
  if (outcome.reset && outcome.kind == ClusterOutcome::kFinished)
    result.summary->reset = ResetRequest{outcome.reset->seed, outcome.reset->paused, outcome.reset->real_time_factor};
  return result;
}

// Ends the process while the user's watch function, which never returns, still holds the thread of the run.
[[noreturn]] void LeaveStuck(const ClusterOutcome& outcome, const std::function<int(const RunResult&)>& conclude)
{
  RemoveDeadRuns();
  Complain(outcome);
  if (const std::string activity = CurrentActivity(); !activity.empty())
    PrintError("{} does not return: this process ends without it\n", activity);
  LeaveAtOnce(conclude(ResultOf(outcome)));
}

// Runs the supervisor in a thread of its own, for which the signals are blocked already. This thread is the space
// server's.
ClusterOutcome ServeAndSupervise(const std::function<ClusterOutcome(ProcessSpawner&)>& supervise,
                                 const std::optional<RunKey>& key, const WatchFunction& watch,
                                 const std::function<int(const RunResult&)>& conclude)
{
  const BusLibrary& bus = LoadBusLibrary();
  InProcessServer server;
  ClusterOutcome outcome;
  std::thread supervising = StartThread("supervises the run",
                                        [&]
                                        {
                                          outcome = supervise(server);
                                          if (server.IsStuck()) LeaveStuck(outcome, conclude);
                                          server.Cancel();
                                        });
  server.Run([&](const auto& words, int status, const auto& stop, const auto& abandon)
             { return bus.Serve(words, status, stop, abandon, key, watch); });
  supervising.join();
  return outcome;
}

// Returns the clusters of this machine whose processes share one core, counted by core.
std::map<int, std::size_t> RunsByCore()
{
  std::map<int, std::size_t> runs;
  std::error_code error;
  for (fs::directory_iterator process("/proc", error), end; !error && process != end; process.increment(error))
  {
    const pid_t pid = std::atoi(process->path().filename().c_str());
    std::string program;  // empty for a process that has ended and was not awaited
    cpu_set_t cores;
    if (pid <= 0 || !std::getline(std::ifstream(process->path() / "cmdline"), program, '\0') ||
        fs::path(program).filename() != "space_server" || sched_getaffinity(pid, sizeof cores, &cores) != 0 ||
        CPU_COUNT(&cores) != 1)
      continue;
    int core = 0;
    while (!CPU_ISSET(core, &cores)) ++core;
    ++runs[core];
  }
  return runs;
}

// Returns the core for a cluster whose processes share one. Two clusters on one core would starve each other while
// other cores are idle. Clusters that start at the same time do not see each other, but they have different domains.
std::vector<int> ChooseCore(int domain)
{
  std::vector<int> cores = AvailableCores();
  if (cores.empty()) return {};
  std::rotate(cores.begin(), cores.begin() + domain % static_cast<std::ptrdiff_t>(cores.size()), cores.end());
  std::map<int, std::size_t> runs = RunsByCore();
  return {*std::ranges::min_element(cores, {}, [&](int core) { return runs[core]; })};
}

}  // namespace

RunResult RunCluster(const ClusterPlan& plan, PreparedRun& run, const std::optional<RunKey>& key,
                     SignalDescriptor& interrupts, const std::function<int(const RunResult&)>& conclude)
{
  const RunRequest& request = run.request;
  RemoveDeadRuns();
  if (request->isolated) IsolateNetwork();

  for (const PlannedProcess& process : plan.processes)
    run.manifest.processes.emplace_back(process.name, process.log_path);
  run.folder.Write("manifest.json", run.manifest.Text());

  ProgressDisplay display(ProgressDisplay::StyleFor(STDERR_FILENO, request->quiet), STDERR_FILENO);
  const std::size_t cores = plan.machines.AllHere() ? AvailableCores().size() : 0;
  const std::string note = NoteAboutControllerHosts(request->controller_hosts, plan.controlled_robots, cores);
  if (!note.empty() && !request->quiet) display.Note(note);

  const RunActors actors(*run.experiment);
  run.experiment.reset();  // with many robots it takes much memory
  const ClusterStart start{.program_folder = ProgramFolder(),
                           .environment = EnvironmentOf(LimitsOf(request.Settings())),
                           .cores = ChooseCore(plan.bus.domain),
                           .key = key ? TextOfKey(*key) + "\n" : std::string()};
  const SupervisedRun supervised{
      .command_of = [&start](const ClusterPlan& now, std::size_t process, const Incarnation& incarnation)
      { return CommandOf(now, start, process, incarnation); },
      .actor_of = [&actors](Actor::Kind kind, std::uint32_t number) { return actors.Of(kind, number); },
      .may_fail = [&actors](std::uint32_t robot) { return actors.MayFail(robot); },
      .retries = request->Replaces() ? request->retries : 0};
  SupervisorTimes times;
  if (supervised.retries > 0) times.stopped = std::chrono::milliseconds(static_cast<long>(1000 * request->lease_s));
  const auto supervise = [&](ProcessSpawner& spawner)
  { return Supervisor(spawner, interrupts, display, STDOUT_FILENO, supervised, times).Run(plan); };

  ClusterOutcome outcome;
  if (request.Watch())
  {
    const ManifestAtDeath at_death(run.folder, run.manifest);
    ApplyLimitsHere(request.Settings());
    outcome = ServeAndSupervise(supervise, key, request.Watch(), conclude);
  }
  else
  {
    SystemSpawner spawner;
    outcome = supervise(spawner);
  }
  run.manifest.processes = outcome.processes;
  RemoveDeadRuns();
  Complain(outcome);
  return ResultOf(outcome);
}

}  // namespace swarmanoid

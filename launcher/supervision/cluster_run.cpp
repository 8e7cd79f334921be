#include "launcher/supervision/cluster_run.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <optional>
#include <string_view>
#include <thread>

#include "common/activity/exit_codes.h"
#include "common/activity/failure_report.h"
#include "common/activity/print_error.h"
#include "common/bus/membership/run_directory.h"
#include "common/bus/membership/worker_world.h"
#include "common/experiment/actors.h"
#include "common/messages/assignment.h"
#include "common/program/program.h"
#include "common/program/usage_error.h"
#include "common/threads/start_thread.h"
#include "launcher/network_namespace.h"
#include "launcher/supervision/cluster_plan.h"
#include "launcher/supervision/in_process_server.h"
#include "launcher/supervision/manifest_at_death.h"
#include "launcher/supervision/supervisor.h"
#include "simulation/register_all.h"
#include "space_server/cluster/server_main.h"

namespace swarmanoid
{
namespace
{

void Complain(const ClusterOutcome& outcome)
{
  if (outcome.reason.empty()) return;
  PrintError("{}\n", outcome.reason);
  for (const std::string& line : outcome.log_lines) PrintError("  | {}\n", line);
}

RunResult ResultOf(const ClusterOutcome& outcome)
{
  RunResult result;
  switch (outcome.kind)
  {
    case ClusterOutcome::kFinished:
      result.exit_code = kExitDone;
      break;
    case ClusterOutcome::kUnsuccessful:
      result.exit_code = kExitExperimentFailed;
      break;
    case ClusterOutcome::kInterrupted:
      result.exit_code = kExitInterrupted;
      break;
    case ClusterOutcome::kFailed:
      result.exit_code = kExitProcessFailed;
      break;
    case ClusterOutcome::kInvalid:
      result.exit_code = kExitInvalidFile;
      break;
  }
  result.failure = outcome.reason;
  if (!outcome.finished) return result;
  result.summary.emplace();
  result.summary->ticks = outcome.finished->ticks;
  result.summary->entities = outcome.finished->entities;
  result.summary->hash = outcome.finished->hash;
  result.summary->wall_s = outcome.finished->wall_s;
  result.summary->real_time_factor = outcome.finished->real_time_factor;
  result.summary->failed = outcome.kind == ClusterOutcome::kUnsuccessful;
  if (outcome.reset && outcome.kind == ClusterOutcome::kFinished)
    result.summary->reset = ResetRequest{outcome.reset->seed, outcome.reset->paused, outcome.reset->real_time_factor};
  result.summary->interrupted = outcome.kind == ClusterOutcome::kInterrupted;
  return result;
}

// The space server's program, with a function of the user that looks at each tick.
int ServeHere(std::vector<std::string> words, int status, const std::atomic<bool>& stop,
              const std::atomic<bool>& abandon, const std::optional<RunKey>& key, const WatchFunction& watch)
{
  ServerOptions options;
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  return RunProgram(
      {"space_server", "", "", RegisterBuiltins, false, true}, static_cast<int>(arguments.size()), arguments.data(),
      [&](CLI::App& app) { AddServerOptions(app, options); },
      [&]
      {
        options.status_fd = status;
        options.bus.key = key;
        options.stop = &stop;
        options.abandon = &abandon;
        options.watch = [watch](SpaceServer& server)
        {
          CSimulator simulator = WatchedSimulator::Of(server);
          watch(simulator);
        };
        return Serve(options);
      });
}

void Isolate(const RunSettings& options, const Experiment& experiment, const Hosts& hosts, bool watched)
{
  if (!hosts.AllHere()) throw UsageError("--isolated: the run has processes on other machines");
  if (watched) throw UsageError("--isolated: the space server is this process, which would lose its network");
  // What is of no use without others in the network.
  constexpr std::array<std::pair<std::string_view, std::string_view>, 3> kReached{
      {{"web_render", "no browser could reach the page of"},
       {"foxglove_render", "nobody could open a connection to"},
       {"ros2_render", "no node of ROS 2 could hear"}}};
  for (const RenderConfiguration& render : experiment.visualisations)
    for (const auto& [tag, why] : kReached)
      if (options.visualisations && render.tag == tag)
        throw UsageError(fmt::format("--isolated: {} {}; give --no-visualisers, or leave --isolated out", why,
                                     VisualiserName(render)));
  for (const ControllerConfiguration& controller : experiment.controllers)
    if (controller.tag == "ros2_controller")
      throw UsageError(fmt::format(
          "--isolated: no node of ROS 2 could reach the robots of the controller '{}'; leave it out", controller.id));
  IsolateNetwork();
}

// The thread of the run does not come back.
[[noreturn]] void LeaveStuck(const ClusterOutcome& outcome, const std::function<int(const RunResult&)>& conclude)
{
  RemoveDeadRuns();
  Complain(outcome);
  if (const std::string activity = CurrentActivity(); !activity.empty())
    PrintError("{} does not return: this process ends without it\n", activity);
  LeaveAtOnce(conclude(ResultOf(outcome)));
}

// Watched, the space server's role is this thread's; the supervisor has one of its own, for which the signals are
// blocked already.
ClusterOutcome RunWatched(const std::vector<MemberPlan>& plans, SignalDescriptor& interrupts, ProgressDisplay& display,
                          const ActorNames& actor_of, const SupervisorTimes& times, unsigned retries,
                          const std::optional<RunKey>& key, const WatchFunction& watch,
                          const std::function<int(const RunResult&)>& conclude)
{
  InProcessServer server;
  ClusterOutcome outcome;
  std::thread supervising = StartThread("supervises the run",
                                        [&]
                                        {
                                          outcome = Supervisor(server, interrupts, display, STDOUT_FILENO, actor_of,
                                                               times, Supervisor::Clock::now, retries)
                                                        .Run(plans);
                                          if (server.IsStuck()) LeaveStuck(outcome, conclude);
                                          server.Cancel();
                                        });
  server.Run([&](const auto& words, int status, const auto& stop, const auto& abandon)
             { return ServeHere(words, status, stop, abandon, key, watch); });
  supervising.join();
  return outcome;
}

}  // namespace

RunResult RunCluster(const RunSettings& options, const Experiment& experiment, const RunFolder& folder,
                     Manifest& manifest, SignalDescriptor& interrupts, const std::optional<RunKey>& key,
                     const WatchFunction& watch, const std::function<int(const RunResult&)>& conclude)
{
  Hosts hosts = options.hosts_file.empty() ? Hosts() : Hosts::FromFile(options.hosts_file);
  for (const std::string& setting : options.engine_hosts) hosts.AddEngine(setting);
  if (watch && !hosts.HostOf("space_server", "").empty())
    throw UsageError("--hosts: the space server is this process, which looks at each tick; leave space_server out");
  RemoveDeadRuns();
  if (options.isolated) Isolate(options, experiment, hosts, watch != nullptr);

  manifest.domain = options.domain;
  const Assignment assignment = MakeAssignment(experiment, options.controller_hosts);
  RequirePlaces(options, experiment, assignment, hosts);
  const auto plan_with = [&](const Assignment& of)
  { return PlanCluster(options, experiment, of, hosts, folder, *manifest.domain, key); };
  std::vector<MemberPlan> plans = plan_with(assignment);
  for (const MemberPlan& plan : plans) manifest.processes.emplace_back(plan.command.name, plan.log_path);
  folder.Write("manifest.json", manifest.Text());

  ProgressDisplay display(ProgressDisplay::StyleFor(STDERR_FILENO, options.quiet), STDERR_FILENO);
  if (!options.quiet)
    if (const std::string note = NoteAboutControllerHosts(options.controller_hosts, assignment.table.of_robots.size(),
                                                          hosts.AllHere() ? AvailableCores().size() : 0);
        !note.empty())
      display.Note(note);
  const ActorNames actor_of = [&experiment](Actor::Kind kind, std::uint32_t number)
  { return ActorOf(experiment, kind, number); };
  const unsigned retries = options.Replaces() ? options.retries : 0;
  SupervisorTimes times;
  if (retries > 0) times.stopped = std::chrono::milliseconds(static_cast<long>(1000 * options.lease_s));
  ClusterOutcome outcome;
  if (watch)
  {
    const ManifestAtDeath at_death(folder, manifest);
    ApplyLimitsHere(options);
    plans.front().replacement = nullptr;  // it is this process
    outcome = RunWatched(plans, interrupts, display, actor_of, times, retries, key, watch, conclude);
  }
  else
  {
    SystemSpawner spawner;
    Supervisor supervisor(spawner, interrupts, display, STDOUT_FILENO, actor_of, times, Supervisor::Clock::now,
                          retries);
    supervisor.SetPlanAgain(
        [&](unsigned controller_hosts)
        {
          std::vector<MemberPlan> others = plan_with(MakeAssignment(experiment, controller_hosts));
          for (const MemberPlan& plan : others)
            if (const std::pair process(plan.command.name, plan.log_path);
                std::ranges::find(manifest.processes, process) == manifest.processes.end())
              manifest.processes.push_back(process);
          return others;
        });
    outcome = supervisor.Run(plans);
  }
  RemoveDeadRuns();
  Complain(outcome);
  return ResultOf(outcome);
}

}  // namespace swarmanoid

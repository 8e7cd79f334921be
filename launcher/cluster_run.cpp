#include "launcher/cluster_run.h"

#include <fmt/format.h>
#include <unistd.h>

#include <csignal>
#include <optional>

#include "common/bus/domain.h"
#include "common/bus/run_directory.h"
#include "common/program/exit_codes.h"
#include "common/space/assignment.h"
#include "launcher/cluster_plan.h"
#include "launcher/processes/supervisor.h"

namespace swarmanoid
{
namespace
{

void Complain(const ClusterOutcome& outcome)
{
  fmt::print(stderr, "{}\n", outcome.reason);
  for (const std::string& line : outcome.log_lines) fmt::print(stderr, "  | {}\n", line);
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
  result.summary->interrupted = outcome.kind == ClusterOutcome::kInterrupted;
  return result;
}

}  // namespace

RunResult RunCluster(const RunSettings& options, const Experiment& experiment, const RunFolder& folder,
                     Manifest& manifest)
{
  Hosts hosts = options.hosts_file.empty() ? Hosts() : Hosts::FromFile(options.hosts_file);
  for (const std::string& setting : options.engine_hosts) hosts.AddEngine(setting);
  RemoveDeadRuns();

  // Kept until the end, so that no other run takes it.
  std::optional<FreeDomain> free_domain;
  if (!options.domain) free_domain.emplace();
  manifest.domain = options.domain ? *options.domain : free_domain->Id();
  const Assignment assignment = MakeAssignment(experiment, options.controller_hosts);
  const std::vector<MemberPlan> plans = PlanCluster(options, experiment, assignment, hosts, folder, *manifest.domain);
  for (const MemberPlan& plan : plans) manifest.processes.emplace_back(plan.command.name, plan.log_path);
  folder.Write("manifest.json", manifest.Text());

  // Until the process ends: the last line may find no reader either.
  std::signal(SIGPIPE, SIG_IGN);
  SystemSpawner spawner;
  Interrupts interrupts;
  ProgressDisplay display(ProgressDisplay::StyleFor(STDERR_FILENO, options.quiet), STDERR_FILENO);
  Supervisor supervisor(spawner, interrupts, display, STDOUT_FILENO);
  const ClusterOutcome outcome = supervisor.Run(plans);
  RemoveDeadRuns();
  if (!outcome.reason.empty()) Complain(outcome);
  return ResultOf(outcome);
}

}  // namespace swarmanoid

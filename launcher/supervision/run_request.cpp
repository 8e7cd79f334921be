#include "launcher/supervision/run_request.h"

#include <initializer_list>
#include <string>

#include "common/program/usage_error.h"
#include "space_server/worker_placement.h"

namespace swarmanoid
{
namespace
{

Machines MachinesOf(const RunSettings& s)
{
  Machines machines = s.hosts_file.empty() ? Machines() : Machines::FromFile(s.hosts_file);
  for (const std::string& setting : s.engine_hosts) machines.AddEngine(setting);
  return machines;
}

// Throws UsageError for the first pair of options that contradict each other.
void RefuseContradictions(const RunSettings& s, const Machines& machines, bool watched)
{
  const bool branches = !s.branch.empty();
  const bool no_journal = s.single_process || !s.journal;
  const bool names_machines = !s.hosts_file.empty() || !s.engine_hosts.empty();
  const bool server_elsewhere = machines.MachineOf("space_server", "") != kHere;
  const std::string cluster = "; leave out --single-process to run a cluster";
  const std::initializer_list<std::pair<bool, std::string>> mistakes{
      {s.any_build && s.restore_file.empty() && !branches, "--any-build is about a checkpoint; name it with --restore"},
      {s.file.empty() && !branches, "name an experiment file, or a run to branch off with --branch RUN@TICK"},
      {!s.journal_budget.empty() && no_journal,
       "--journal-budget: the run keeps no journal; leave out --single-process and --no-journal"},
      {!s.key_file.empty() && s.insecure,
       "--key and --insecure: a run has a key, or lets anybody in; give one of them"},
      {s.single_process && s.controller_hosts != 1, "--controller-hosts: a single process has one" + cluster},
      {s.single_process && names_machines,
       "--hosts and --engine-host: a single process runs on this machine" + cluster},
      {s.single_process && s.domain, "--domain: a single process uses no DDS" + cluster},
      {s.single_process && !s.key_file.empty(), "--key: a single process needs none" + cluster},
      {branches && !s.restore_file.empty(), "--branch: a run begins with one state; leave out --restore"},
      {branches && !s.faults_of.empty(),
       "--branch: controllers fail as in the run that it is of; leave out --faults-of"},
      {watched && server_elsewhere,
       "--hosts: the space server is this process, which looks at each tick; leave space_server out"},
      {s.isolated && !machines.AllHere(), "--isolated: the run has processes on other machines"},
      {s.isolated && watched && !s.single_process,
       "--isolated: the space server is this process, which would lose its network"},
  };
  for (const auto& [is_made, text] : mistakes)
    if (is_made) throw UsageError(text);
}

}  // namespace

RunRequest::RunRequest(RunSettings settings, WatchFunction watch)
    : settings_(std::move(settings)),
      changes_(ChangesOf(settings_)),
      machines_(MachinesOf(settings_)),
      watch_(std::move(watch))
{
  RefuseContradictions(settings_, machines_, watch_ != nullptr);
}

RunRequest RunRequest::With(const std::function<void(RunSettings&)>& change) const
{
  RunRequest changed = *this;
  change(changed.settings_);
  changed.changes_ = ChangesOf(changed.settings_);
  return changed;
}

}  // namespace swarmanoid

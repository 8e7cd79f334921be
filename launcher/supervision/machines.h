// Machines: the machine of each process of a cluster, or of the runs of a study, and the command that starts a process
// there. Read from the file of --hosts (docs/command.md and docs/studies.md have its format).
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "common/program/process.h"

namespace swarmanoid
{

// A machine that runs runs of a study.
struct RunMachine
{
  std::string name;
  unsigned cores = 0;  // runs at a time; 0: as many as it has cores
};

class Machines
{
public:
  Machines() = default;
  // Throws UsageError with file and line. `text` is the content of the file.
  Machines(const std::string& file, const std::string& text);
  static Machines FromFile(const std::string& file);

  // --engine-host: "ENGINE=HOST". Throws UsageError.
  void AddEngine(const std::string& setting);

  // Returns the machine of a process, by the file's word for its role ("engine") and its id ("ground"). kHere for this
  // machine.
  std::string MachineOf(const std::string& role, const std::string& id) const;
  // Returns true if processes run only on this machine and cannot be moved to another one.
  bool AllHere() const;
  // The names of all other machines that are named for processes, each once, in alphabetical order.
  std::vector<std::string> Names() const;
  // The command that this machine executes to run `command` on `machine`.
  ProcessCommand CommandOn(const ProcessCommand& command, const std::string& machine) const;
  // Options that every process gets.
  const std::vector<std::string>& Options() const { return options_; }
  // Returns the ids of the processes of a role that the file names, to find ids that the experiment does not have.
  std::vector<std::string> Named(const std::string& role) const;

  // Returns the machines of the line `runs`, each once, for studies. Throws UsageError if `cores` is given for another
  // one.
  std::vector<RunMachine> ForRuns() const;
  // Silence of a machine after which it counts as dead.
  unsigned LeaseSeconds() const { return lease_s_; }
  // The command that this machine executes to run `words` on `machine`, with pipes as its input and output. The first
  // word is the path of `swarmanoid` here.
  std::vector<std::string> WorkerCommand(const std::string& machine, std::vector<std::string> words) const;

private:
  // `at`: file and line, for errors.
  void TakeLine(const std::string& line, const std::string& at);
  void TakeCores(const std::vector<std::string>& key, const std::string& value, const std::string& at);
  void TakeMachinesForRuns(const std::vector<std::string>& machines, const std::string& at);
  // Returns the words of the template with a command for a machine in it.
  std::vector<std::string> Reached(const std::vector<std::string>& words, const std::string& machine) const;

  std::map<std::pair<std::string, std::string>, std::string> of_processes_;  // by role and id; without id: all others
  std::vector<std::string> template_{"ssh", "-tt", "-o", "BatchMode=yes", "--", "{host}", "{shell_command}"};
  std::string program_folder_;
  std::vector<std::string> options_;
  std::vector<std::string> for_runs_;
  std::vector<std::string> reserve_;                               // machines that processes may be moved to
  std::map<std::string, std::pair<unsigned, std::string>> cores_;  // with file and line
  unsigned lease_s_ = 60;
  std::string swarmanoid_;
};

}  // namespace swarmanoid

// On which machine each process of a cluster runs, or the runs of a study, and how it is started there. Read from the
// file of --hosts, whose format docs/command.md and docs/studies.md describe.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/program/process.h"

namespace swarmanoid
{

// A machine that runs runs of a study.
struct RunHost
{
  std::string name;
  unsigned cores = 0;  // runs at a time; 0: as many as it has cores
};

class Hosts
{
public:
  Hosts() = default;
  // Throws UsageError with file and line. `text` is the content of the file.
  Hosts(const std::string& file, const std::string& text);
  static Hosts FromFile(const std::string& file);

  // --engine-host: "ENGINE=HOST". Throws UsageError.
  void AddEngine(const std::string& setting);

  // The machine of a process, by role ("engine") and which one of them ("ground"); empty: this one.
  std::string HostOf(const std::string& role, const std::string& which) const;
  // Whether neither a process nor a machine that one may be moved to is anywhere else.
  bool AllHere() const;
  // All machines other than this one that are named for processes, each once, in alphabetical order.
  std::vector<std::string> Machines() const;
  // The command as it is started here so that it runs on that machine.
  ProcessCommand Placed(const ProcessCommand& command, const std::string& host) const;
  // Options that every process gets.
  const std::vector<std::string>& Options() const { return options_; }
  // Names of engines, hosts and visualisers that the file places; for finding those that the experiment does not have.
  std::vector<std::string> Named(const std::string& role) const;

  // For studies: what the line `runs` names, each once. Throws UsageError if `cores` is given for another one.
  std::vector<RunHost> RunHosts() const;
  // Silence of a machine after which it is taken for dead.
  unsigned LeaseSeconds() const { return lease_s_; }
  // The command as it is started here so that it runs on that machine and is heard and spoken to through pipes. The
  // first word is the path of `swarmanoid` here.
  std::vector<std::string> WorkerCommand(const std::string& host, std::vector<std::string> words) const;

private:
  void TakeLine(const std::string& line, const std::string& place);
  void TakeCores(const std::vector<std::string>& key, const std::string& value, const std::string& place);
  void TakeRunHosts(const std::vector<std::string>& hosts, const std::string& place);
  // The words of the template with a command for a machine in it.
  std::vector<std::string> Reached(const std::vector<std::string>& words, const std::string& host) const;

  std::map<std::pair<std::string, std::string>, std::string>
      hosts_;  // role and which one, empty for the rest of the role
  std::vector<std::string> template_{"ssh", "-tt", "-o", "BatchMode=yes", "--", "{host}", "{shell_command}"};
  std::string program_folder_;
  std::vector<std::string> options_;
  std::vector<std::string> run_hosts_;
  std::vector<std::string> machines_;                              // where no process needs to be at first
  std::map<std::string, std::pair<unsigned, std::string>> cores_;  // and the place in the file
  unsigned lease_s_ = 60;
  std::string swarmanoid_;
};

}  // namespace swarmanoid

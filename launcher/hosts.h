// On which machine each process of a cluster runs, and how it is started there. Read from the file of --hosts, whose
// format docs/command.md describes.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "launcher/processes/process.h"

namespace swarmanoid
{

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
  bool AllHere() const;
  // The command as it is started here so that it runs on that machine.
  ProcessCommand Placed(const ProcessCommand& command, const std::string& host) const;
  // Options that every process gets.
  const std::vector<std::string>& Options() const { return options_; }
  // Names of engines, hosts and visualisers that the file places; for finding those that the experiment does not have.
  std::vector<std::string> Named(const std::string& role) const;

private:
  void TakeLine(const std::string& line, const std::string& place);

  std::map<std::pair<std::string, std::string>, std::string>
      hosts_;  // role and which one, empty for the rest of the role
  std::vector<std::string> template_{"ssh", "-tt", "-o", "BatchMode=yes", "{host}", "{shell_command}"};
  std::string program_folder_;
  std::vector<std::string> options_;
};

// One word of a POSIX shell that stands for the text.
std::string ShellQuoted(const std::string& text);

}  // namespace swarmanoid

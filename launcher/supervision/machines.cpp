#include "launcher/supervision/machines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <set>
#include <sstream>

#include "common/configuration/configuration_tree.h"
#include "common/configuration/regular_file.h"
#include "common/configuration/trust.h"
#include "common/configuration/wording.h"
#include "common/program/shell_word.h"
#include "common/program/usage_error.h"
#include "space_server/worker_placement.h"

namespace swarmanoid
{
namespace
{

constexpr std::uint64_t kMostBytes = 1U << 20U;
const std::vector<std::string> kRoles{"space_server", "engine", "region", "controller_host", "visualiser"};
const std::vector<std::string> kKeys{"command",         "program_folder", "options", "space_server", "engine",
                                     "controller_host", "visualiser",     "runs",    "cores",        "lease",
                                     "swarmanoid",      "machines",       "region"};

bool Holds(const std::vector<std::string>& words, const std::string& word)
{
  return std::any_of(words.begin(), words.end(), [&](const auto& w) { return w.find(word) != std::string::npos; });
}

bool IsHere(const std::string& machine) { return machine.empty() || machine == "localhost" || machine == kHere; }

// Checks a name that becomes a word of a command. It must not look like an option. Throws UsageError.
void RequireMachineName(const std::string& machine, const std::string& at)
{
  constexpr std::string_view kSigns = "._-:@%[]/+";
  const auto is_plain = [&](char c)
  { return std::isalnum(static_cast<unsigned char>(c)) != 0 || kSigns.find(c) != std::string_view::npos; };
  if (!machine.empty() && machine[0] != '-' && std::all_of(machine.begin(), machine.end(), is_plain)) return;
  throw UsageError(
      fmt::format("{}: {} is no name of a machine: it must begin with a letter or digit, and have nothing "
                  "but letters, digits and {}",
                  at, Quoted(machine), kSigns));
}

unsigned PositiveInteger(const std::string& text, unsigned most, const std::string& what, const std::string& unit)
{
  const auto number = ParseInteger(text);
  if (!number || *number < 1 || *number > most)
    throw UsageError(fmt::format("{} is {}; write a whole number of {} from 1 to {}", what, Quoted(text), unit, most));
  return static_cast<unsigned>(*number);
}

void ReplaceAll(std::string& text, const std::string& what, const std::string& by)
{
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
    text.replace(at, what.size(), by);
}

}  // namespace

Machines::Machines(const std::string& file, const std::string& text)
{
  std::istringstream stream(text);
  int number = 0;
  for (std::string line; std::getline(stream, line);)
  {
    ++number;
    line.resize(std::min(line.find('#'), line.size()));
    line = TrimBlanks(line);
    if (!line.empty()) TakeLine(line, fmt::format("{}:{}", file, number));
  }
}

Machines Machines::FromFile(const std::string& file)
{
  try
  {
    return {file, ReadRegularFile(file, kMostBytes)};
  }
  catch (const FileError& error)
  {
    throw UsageError(fmt::format("--hosts: cannot read '{}': {}", file, error.what()));
  }
}

void Machines::TakeLine(const std::string& line, const std::string& at)
{
  const std::size_t sign = line.find('=');
  if (sign == std::string::npos) throw UsageError(at + ": write NAME = VALUE, for example `engine ground = alpha`");
  const std::vector<std::string> key = SplitWords(line.substr(0, sign));
  const std::string value(TrimBlanks(std::string_view(line).substr(sign + 1)));
  if (key.empty() || key.size() > 2 || value.empty())
    throw UsageError(at + ": write NAME = VALUE or ROLE WHICH = HOST");
  if (std::find(kKeys.begin(), kKeys.end(), key[0]) == kKeys.end())
    throw UsageError(fmt::format("{}: there is no {}; allowed are {}{}", at, Quoted(key[0]), Listed(kKeys),
                                 DidYouMean(key[0], kKeys)));

  if (std::find(kRoles.begin(), kRoles.end(), key[0]) != kRoles.end())
  {
    RequireMachineName(value, at);
    of_processes_[{key[0], key.size() == 2 ? key[1] : ""}] = value;
    return;
  }
  if (key[0] == "cores") return TakeCores(key, value, at);
  if (key.size() == 2) throw UsageError(fmt::format("{}: {} takes no second word", at, key[0]));
  if (key[0] == "runs") TakeMachinesForRuns(SplitWords(value), at);
  if (key[0] == "machines")
  {
    reserve_ = SplitWords(value);
    for (const std::string& machine : reserve_) RequireMachineName(machine, at);
  }
  if (key[0] == "lease") lease_s_ = PositiveInteger(value, 86'400, at + ": lease", "seconds");
  if (key[0] == "swarmanoid") swarmanoid_ = value;
  if (key[0] == "program_folder") program_folder_ = value;
  if (key[0] == "options") options_ = SplitWords(value);
  if (key[0] != "command") return;
  template_ = SplitWords(value);
  if (!Holds(template_, "{host}") || (!Holds(template_, "{command}") && !Holds(template_, "{shell_command}")))
    throw UsageError(at + ": command must hold {host}, and {command} or {shell_command}");
}

void Machines::TakeCores(const std::vector<std::string>& key, const std::string& value, const std::string& at)
{
  if (key.size() != 2) throw UsageError(at + ": write cores HOST = NUMBER, for example `cores alpha = 8`");
  cores_[key[1]] = {PositiveInteger(value, 10'000, at + ": cores " + key[1], "runs at a time"), at};
}

void Machines::TakeMachinesForRuns(const std::vector<std::string>& machines, const std::string& at)
{
  for (const std::string& machine : machines)
  {
    RequireMachineName(machine, at);
    if (std::find(for_runs_.begin(), for_runs_.end(), machine) != for_runs_.end())
      throw UsageError(fmt::format("{}: runs names {} a second time", at, Quoted(machine)));
    for_runs_.push_back(machine);
  }
}

std::vector<RunMachine> Machines::ForRuns() const
{
  for (const auto& [machine, cores] : cores_)
    if (std::find(for_runs_.begin(), for_runs_.end(), machine) == for_runs_.end())
      throw UsageError(fmt::format("{}: `runs` does not name {}; it has {}{}", cores.second, Quoted(machine),
                                   Listed(for_runs_), DidYouMean(machine, for_runs_)));
  std::vector<RunMachine> machines;
  for (const std::string& machine : for_runs_)
  {
    const auto cores = cores_.find(machine);
    machines.push_back({machine, cores == cores_.end() ? 0 : cores->second.first});
  }
  return machines;
}

std::vector<std::string> Machines::WorkerCommand(const std::string& machine, std::vector<std::string> words) const
{
  if (IsHere(machine)) return words;
  if (!swarmanoid_.empty()) words[0] = swarmanoid_;
  std::vector<std::string> command = Reached(words, machine);
  // A terminal would change the bytes, so ssh must use none.
  for (std::string& word : command)
    if (word == "-t" || word == "-tt") word = "-T";
  return command;
}

void Machines::AddEngine(const std::string& setting)
{
  const std::size_t sign = setting.find('=');
  if (sign == std::string::npos || sign == 0 || sign + 1 == setting.size())
    throw UsageError(
        fmt::format("--engine-host {}: write ENGINE=HOST, for example --engine-host ground=alpha", setting));
  const std::string machine = setting.substr(sign + 1);
  RequireMachineName(machine, "--engine-host " + setting);
  of_processes_[{"engine", setting.substr(0, sign)}] = machine;
}

std::string Machines::MachineOf(const std::string& role, const std::string& id) const
{
  auto found = of_processes_.find({role, id});
  if (found == of_processes_.end()) found = of_processes_.find({role, ""});
  // By default, the region "ground/2" runs on the machine of the engine "ground".
  if (found == of_processes_.end() && role == "region") return MachineOf("engine", id.substr(0, id.rfind('/')));
  return found == of_processes_.end() || IsHere(found->second) ? kHere : found->second;
}

bool Machines::AllHere() const
{
  return std::all_of(reserve_.begin(), reserve_.end(), IsHere) &&
         std::all_of(of_processes_.begin(), of_processes_.end(),
                     [](const auto& entry) { return IsHere(entry.second); });
}

std::vector<std::string> Machines::Names() const
{
  std::set<std::string> machines(reserve_.begin(), reserve_.end());
  for (const auto& [key, machine] : of_processes_) machines.insert(machine);
  std::erase_if(machines, IsHere);
  return {machines.begin(), machines.end()};
}

ProcessCommand Machines::CommandOn(const ProcessCommand& command, const std::string& machine) const
{
  if (IsHere(machine)) return command;
  std::vector<std::string> words{"env"};
  for (const auto& [name, value] : command.environment) words.push_back(name + "=" + value);
  // Processes on this machine inherit the trust by the environment.
  if (ExperimentsAreTrusted()) words.push_back(std::string(kTrustVariable) + "=1");
  const std::size_t first = words.size();
  words.insert(words.end(), command.arguments.begin(), command.arguments.end());
  std::string& program = words[first];
  if (!program_folder_.empty())
    program = std::filesystem::path(program_folder_) / std::filesystem::path(program).filename();

  return {.name = command.name, .arguments = Reached(words, machine), .input = command.input};
}

std::vector<std::string> Machines::Reached(const std::vector<std::string>& words, const std::string& machine) const
{
  std::string shell_command;
  for (const std::string& word : words) shell_command += (shell_command.empty() ? "" : " ") + ShellWord(word);

  std::vector<std::string> command;
  for (std::string word : template_)
  {
    if (word == "{command}")
    {
      command.insert(command.end(), words.begin(), words.end());
      continue;
    }
    ReplaceAll(word, "{host}", machine);
    ReplaceAll(word, "{shell_command}", shell_command);
    command.push_back(word);
  }
  return command;
}

std::vector<std::string> Machines::Named(const std::string& role) const
{
  std::vector<std::string> names;
  for (const auto& [key, machine] : of_processes_)
    if (key.first == role && !key.second.empty()) names.push_back(key.second);
  return names;
}

}  // namespace swarmanoid

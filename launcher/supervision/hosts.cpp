#include "launcher/supervision/hosts.h"

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
#include "launcher/command/sub_command.h"

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

bool IsHere(const std::string& host) { return host.empty() || host == "localhost" || host == "here"; }

// The name becomes a word of a command, which must not take it for an option. Throws UsageError.
void RequireHostName(const std::string& host, const std::string& place)
{
  constexpr std::string_view kSigns = "._-:@%[]/+";
  const auto is_plain = [&](char c)
  { return std::isalnum(static_cast<unsigned char>(c)) != 0 || kSigns.find(c) != std::string_view::npos; };
  if (!host.empty() && host[0] != '-' && std::all_of(host.begin(), host.end(), is_plain)) return;
  throw UsageError(
      fmt::format("{}: {} is no name of a machine: it must begin with a letter or digit, and have nothing "
                  "but letters, digits and {}",
                  place, Quoted(host), kSigns));
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

Hosts::Hosts(const std::string& file, const std::string& text)
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

Hosts Hosts::FromFile(const std::string& file)
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

void Hosts::TakeLine(const std::string& line, const std::string& place)
{
  const std::size_t sign = line.find('=');
  if (sign == std::string::npos) throw UsageError(place + ": write NAME = VALUE, for example `engine ground = alpha`");
  const std::vector<std::string> key = SplitWords(line.substr(0, sign));
  const std::string value(TrimBlanks(std::string_view(line).substr(sign + 1)));
  if (key.empty() || key.size() > 2 || value.empty())
    throw UsageError(place + ": write NAME = VALUE or ROLE WHICH = HOST");
  if (std::find(kKeys.begin(), kKeys.end(), key[0]) == kKeys.end())
    throw UsageError(fmt::format("{}: there is no {}; allowed are {}{}", place, Quoted(key[0]), Listed(kKeys),
                                 DidYouMean(key[0], kKeys)));

  if (std::find(kRoles.begin(), kRoles.end(), key[0]) != kRoles.end())
  {
    RequireHostName(value, place);
    hosts_[{key[0], key.size() == 2 ? key[1] : ""}] = value;
    return;
  }
  if (key[0] == "cores") return TakeCores(key, value, place);
  if (key.size() == 2) throw UsageError(fmt::format("{}: {} takes no second word", place, key[0]));
  if (key[0] == "runs") TakeRunHosts(SplitWords(value), place);
  if (key[0] == "machines")
  {
    machines_ = SplitWords(value);
    for (const std::string& machine : machines_) RequireHostName(machine, place);
  }
  if (key[0] == "lease") lease_s_ = PositiveInteger(value, 86'400, place + ": lease", "seconds");
  if (key[0] == "swarmanoid") swarmanoid_ = value;
  if (key[0] == "program_folder") program_folder_ = value;
  if (key[0] == "options") options_ = SplitWords(value);
  if (key[0] != "command") return;
  template_ = SplitWords(value);
  if (!Holds(template_, "{host}") || (!Holds(template_, "{command}") && !Holds(template_, "{shell_command}")))
    throw UsageError(place + ": command must hold {host}, and {command} or {shell_command}");
}

void Hosts::TakeCores(const std::vector<std::string>& key, const std::string& value, const std::string& place)
{
  if (key.size() != 2) throw UsageError(place + ": write cores HOST = NUMBER, for example `cores alpha = 8`");
  cores_[key[1]] = {PositiveInteger(value, 10'000, place + ": cores " + key[1], "runs at a time"), place};
}

void Hosts::TakeRunHosts(const std::vector<std::string>& hosts, const std::string& place)
{
  for (const std::string& host : hosts)
  {
    RequireHostName(host, place);
    if (std::find(run_hosts_.begin(), run_hosts_.end(), host) != run_hosts_.end())
      throw UsageError(fmt::format("{}: runs names {} a second time", place, Quoted(host)));
    run_hosts_.push_back(host);
  }
}

std::vector<RunHost> Hosts::RunHosts() const
{
  for (const auto& [host, cores] : cores_)
    if (std::find(run_hosts_.begin(), run_hosts_.end(), host) == run_hosts_.end())
      throw UsageError(fmt::format("{}: `runs` does not name {}; it has {}{}", cores.second, Quoted(host),
                                   Listed(run_hosts_), DidYouMean(host, run_hosts_)));
  std::vector<RunHost> hosts;
  for (const std::string& host : run_hosts_)
  {
    const auto cores = cores_.find(host);
    hosts.push_back({host, cores == cores_.end() ? 0 : cores->second.first});
  }
  return hosts;
}

std::vector<std::string> Hosts::WorkerCommand(const std::string& host, std::vector<std::string> words) const
{
  if (IsHere(host)) return words;
  if (!swarmanoid_.empty()) words[0] = swarmanoid_;
  std::vector<std::string> placed = Reached(words, host);
  // Bytes do not pass a terminal as they are.
  for (std::string& word : placed)
    if (word == "-t" || word == "-tt") word = "-T";
  return placed;
}

void Hosts::AddEngine(const std::string& setting)
{
  const std::size_t sign = setting.find('=');
  if (sign == std::string::npos || sign == 0 || sign + 1 == setting.size())
    throw UsageError(
        fmt::format("--engine-host {}: write ENGINE=HOST, for example --engine-host ground=alpha", setting));
  const std::string host = setting.substr(sign + 1);
  RequireHostName(host, "--engine-host " + setting);
  hosts_[{"engine", setting.substr(0, sign)}] = host;
}

std::string Hosts::HostOf(const std::string& role, const std::string& which) const
{
  auto found = hosts_.find({role, which});
  if (found == hosts_.end()) found = hosts_.find({role, ""});
  // "ground/2" is where its engine is, if nobody says otherwise.
  if (found == hosts_.end() && role == "region") return HostOf("engine", which.substr(0, which.rfind('/')));
  return found == hosts_.end() || IsHere(found->second) ? "" : found->second;
}

bool Hosts::AllHere() const
{
  return std::all_of(machines_.begin(), machines_.end(), IsHere) &&
         std::all_of(hosts_.begin(), hosts_.end(), [](const auto& entry) { return IsHere(entry.second); });
}

std::vector<std::string> Hosts::Machines() const
{
  std::set<std::string> machines(machines_.begin(), machines_.end());
  for (const auto& [key, host] : hosts_) machines.insert(host);
  std::erase_if(machines, IsHere);
  return {machines.begin(), machines.end()};
}

ProcessCommand Hosts::Placed(const ProcessCommand& command, const std::string& host) const
{
  if (host.empty()) return command;
  std::vector<std::string> words{"env"};
  for (const auto& [name, value] : command.environment) words.push_back(name + "=" + value);
  // Processes of this machine inherit it.
  if (ExperimentsAreTrusted()) words.push_back(std::string(kTrustVariable) + "=1");
  const std::size_t place = words.size();
  words.insert(words.end(), command.arguments.begin(), command.arguments.end());
  std::string& program = words[place];
  if (!program_folder_.empty())
    program = std::filesystem::path(program_folder_) / std::filesystem::path(program).filename();

  ProcessCommand placed;
  placed.name = command.name;
  placed.input = command.input;
  placed.arguments = Reached(words, host);
  return placed;
}

std::vector<std::string> Hosts::Reached(const std::vector<std::string>& words, const std::string& host) const
{
  std::string shell_command;
  for (const std::string& word : words) shell_command += (shell_command.empty() ? "" : " ") + ShellWord(word);

  std::vector<std::string> placed;
  for (std::string word : template_)
  {
    if (word == "{command}")
    {
      placed.insert(placed.end(), words.begin(), words.end());
      continue;
    }
    ReplaceAll(word, "{host}", host);
    ReplaceAll(word, "{shell_command}", shell_command);
    placed.push_back(word);
  }
  return placed;
}

std::vector<std::string> Hosts::Named(const std::string& role) const
{
  std::vector<std::string> names;
  for (const auto& [key, host] : hosts_)
    if (key.first == role && !key.second.empty()) names.push_back(key.second);
  return names;
}

}  // namespace swarmanoid

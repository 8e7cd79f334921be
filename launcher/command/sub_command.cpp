#include "launcher/command/sub_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <vector>

#include "common/configuration/wording.h"

namespace swarmanoid
{
namespace
{

std::multimap<int, RegisterSubCommand::Add>& Registered()
{
  static std::multimap<int, RegisterSubCommand::Add> registered;
  return registered;
}

}  // namespace

RegisterSubCommand::RegisterSubCommand(int order, Add add) { Registered().emplace(order, add); }

void AddSubCommands(CLI::App& app, int& exit_code, const std::string& word)
{
  for (const auto& [order, add] : Registered()) add(app, exit_code);
  if (word.empty() || word.starts_with("-")) return;
  std::vector<std::string> names;
  for (const CLI::App* known : app.get_subcommands({})) names.push_back(known->get_name());
  if (std::find(names.begin(), names.end(), word) != names.end()) return;
  if (word.ends_with(".xml") || word.ends_with(".argos"))
    throw UsageError(
        fmt::format("there is no command {}; an experiment is run by: swarmanoid run {}", Quoted(word), word));
  throw UsageError(fmt::format("there is no command {}; the commands are {}{}", Quoted(word), Listed(names),
                               DidYouMean(word, names)));
}

}  // namespace swarmanoid

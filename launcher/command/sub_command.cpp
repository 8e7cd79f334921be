#include "launcher/command/sub_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iterator>
#include <map>
#include <vector>

#include "common/configuration/wording.h"
#include "common/program/shell_word.h"

namespace swarmanoid
{
namespace
{

std::multimap<int, RegisterSubCommand::Add>& Registered()
{
  static std::multimap<int, RegisterSubCommand::Add> registered;
  return registered;
}

// The heading of the help that a sub-command stands under, by the order of the first one below it.
const std::map<int, const char*>& Headings()
{
  static const std::map<int, const char*> headings{{1, "Run experiments"},
                                                   {3, "Look at runs that are over"},
                                                   {9, "Watch and steer runs"},
                                                   {12, "Write experiments and plug-ins"},
                                                   {19, "Try it"},
                                                   {21, "Studies"}};
  return headings;
}

}  // namespace

RegisterSubCommand::RegisterSubCommand(int order, Add add) { Registered().emplace(order, add); }

void AddSubCommands(CLI::App& app, int& exit_code, const std::string& word)
{
  for (const auto& [order, add] : Registered())
  {
    add(app, exit_code);
    app.get_subcommands({}).back()->group(std::prev(Headings().upper_bound(order))->second);
  }
  if (word.empty() || word.starts_with("-")) return;
  std::vector<std::string> names;
  for (const CLI::App* known : app.get_subcommands({})) names.push_back(known->get_name());
  if (std::find(names.begin(), names.end(), word) != names.end()) return;
  if (word.ends_with(".xml") || word.ends_with(".argos"))
    throw UsageError(fmt::format("there is no command {}; an experiment is run by: swarmanoid run {}", Quoted(word),
                                 ShellWord(word)));
  throw UsageError(fmt::format("there is no command {}; the commands are {}{}", Quoted(word), Listed(names),
                               DidYouMean(word, names)));
}

}  // namespace swarmanoid

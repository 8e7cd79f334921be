#include "launcher/command/sub_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iterator>
#include <map>
#include <stdexcept>
#include <vector>

#include "argos3/converter/convert.h"
#include "common/configuration/wording.h"
#include "common/program/shell_word.h"
#include "launcher/argos3_dry_run.h"

namespace swarmanoid
{
namespace
{

struct SubCommand
{
  const char* name;
  RegisterSubCommand::Add add;
};

std::multimap<int, SubCommand>& Registered()
{
  static std::multimap<int, SubCommand> registered;
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

RegisterSubCommand::RegisterSubCommand(int order, const char* name, Add add)
{
  Registered().emplace(order, SubCommand{name, add});
}

bool IsSubCommand(const std::string& word)
{
  return std::ranges::any_of(Registered(), [&](const auto& each) { return word == each.second.name; });
}

void AddSubCommands(CLI::App& app, int& exit_code, const std::string& word)
{
  app.require_subcommand(1);
  // Every sub-command reads experiments of ARGoS3, too.
  ReadArgos3Experiments(RehearseArgos3);
  // The options of all sub-commands take a quarter of the start of a run.
  const bool adds_all = word.empty() || word.starts_with("-");
  for (const auto& [order, command] : Registered())
  {
    if (!adds_all && word != command.name) continue;
    command.add(app, exit_code);
    CLI::App& added = *app.get_subcommands({}).back();
    if (added.get_name() != command.name)
      throw std::logic_error(fmt::format("the sub-command {} is registered as {}", added.get_name(), command.name));
    added.group(std::prev(Headings().upper_bound(order))->second);
  }
  if (adds_all || IsSubCommand(word)) return;
  std::vector<std::string> names;
  for (const auto& [order, command] : Registered()) names.emplace_back(command.name);
  if (word.ends_with(".xml") || word.ends_with(".argos"))
    throw UsageError(fmt::format("there is no command {}; an experiment is run by: swarmanoid run {}", Quoted(word),
                                 ShellWord(word)));
  throw UsageError(fmt::format("there is no command {}; the commands are {}{}", Quoted(word), Listed(names),
                               DidYouMean(word, names)));
}

}  // namespace swarmanoid

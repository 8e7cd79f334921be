#include "common/program/command_line_complaint.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <vector>

#include "common/configuration/configuration_tree.h"
#include "common/configuration/wording.h"
#include "common/program/help_text.h"

namespace swarmanoid
{

namespace
{

// Returns the first required option without a value.
const CLI::Option* MissingOption(const CLI::App& command)
{
  for (const CLI::Option* option : command.get_options())
    if (option->get_required() && option->count() == 0) return option;
  return nullptr;
}

// Explains the missing option, and gives the first example of the command.
std::string MissingText(const std::string& name, const CLI::App& command, const CLI::Option& missing)
{
  std::string text = fmt::format("{} needs {}: {}", name, missing.get_name(), missing.get_description());
  const std::string examples = SplitFooter(command.get_footer()).second;
  std::string first(TrimBlanks(examples.substr(0, examples.find('\n'))));
  first.erase(std::min(first.find("   "), first.size()));  // a remark stands behind some blanks
  if (!first.empty()) text += "; for example: " + first;
  return text;
}

}  // namespace

std::string CommandLineComplaint(const CLI::App& app, const CLI::Error& error)
{
  const CLI::App* command = &app;
  std::string name = app.get_name();
  while (!command->get_subcommands().empty())
  {
    command = command->get_subcommands().back();
    name += " " + command->get_name();
  }
  const std::vector<std::string> left = command->remaining();
  std::vector<std::string> kinds;
  for (const CLI::App* kind : command->get_subcommands([](const CLI::App*) { return true; }))
    kinds.push_back(kind->get_name());
  if (dynamic_cast<const CLI::RequiredError*>(&error) != nullptr && !kinds.empty())
  {
    if (left.empty()) return fmt::format("{} needs one of: {}", name, Listed(kinds));
    return fmt::format("{} has no {}; it has: {}{}", name, Quoted(left.front()), Listed(kinds),
                       DidYouMean(left.front(), kinds));
  }
  if (dynamic_cast<const CLI::RequiredError*>(&error) != nullptr && left.empty())
    if (const CLI::Option* missing = MissingOption(*command)) return MissingText(name, *command, *missing);
  if (dynamic_cast<const CLI::ExtrasError*>(&error) == nullptr || left.empty()) return error.what();

  // The word after an unknown option is its value.
  const auto option = std::find_if(left.begin(), left.end(), [](const std::string& word) { return word[0] == '-'; });
  const std::string word = option == left.end() ? left.front() : option->substr(0, option->find('='));
  std::vector<std::string> taken, options;
  for (const CLI::Option* each : command->get_options())
  {
    if (each->get_positional())
    {
      taken.push_back(each->get_name());
      continue;
    }
    for (const std::string& long_name : each->get_lnames()) options.push_back("--" + long_name);
  }
  std::string near = DidYouMean(word, options);
  if (word.size() == 2)  // a letter of other programs, as in -o
  {
    std::erase_if(options, [&](const std::string& one) { return !one.starts_with("-" + word); });
    if (!options.empty()) near = fmt::format("; its options with that letter: {}.", Listed(options));
  }
  if (!near.empty()) return fmt::format("{} does not take {}{} All options: {} --help", name, Quoted(word), near, name);
  if (option == left.end() && !taken.empty())
    return fmt::format("{} does not take {}; it takes {}. All options: {} --help", name, Quoted(word), Listed(taken),
                       name);
  return fmt::format("{} does not take {}. All options: {} --help", name, Quoted(word), name);
}

}  // namespace swarmanoid

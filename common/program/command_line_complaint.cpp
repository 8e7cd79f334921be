#include "common/program/command_line_complaint.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <vector>

#include "common/configuration/wording.h"

namespace swarmanoid
{

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
  if (dynamic_cast<const CLI::ExtrasError*>(&error) == nullptr || left.empty()) return error.what();

  // What follows an unknown option is its value.
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
  taken.insert(taken.end(), options.begin(), options.end());
  return fmt::format("{} does not take {}; it takes {}{}", name, Quoted(word), Listed(taken),
                     DidYouMean(word, options));
}

}  // namespace swarmanoid

#include "common/program/empty_words.h"

#include <CLI/CLI.hpp>
#include <string>

#include "common/program/usage_error.h"

namespace swarmanoid
{
namespace
{

constexpr const char* kMayBeEmpty = "may be empty";  // the name of a check that refuses nothing

bool MayBeEmpty(CLI::Option& option)
{
  try
  {
    return option.get_validator(kMayBeEmpty) != nullptr;
  }
  catch (const CLI::OptionNotFound&)
  {
    return false;
  }
}

}  // namespace

void AllowEmpty(CLI::Option& option)
{
  option.check([](const std::string&) { return std::string(); }, "", kMayBeEmpty);
}

void RefuseEmptyWords(CLI::App& app)
{
  for (CLI::Option* option : app.get_options([](const CLI::Option*) { return true; }))
  {
    if (option->get_items_expected_max() == 0 || MayBeEmpty(*option)) continue;
    // The transformation changes nothing. It runs before all checks, which would call the empty word a wrong value.
    option->transform(
        [name = option->get_name()](std::string word)
        {
          if (word.empty()) throw UsageError(name + " is empty; give it a value, or leave it out");
          return word;
        });
  }
  for (CLI::App* command : app.get_subcommands([](CLI::App*) { return true; })) RefuseEmptyWords(*command);
}

}  // namespace swarmanoid

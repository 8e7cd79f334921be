// Each sub-command of `swarmanoid` has a file in launcher/command or studies/, which adds it to the command line and
// registers it.
#pragma once

#include <string>

#include "common/program/usage_error.h"
#include "simulation/register_all.h"

namespace CLI
{
class App;
}

namespace swarmanoid
{

class RegisterSubCommand
{
public:
  // Adds the sub-command. If the user calls it, it sets `exit_code`.
  using Add = void (*)(CLI::App& app, int& exit_code);

  // `order`: the help lists sub-commands with smaller numbers first.
  RegisterSubCommand(int order, Add add);
};

// Adds all that are registered. `word` is the first one of the command line. Throws UsageError if it is neither empty
// nor an option nor the name of a sub-command: CLI11 would only say that the word was not expected.
void AddSubCommands(CLI::App& app, int& exit_code, const std::string& word = {});

}  // namespace swarmanoid

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

  // `order`: the help lists sub-commands with smaller numbers first. `name`: the one that `add` gives it.
  RegisterSubCommand(int order, const char* name, Add add);
};

bool IsSubCommand(const std::string& word);

// Adds the sub-command of the name `word`, which is the first one of the command line. If that is empty or an option,
// adds all that are registered. Throws UsageError if it is none of these: CLI11 would only say that the word was not
// expected.
void AddSubCommands(CLI::App& app, int& exit_code, const std::string& word = {});

}  // namespace swarmanoid

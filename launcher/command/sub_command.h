// A sub-command of `swarmanoid`: its file in launcher/command or studies/ adds it to the command line and registers it.
#pragma once

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
  // Adds the sub-command. When it is the one that was asked for, it leaves its exit code in `exit_code`.
  using Add = void (*)(CLI::App& app, int& exit_code);

  // `order`: the help lists sub-commands with smaller numbers first.
  RegisterSubCommand(int order, Add add);
};

// Adds all that are registered.
void AddSubCommands(CLI::App& app, int& exit_code);

}  // namespace swarmanoid

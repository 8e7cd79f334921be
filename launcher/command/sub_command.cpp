#include "launcher/command/sub_command.h"

#include <map>

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

void AddSubCommands(CLI::App& app, int& exit_code)
{
  for (const auto& [order, add] : Registered()) add(app, exit_code);
}

}  // namespace swarmanoid

// The verbs of the `swarmanoid` command. Each adds itself to the command line; when it is the one asked for, it leaves
// its exit code in `exit_code`.
#pragma once

#include <stdexcept>

namespace CLI
{
class App;
}

namespace swarmanoid
{

void AddRunCommand(CLI::App& app, int& exit_code);
void AddAttachCommand(CLI::App& app, int& exit_code);
void AddControlCommand(CLI::App& app, int& exit_code);
void AddCheckCommand(CLI::App& app, int& exit_code);
void AddListCommand(CLI::App& app, int& exit_code);
void AddNewCommand(CLI::App& app, int& exit_code);

// What was asked for cannot be done as asked: what() says why and what would do. Ends the command with kUsage.
class UsageError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

// All built-in engines, devices and renderers, so that experiments can be read.
void RegisterBuiltins();

}  // namespace swarmanoid

// Every program runs in this frame. It registers plug-ins, reads the command line and catches signals. It turns each
// error into a line on standard error that names the program, and an exit code.
#pragma once

#include <functional>
#include <string>

#include "common/errors/exit_codes.h"

namespace CLI
{
class App;
}

namespace swarmanoid
{

struct ProgramDescription
{
  std::string name;     // the name of the program in its messages
  std::string purpose;  // a sentence for --help
  std::string footer;   // the end of --help: notes and examples
  void (*register_plugins)() = nullptr;
  bool catches_interrupts = true;  // whether CatchInterrupts is called before `run`
  // Whether the process reports its death (ReportDeaths), and runs within the limits of the environment.
  bool runs_code_of_users = false;
};

// `declare` adds the options. `run` does the work once they have their values, and returns the exit code. Both may
// throw UsageError, ConfigurationError, or any other exception.
int RunProgram(const ProgramDescription& program, int count, char** arguments,
               const std::function<void(CLI::App&)>& declare, const std::function<int()>& run);

}  // namespace swarmanoid

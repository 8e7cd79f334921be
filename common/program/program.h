// The frame around every program. It registers plug-ins, reads the command line and catches signals. It turns each
// error into a line on standard error that names the program, and an exit code.
#pragma once

#include <functional>
#include <string>

#include "common/activity/exit_codes.h"

namespace CLI
{
class App;
}

namespace swarmanoid
{

struct ProgramDescription
{
  std::string name;     // as in what it says
  std::string purpose;  // a sentence for --help
  std::string footer;   // of --help: examples
  void (*register_plugins)() = nullptr;
  bool catches_interrupts = true;   // CatchInterrupts, before `run`
  bool runs_code_of_users = false;  // it tells how it dies (ReportDeaths), within the limits of the environment
};

// `declare` adds the options; `run` does the work, once they have their values, and returns the exit code. Both may
// throw UsageError, ConfigurationError, or anything else.
int RunProgram(const ProgramDescription& program, int count, char** arguments,
               const std::function<void(CLI::App&)>& declare, const std::function<int()>& run);

}  // namespace swarmanoid

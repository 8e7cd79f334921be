// Any text is refused as a file of hosts with its line, or names machines for processes whose commands have words.
#include <cstdlib>
#include <string>

#include "common/program/usage_error.h"
#include "launcher/supervision/machines.h"
#include "tests/fuzz/fuzz_driver.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* input, std::size_t count)
{
  using namespace swarmanoid;
  const std::string text(reinterpret_cast<const char*>(input), count);
  try
  {
    const Machines machines("hosts", text);
    ProcessCommand command;
    command.name = "engine 'ground'";
    command.arguments = {"/usr/bin/engine_worker", "--engine", "ground"};
    command.environment = {{"NAME", "a value"}};
    for (const char* role : {"engine", "controller_host", "space_server", "visualiser"})
      if (machines.CommandOn(command, machines.MachineOf(role, "ground")).arguments.empty()) std::abort();
    for (const std::string& machine : machines.Names())
      if (machine.empty() || machine[0] == '-') std::abort();
    for (const std::string& name : machines.Named("engine"))
      if (name.empty()) std::abort();
  }
  catch (const UsageError& error)
  {
    if (!std::string(error.what()).starts_with("hosts:")) std::abort();
  }
  return 0;
}

// The program that runs the controllers of some robots of an experiment: the controller host's role at the bus.
#include "common/bus/membership/worker_program.h"
#include "common/logging/log.h"
#include "common/plugin_descriptions/describe_builtins.h"
#include "controller_host/cluster/host_node.h"
#include "controller_host/controller_host.h"

int main(int count, char** arguments)
{
  using namespace swarmanoid;

  const ProgramDescription program{
      "controller_host",
      "Runs the controllers of some robots of a Swarmanoid experiment.",
      "Examples:\n"
      "  controller_host                                host 0 of the experiment that runs on this machine\n"
      "  controller_host --host 1 --experiment diffusion_10 --domain 7\n"
      "  controller_host --host 1 --interface eth0          space server on another machine",
      []
      {
        DescribeBuiltins();
        RegisterBuiltinDevices();
      },
      true,
      true};
  return RunWorker(program, count, arguments, HostOptionTable,
                   [](const WorkerSettings& settings, const BusOptions& bus)
                   {
                     // This level shows the log of controllers.
                     OpenLog({.process = "controller_host", .stderr_level = LogLevel::kInfo});
                     return RunControllerHost(settings, bus);
                   });
}

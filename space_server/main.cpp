// The space_server program: the process that holds the state and the clock of an experiment. It connects the role to
// the bus, with the control service and the reports to the launcher.
#include "common/plugin_descriptions/describe_builtins.h"
#include "common/program/interrupts.h"
#include "common/program/program.h"
#include "space_server/cluster/server_main.h"

int main(int count, char** arguments)
{
  using namespace swarmanoid;

  ServerOptions options;
  const ProgramDescription program{
      "space_server",
      "Holds the state and the clock of a Swarmanoid experiment and waits for its other processes.",
      "Examples:\n"
      "  space_server configs/diffusion_10.xml                      on this machine; then start engine_worker and "
      "controller_host\n"
      "  space_server configs/diffusion_10.xml --domain 7 --seed 3 --ticks 500 --hash-log hashes.txt\n"
      "  space_server configs/diffusion_1000.xml --controller-hosts 2 --interface eth0    workers on other machines",
      DescribeBuiltins,
      true,
      true};
  options.stop = &InterruptFlag();
  return RunProgram(
      program, count, arguments, [&](CLI::App& app) { AddServerOptions(app, options); },
      [&] { return Serve(options); });
}

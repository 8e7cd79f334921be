// The program that holds the state and the clock of an experiment: the space server's role at the bus, with the control
// service and what the launcher is told.
#include <fmt/format.h>

#include <filesystem>
#include <fstream>

#include "common/bus/cluster_options.h"
#include "common/bus/status_channel.h"
#include "common/experiment/load_experiment.h"
#include "common/program/program.h"
#include "roles/builtins.h"
#include "space_server/cluster/server_program.h"

namespace swarmanoid
{
namespace
{

OptionSpec StatusOption(int& descriptor)
{
  constexpr double kLargestDescriptor = 1'048'575;
  return {{.name = "status-fd",
           .type = ParameterType::kInteger,
           .description = "Descriptor for status lines, see docs/wire.md; -1: none",
           .minimum = -1,
           .maximum = kLargestDescriptor},
          &descriptor,
          "1"};
}

int Run(ServerOptions& options)
{
  options.bus.serves_discovery = true;
  StatusChannel status(options.status_fd);
  status.Tell(ServerState{ServerState::kLoading, {}});
  try
  {
    LoadOptions load = ChangesOf(options);
    load.check_files = false;
    const LoadedExperiment loaded = LoadExperimentFile(options.file, load);
    if (!loaded.experiment)
    {
      for (const Diagnostic& error : loaded.errors) fmt::print(stderr, "{}\n", error.Text());
      status.Tell(ServerError{fmt::format("the experiment file has {} mistake{}", loaded.errors.size(),
                                          loaded.errors.size() == 1 ? "" : "s")});
      return kExitInvalidFile;
    }
    if (!options.output_folder.empty())
    {
      std::filesystem::create_directories(options.output_folder);
      std::ofstream file(options.output_folder + "/experiment.xml");
      if (!(file << loaded.experiment->effective_xml << std::flush))
        throw BusError(fmt::format("cannot write '{}/experiment.xml'", options.output_folder));
    }
    ServerProgram program(options, *loaded.experiment, status);
    return program.Run();
  }
  catch (const std::exception& error)
  {
    status.Tell(ServerError{error.what()});
    throw;
  }
}

}  // namespace
}  // namespace swarmanoid

int main(int count, char** arguments)
{
  using namespace swarmanoid;

  ServerOptions options;
  const ProgramDescription program{
      "space_server", "Holds the state and the clock of a Swarmanoid experiment and waits for its other processes.",
      "Examples:\n"
      "  space_server configs/diffusion_10.xml                      on this machine; then start engine_worker and "
      "controller_host\n"
      "  space_server configs/diffusion_10.xml --domain 7 --seed 3 --ticks 500 --hash-log hashes.txt\n"
      "  space_server configs/diffusion_1000.xml --controller-hosts 2 --interface eth0    workers on other machines",
      RegisterBuiltins};
  return RunProgram(
      program, count, arguments,
      [&](CLI::App& app)
      {
        AddOptions(app, ServerOptionTable(options));
        AddOptions(app, {StatusOption(options.status_fd)});
        AddOptions(app, BusOptionTable(options.bus));
      },
      [&] { return Run(options); });
}

// The program that holds the state and the clock of an experiment: the space server's role at the bus, with the control
// service and what the launcher is told.
#include <CLI/CLI.hpp>

#include <fmt/format.h>

#include <filesystem>
#include <fstream>

#include "common/bus/cluster_options.h"
#include "common/bus/status_channel.h"
#include "common/experiment/load_experiment.h"
#include "controller_host/controller_host.h"
#include "engine_worker/engine_worker.h"
#include "space_server/cluster/server_program.h"
#include "visualiser/render.h"

namespace swarmanoid
{
namespace
{

LoadOptions LoadOptionsOf(const ServerOptions& options)
{
  LoadOptions load;
  for (const std::string& setting : options.settings)
  {
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos || equals == 0)
      throw ConfigurationError(fmt::format("--set {}: write PATH=VALUE", setting));
    load.settings.emplace_back(setting.substr(0, equals), setting.substr(equals + 1));
  }
  if (options.has_seed) load.settings.emplace_back("framework.seed", std::to_string(options.seed));
  if (options.has_ticks) load.settings.emplace_back("framework.maxclock", std::to_string(options.ticks));
  load.check_files = false;
  return load;
}

int Run(int argc, char** argv)
{
  CLI::App app{"Holds the state and the clock of a Swarmanoid experiment and waits for its other processes."};
  app.footer(
      "Examples:\n"
      "  space_server configs/diffusion_10.xml                      on this machine; then start engine_worker and "
      "controller_host\n"
      "  space_server configs/diffusion_10.xml --domain 7 --seed 3 --ticks 500 --hash-log hashes.txt\n"
      "  space_server configs/diffusion_1000.xml --controller-hosts 2 --interface eth0    workers on other machines");
  ServerOptions options;
  app.add_option("FILE", options.file, "the experiment file")->required();
  app.add_option("--set", options.settings, "PATH=VALUE: another value for an element or attribute of the file");
  auto* seed = app.add_option("--seed", options.seed, "seed of all random numbers");
  auto* ticks = app.add_option("--ticks", options.ticks, "length of the run in ticks; 0: until stopped");
  app.add_option("--controller-hosts", options.hosts, "number of controller hosts")
      ->check(CLI::Range(1U, 1024U))
      ->capture_default_str();
  app.add_option("--output", options.output,
                 "folder for the effective experiment file and for what experiment functions write");
  app.add_flag("--paused", options.paused, "wait for `resume` or `step` before the first tick");
  app.add_option("--real-time", options.real_time_factor, "simulated seconds in a second; 0: as fast as possible")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--hash-log", options.hash_log, "file for the hash of every tick's state");
  app.add_option("--checkpoint-every", options.checkpoint_every,
                 "ticks between two checkpoints in the output folder; 0: none");
  app.add_option("--restore", options.restore, "checkpoint to go on from")->check(CLI::ExistingFile);
  app.add_option("--events", options.events, "events.csv of an earlier run, whose moves and stops are repeated");
  app.add_flag("--no-visualisers", options.no_visualisers, "run without the visualisations of the file");
  app.add_option("--status-fd", options.status_fd, "descriptor for status lines, see docs/wire.md");
  AddBusOptions(app, options.bus);
  if (const int code = ParseCommandLine(app, argc, argv); code >= 0) return code;
  options.has_seed = seed->count() > 0;
  options.has_ticks = ticks->count() > 0;
  options.bus.serves_discovery = true;

  CatchInterrupts();
  RegisterBuiltinEngines();
  RegisterBuiltinDevices();
  RegisterBuiltinRenderers();
  StatusChannel status(options.status_fd);
  status.Say("state loading");
  try
  {
    LoadedExperiment loaded = LoadExperimentFile(options.file, LoadOptionsOf(options));
    if (!loaded.experiment)
    {
      for (const Diagnostic& error : loaded.errors) fmt::print(stderr, "{}\n", error.Text());
      status.Say(fmt::format("error the experiment file has {} mistake{}", loaded.errors.size(),
                             loaded.errors.size() == 1 ? "" : "s"));
      return kExitInvalidFile;
    }
    if (!options.output.empty())
    {
      std::filesystem::create_directories(options.output);
      std::ofstream file(options.output + "/experiment.xml");
      if (!(file << loaded.experiment->effective_xml << std::flush))
        throw BusError(fmt::format("cannot write '{}/experiment.xml'", options.output));
    }
    options.places = std::move(loaded.places);
    ServerProgram program(options, *loaded.experiment, status);
    return program.Run();
  }
  catch (const std::exception& error)
  {
    status.Say(fmt::format("error {}", error.what()));
    throw;
  }
}

}  // namespace
}  // namespace swarmanoid

int main(int argc, char** argv) { return swarmanoid::RunProgram("space_server", swarmanoid::Run, argc, argv); }

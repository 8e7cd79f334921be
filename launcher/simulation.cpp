#include "launcher/simulation.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <string>

#include "launcher/exit_codes.h"
#include "launcher/run_command_line.h"
#include "launcher/run_experiment.h"
#include "launcher/usage_error.h"

namespace swarmanoid
{

int RunSimulation(int count, char** arguments, const std::function<void(CSimulator&)>& watch)
{
  const std::string name = std::filesystem::path(count > 0 ? arguments[0] : "simulation").filename();
  CLI::App app("Runs an experiment in this process.", name);
  app.failure_message([&name](const CLI::App*, const CLI::Error& error)
                      { return fmt::format("{}: {}\n", name, error.what()); });
  app.footer("The same as `swarmanoid run EXPERIMENT.xml --single-process`.");
  RunOptions options;
  AddRunOptions(app, options);
  app.add_flag("--single-process", options.single_process, "Accepted, and always so");

  try
  {
    app.parse(count, arguments);
    return RunExperiment(options, [&](const Experiment& experiment, const RunFolder& folder, Manifest&)
                         { return RunHere(options, experiment, folder, watch); });
  }
  catch (const CLI::ParseError& error)
  {
    return app.exit(error) == 0 ? kDone : kUsage;
  }
  catch (const UsageError& error)
  {
    fmt::print(stderr, "{}: {}\n", name, error.what());
    return kUsage;
  }
  catch (const std::exception& error)
  {
    fmt::print(stderr, "{}: {}\n", name, error.what());
    return kProcessFailed;
  }
}

}  // namespace swarmanoid

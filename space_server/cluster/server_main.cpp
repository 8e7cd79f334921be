#include "space_server/cluster/server_main.h"

#include <fmt/format.h>
#include <cerrno>
#include <cstring>

#include <cstdio>
#include <filesystem>
#include <memory>

#include "common/activity/failure_report.h"
#include "common/configuration/output_file.h"
#include "common/errors/print_error.h"
#include "common/experiment/load_experiment.h"
#include "common/program/trust_flag.h"
#include "common/run/access/cluster_options.h"

namespace swarmanoid
{
namespace
{

constexpr double kLongestRun_s = 1e9;

OptionSpec StatusOption(int& descriptor)
{
  constexpr double kLargestDescriptor = 1'048'575;
  return {Whole("status-fd", "Descriptor for status lines, see docs/wire.md; -1: none", -1, kLargestDescriptor),
          &descriptor, "1"};
}

}  // namespace

void AddServerOptions(CLI::App& app, ServerOptions& options)
{
  AddOptions(app, ServerOptionTable(options));
  AddTrustFlag(app);
  AddOptions(app, {StatusOption(options.status_fd),
                   {Flag("await-replacements", "Wait when a process dies: another one is started in its place"),
                    &options.awaits_replacements},
                   {Number("go-on", "s",
                           "Go on with the run whose journal is in the folder of --output, and which has taken so long "
                           "already; -1: start a run",
                           -1, kLongestRun_s),
                    &options.goes_on_after_s, "12.5"},
                   {Text("machine", "A machine to which the launcher may move workers"), &options.machines, "alpha",
                    "MACHINE"},
                   {Text("place", "The machine that a process of the run is on"), &options.worker_places,
                    "engine 'ground'=alpha", "WORKER=MACHINE"}});
  AddOptions(app, BusOptionTable(options.bus));
}

int Serve(const ServerOptions& options)
{
  // The program refers to all these objects. They may have to outlive a run that failed.
  struct Server
  {
    explicit Server(const ServerOptions& given) : options(given), status(given.status_fd) {}

    ServerOptions options;
    StatusChannel status;
    LoadedExperiment loaded;
    std::unique_ptr<ServerProgram> program;
  };
  auto server = std::make_unique<Server>(options);
  StatusChannel& status = server->status;
  status.Publish(ServerState{ServerState::kLoading, {}});
  try
  {
    LoadOptions load = ChangesOf(options);
    load.check_files = false;
    LoadedExperiment& loaded = server->loaded = LoadExperimentFile(options.file, load);
    if (!loaded.experiment)
    {
      for (const Diagnostic& error : loaded.errors) PrintError("{}\n", error.Text());
      NoteEnd(EndReason::kInvalid, 0, loaded.errors.front().Text(), true);
      status.Publish(ServerError{fmt::format("the experiment file has {} mistake{}", loaded.errors.size(),
                                             loaded.errors.size() == 1 ? "" : "s")});
      return kExitInvalidFile;
    }
    if (!options.output_folder.empty())
    {
      std::filesystem::create_directories(options.output_folder);
      if (const std::string mistake = OutputFolderMistake(options.output_folder); !mistake.empty())
        throw BusError(fmt::format("'{}' cannot be the folder of the run: {}; name another one by --output",
                                   options.output_folder, mistake));
      // Another process may read the file, and the launcher has written it, too. So it is replaced by renaming.
      const std::string file = options.output_folder + "/experiment.xml";
      const std::string draft = file + ".new";
      const std::string& text = loaded.experiment->effective_xml;
      std::FILE* const output = OpenOutputFile(draft);
      bool good = output != nullptr && std::fwrite(text.data(), 1, text.size(), output) == text.size();
      if (output != nullptr) good = std::fclose(output) == 0 && good;
      if (!good) throw BusError(fmt::format("cannot write '{}': {}", draft, std::strerror(errno)));
      std::filesystem::rename(draft, file);
    }
    server->options.bus.serves_discovery = true;
    server->options.places = std::move(loaded.places);
    server->program = std::make_unique<ServerProgram>(server->options, *loaded.experiment, status);
    const int code = server->program->Run();
    if (!server->program->Failed()) return code;
    if (options.abandon == nullptr) EndAtOnce(code);
    [[maybe_unused]] const Server* left = server.release();
    return code;
  }
  catch (const std::exception& error)
  {
    const bool invalid = dynamic_cast<const ConfigurationError*>(&error) != nullptr;
    const bool complete = invalid || dynamic_cast<const ActivityError*>(&error) != nullptr;
    NoteEnd(invalid ? EndReason::kInvalid : EndReason::kFailed, 0,
            complete ? error.what() : fmt::format("space server failed at tick 0: {}", error.what()), complete);
    status.Publish(ServerError{error.what()});
    throw;
  }
}

}  // namespace swarmanoid

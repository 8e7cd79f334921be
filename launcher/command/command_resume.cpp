// `swarmanoid resume`: goes on with a run that died, from its journal.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "common/errors/exit_codes.h"
#include "common/errors/print_error.h"
#include "common/journal/journal_reader.h"
#include "common/program/trust_flag.h"
#include "launcher/command/sub_command.h"
#include "launcher/run_experiment.h"
#include "simulation/load.h"
#include "simulation/playback/journal_loss.h"
#include "simulation/playback/recorded_run.h"
#include "simulation/run_folder.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;

// The journal has these.
constexpr std::array kOfTheRun{"EXPERIMENT", "seed", "ahead", "set", "restore", "branch", "controller-hosts"};

std::vector<OptionSpec> ResumeOptionTable(RunSettings& settings)
{
  std::vector<OptionSpec> options = RunOptionTable(settings);
  std::erase_if(options, [](const OptionSpec& option)
                { return std::find(kOfTheRun.begin(), kOfTheRun.end(), option.value.name) != kOfTheRun.end(); });
  return options;
}

// The folder has only the events of --events that the run reached, so the user must name the file again.
void RequireEvents(const std::string& run_folder)
{
  std::error_code none;
  if (!fs::exists(run_folder + "/manifest.json", none)) return;
  nlohmann::json manifest;
  try
  {
    manifest = ReadManifest(run_folder);
  }
  catch (const std::exception& error)
  {
    throw UsageError(fmt::format(
        "resume: '{}/manifest.json' is damaged, and says what the run repeats; delete it if it repeats no --events: {}",
        run_folder, error.what()));
  }
  if (!manifest.contains("command")) return;
  for (const auto& word : manifest["command"])
    if (word.is_string() && word.get<std::string>().starts_with("--events"))
      throw UsageError("resume: the run repeats the events of a file; name it again with --events");
}

// The file of the users' requests, without the signal that ended the run, which goes on after it.
std::string EventsOf(const std::string& run_folder)
{
  const std::string path = run_folder + "/events.csv";
  std::string kept, last;
  // Damaged lines are kept: the reader of events reports them.
  std::ifstream file(path);
  for (std::string line; std::getline(file, line) && !file.eof(); last = line + "\n") kept += last;
  if (last.find(",stop,,,interrupt,") == std::string::npos) return path;
  std::string without = run_folder + "/journal/events.csv";
  std::ofstream copy(without);
  if (!(copy << kept << std::flush))
    throw UsageError(fmt::format("resume: cannot write '{}': {}", without, std::strerror(errno)));
  return without;
}

int Resume(const std::string& run_folder, RunSettings options)
{
  options.file = run_folder + "/experiment.xml";
  if (!fs::is_regular_file(options.file))
    throw UsageError(fmt::format("resume: '{}' is no folder of a run: it has no experiment.xml", run_folder));
  const auto experiment = LoadOrComplain(options.file, ChangesOf(options));
  if (!experiment) return kExitInvalidFile;
  if (options.output_folder.empty()) options.output_folder = run_folder + "/resumed";
  if (options.events.empty())
  {
    RequireEvents(run_folder);
    if (fs::exists(run_folder + "/events.csv")) options.events = EventsOf(run_folder);
  }
  if (options.faults_of.empty() && experiment->HasGuards()) options.faults_of = run_folder;
  try
  {
    const JournalReader journal(JournalFile(run_folder));
    if (journal.Start().origin.experiment != FingerprintOf(*experiment))
      throw std::runtime_error(
          fmt::format("the journal '{}' is of another experiment than '{}': one of them was changed or damaged",
                      journal.Path(), options.file));
    PrintLoss(FindLoss(journal, RecordedEndOf(run_folder)));
    options.controller_hosts = journal.Hosts().hosts;
    const auto checkpoint = journal.WholeCheckpointUntil(UINT64_MAX, *experiment, journal.Hosts());
    if (!checkpoint && journal.FirstTick() != 0)
      throw std::runtime_error(
          fmt::format("the journal begins at tick {}, and has no state that all processes saved", journal.FirstTick()));
    if (checkpoint)
    {
      options.restore_file = run_folder + "/journal/" + CheckpointName(checkpoint->snapshot.tick);
      WriteCheckpoint(options.restore_file, *checkpoint);
    }
    PrintError("going on from tick {}\n", checkpoint ? checkpoint->snapshot.tick : 0);
  }
  catch (const std::runtime_error& error)
  {
    throw UsageError(fmt::format("resume: {}", error.what()));
  }
  return RunExperiment(RunRequest(std::move(options)));
}

void AddResumeCommand(CLI::App& app, int& exit_code)
{
  auto options = std::make_shared<RunSettings>();
  auto folder = std::make_shared<std::string>();
  CLI::App* verb = app.add_subcommand("resume", "Go on with a run that died, from its journal");
  verb->add_option("RUN", *folder, "The folder of the run")->required();
  AddOptions(*verb, ResumeOptionTable(*options));
  AddTrustFlag(*verb);
  verb->footer(
      "The run starts again at the newest tick at which all of its processes saved their states, or at its first, and "
      "does again what users asked. Its end has the hash of a run that never died. Without --output, its files go into "
      "RUN/resumed.\n"
      "Example:\n"
      "  swarmanoid resume runs/diffusion_10-20310517-093000");
  verb->callback([options, folder, &exit_code]
                 { exit_code = Resume(fs::absolute(*folder).lexically_normal().string(), *options); });
}

const RegisterSubCommand kResume(2, "resume", AddResumeCommand);

}  // namespace
}  // namespace swarmanoid

// `swarmanoid reproduce`: runs an archived run again, and says whether each state is equal.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>

#include "common/checkpoint/checkpoint.h"
#include "common/configuration/regular_file.h"
#include "common/configuration/wording.h"
#include "common/configuration/xml_reader.h"
#include "common/configuration/xml_writer.h"
#include "common/errors/exit_codes.h"
#include "common/errors/print_error.h"
#include "common/plugins/plugin_library.h"
#include "common/program/trust_flag.h"
#include "common/run/hash_log.h"
#include "common/space/space.h"
#include "common/version/version.h"
#include "launcher/archive/run_archive.h"
#include "launcher/command/sub_command.h"
#include "launcher/run_experiment.h"
#include "launcher/system/scratch_folder.h"
#include "simulation/load.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;

constexpr const char* kPluginPath = "SWARMANOID_PLUGIN_PATH";
// The options of `run` that only divide or limit the work. They change no bit.
constexpr std::array kOptionsOfRun{"output",       "threads",      "controller-hosts", "quiet",
                                   "step-timeout", "memory-limit", "engine-host",      "hosts"};

struct ReproduceOptions
{
  std::string file;
  bool cluster = false;
  std::vector<std::string> plugins;
  RunSettings run;
};

std::vector<OptionSpec> ReproduceOptionTable(RunSettings& settings)
{
  std::vector<OptionSpec> options = RunOptionTable(settings);
  std::erase_if(options, [](const OptionSpec& option)
                { return std::ranges::find(kOptionsOfRun, option.value.name) == kOptionsOfRun.end(); });
  return options;
}

// Compares the states of a run with the hashes of an archive.
class StateComparison
{
public:
  StateComparison(std::vector<TickHash> hashes, bool has_ended) : hashes_(std::move(hashes)), has_ended_(has_ended) {}

  // Called at each tick of the run. Ends the run, as Ctrl-C does, if the rest of it cannot change the result.
  void Take(const CSwarmanoidSpace& space)
  {
    last_tick_ = space.GetTick();
    if (difference_) return;
    while (next_ < hashes_.size() && hashes_[next_].tick < last_tick_) ++next_;
    if (next_ == hashes_.size() || hashes_[next_].tick != last_tick_) return;
    const std::uint64_t hash = space.Hash();
    if (hash == hashes_[next_].hash)
      ++equal_;
    else
      difference_ = {hashes_[next_], {last_tick_, hash}};
    ++next_;
    if (difference_ || (next_ == hashes_.size() && !has_ended_)) kill(getpid(), SIGINT);
  }

  bool AreAllEqual() const { return equal_ == hashes_.size(); }
  bool HasDifference() const { return difference_.has_value(); }

  // Returns the sentence for the user.
  std::string Text() const
  {
    if (AreAllEqual())
      return fmt::format("equal: {} states, from tick {} to {}, hash {:016x}", equal_, hashes_.front().tick,
                         hashes_.back().tick, hashes_.back().hash);
    if (difference_)
      return fmt::format(
          "different from tick {} on: its hash is {:016x} in the archive, and {:016x} computed again; {} "
          "states before it are equal",
          difference_->first.tick, difference_->first.hash, difference_->second.hash, equal_);
    return fmt::format(
        "different: {} of {} states were computed again; the run ended at tick {}, and in the archive at "
        "{}",
        equal_, hashes_.size(), last_tick_, hashes_.back().tick);
  }

private:
  std::vector<TickHash> hashes_;
  bool has_ended_;
  std::size_t next_ = 0;
  std::size_t equal_ = 0;
  std::uint64_t last_tick_ = 0;
  std::optional<std::pair<TickHash, TickHash>> difference_;  // the archive's, and the computed one
};

// Returns what computes the states here and did not when the archive was made.
std::vector<std::string> DifferencesOf(const ArchiveIndex& index, const Experiment& experiment)
{
  std::vector<std::string> differences;
  const std::vector<LibraryBuild> here = LibraryBuildsOf(experiment);
  const auto name = [](const std::string& version, const std::string& revision)
  { return revision.empty() ? version : fmt::format("{} ({})", version, revision); };
  for (const LibraryBuild& build : index.builds)
  {
    const std::string difference = DifferenceOfBuilds({build}, here);
    if (difference.empty()) continue;
    differences.push_back(build.name != kSwarmanoidBuild
                              ? difference
                              : fmt::format("another build of Swarmanoid: {} then, {} now",
                                            name(index.version, index.revision), name(Version(), GitRevision())));
  }
  return differences;
}

// The archive has no libraries, so a missing one is named with the cure.
void PrintMissingLibraries(const ArchiveIndex& index)
{
  for (const LibraryBuild& build : index.builds)
    if (build.name.ends_with(".so") && FindPluginLibrary(build.name, StandardPluginFolders()).empty())
      PrintError(
          "the run used the library {} (build-id {}), which the archive does not have: build it, and name its "
          "folder with --plugins\n",
          Quoted(build.name), build.build);
}

// Names more folders of libraries to this process and those that it starts.
void AddPluginFolders(const std::vector<std::string>& folders)
{
  std::string path;
  for (const std::string& folder : folders)
  {
    if (!fs::is_directory(folder)) throw UsageError(fmt::format("--plugins {}: it is no folder", Quoted(folder)));
    path += fs::absolute(folder).lexically_normal().string() + ":";
  }
  if (path.empty()) return;
  if (const char* before = std::getenv(kPluginPath); before != nullptr) path += before;
  setenv(kPluginPath, path.c_str(), 1);
}

// Returns the element with the paths that the files of the archive have on this machine. Libraries that the experiment
// names by an absolute path are searched by their names if there is no such file.
std::shared_ptr<const ConfigurationNode> WithMovedFiles(const ConfigurationNode& element,
                                                        const std::map<std::string, std::string>& moved,
                                                        const std::string& folder)
{
  const auto move = [&](std::string& value)
  {
    if (!value.starts_with('/')) return;
    if (const auto found = moved.find(value); found != moved.end()) value = folder + "/" + found->second;
    if (!value.ends_with(".so") || fs::exists(value)) return;
    const std::string name = fs::path(value).filename().string();
    if (const std::string library = FindPluginLibrary(name, StandardPluginFolders()); !library.empty()) value = library;
  };
  auto copy = std::make_shared<ConfigurationNode>(element);
  for (ConfigurationNode::Attribute& attribute : copy->attributes) move(attribute.value);
  move(copy->text);
  for (auto& child : copy->children) child = WithMovedFiles(*child, moved, folder);
  return copy;
}

// Makes the files of the archive those of a run on this machine: the experiment names them where they are, and the
// checkpoint of the start is of that experiment. Returns nothing if the experiment cannot be read, which is printed.
std::unique_ptr<const Experiment> PrepareArchived(const ArchiveIndex& index, const std::string& folder)
{
  const std::string file = folder + "/experiment.xml";
  const std::string text = WriteXml(*WithMovedFiles(*ReadXml(ReadTextFile(file), file), index.moved, folder));
  std::ofstream(file) << text;
  std::unique_ptr<const Experiment> experiment = LoadOrComplain(file, {});
  if (!experiment || !index.Has(kArchivedStart)) return experiment;
  const std::string path = folder + "/" + kArchivedStart;
  const std::string bytes = ReadRegularFile(path, fs::file_size(path));
  Checkpoint start = DecodeCheckpoint(bytes);
  start.origin = OriginOf(*experiment);
  WriteCheckpoint(path, start);
  return experiment;
}

RunSettings SettingsOf(const ReproduceOptions& options, const ArchiveIndex& index, const std::string& folder)
{
  RunSettings settings = options.run;
  settings.file = folder + "/experiment.xml";
  settings.single_process = !options.cluster && settings.controller_hosts == 1 && settings.engine_hosts.empty() &&
                            settings.hosts_file.empty();
  settings.visualisations = false;
  if (settings.output_folder.empty()) settings.output_folder = folder + "/run";
  if (index.Has("events.csv")) settings.events = folder + "/events.csv";
  if (index.Has(kArchivedStart)) settings.restore_file = folder + "/" + kArchivedStart;
  return settings;
}

int Reproduce(const ReproduceOptions& options)
{
  AddPluginFolders(options.plugins);
  if (const std::string mistake = FileMistake(options.file); !mistake.empty())
    throw UsageError(fmt::format("the archive {}: {}", Quoted(options.file), mistake));
  const ScratchFolder scratch;
  const ArchiveIndex index = UnpackArchive(options.file, scratch.Path());
  std::vector<TickHash> hashes = ReadHashLog(scratch.Path() + "/" + kArchivedHashes);
  if (hashes.empty())
    throw ArchiveError(fmt::format("the archive '{}' cannot be used: its {} is empty", options.file, kArchivedHashes));
  StateComparison comparison(std::move(hashes), index.has_ended);

  RunSettings settings = SettingsOf(options, index, scratch.Path());
  const auto experiment = PrepareArchived(index, scratch.Path());
  if (!experiment)
  {
    PrintMissingLibraries(index);
    return kExitInvalidFile;
  }
  const std::vector<std::string> differences = DifferencesOf(index, *experiment);
  // The journal of an experiment with absolute paths is not of the changed one.
  if (experiment->HasGuards() && index.moved.empty() && fs::exists(scratch.Path() + "/journal"))
    settings.faults_of = scratch.Path();
  const int exit_code =
      RunExperiment(RunRequest(settings, [&](CSimulator& simulator) { comparison.Take(simulator.GetSpace()); }));

  if (!comparison.HasDifference() && !comparison.AreAllEqual() && exit_code != kExitDone &&
      exit_code != kExitExperimentFailed)
    return exit_code;
  fmt::print("{}\n", comparison.Text());
  if (comparison.AreAllEqual())
  {
    if (!differences.empty()) PrintError("The states are equal, though this is {}.\n", fmt::join(differences, "; "));
    return kExitDone;
  }
  PrintError("{}\n",
             differences.empty()
                 ? "Builds and files are those of the archive. Probable reason: the code of the experiment is not "
                   "deterministic, or reads a file that the archive lacks (docs/determinism.md)."
                 : fmt::format("Probable reason: {}.", fmt::join(differences, "; ")));
  return kExitHashDiffers;
}

void AddReproduceCommand(CLI::App& app, int& exit_code)
{
  auto options = std::make_shared<ReproduceOptions>();
  CLI::App* verb = app.add_subcommand("reproduce", "Run an archived run again, and compare each state");
  verb->add_option("FILE", options->file, "The file of `swarmanoid archive`")->required();
  verb->add_flag("--cluster", options->cluster, "Run it as a cluster instead of in this process; same hashes");
  verb->add_option("--plugins", options->plugins,
                   "A folder with libraries of the experiment, which the archive names; again for each other one")
      ->type_name("FILE");
  AddOptions(*verb, ReproduceOptionTable(options->run));
  AddTrustFlag(*verb);
  verb->footer(
      "Without --output, nothing is kept. An archive of a stranger is checked as any experiment (docs/security.md).\n"
      "Exit codes: 0 all states are equal, 3 a library is missing, 4 the archive is damaged or the run failed, 5 a "
      "state "
      "differs.\n"
      "Examples:\n"
      "  swarmanoid reproduce figure_3.tar.gz\n"
      "  swarmanoid reproduce figure_3.tar.gz --plugins my_robots/build --controller-hosts 2");
  verb->callback([options, &exit_code] { exit_code = Reproduce(*options); });
}

const RegisterSubCommand kReproduce(8, "reproduce", AddReproduceCommand);

}  // namespace
}  // namespace swarmanoid

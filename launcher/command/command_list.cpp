// `swarmanoid list plugins|experiments|packages`: what an experiment file may use, what runs on this machine, and what
// was installed.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "common/configuration/wording.h"
#include "common/errors/exit_codes.h"
#include "common/errors/print_error.h"
#include "common/experiment/reference.h"
#include "common/plugins/catalogue.h"
#include "common/plugins/plugin_library.h"
#include "common/program/shell_word.h"
#include "common/run/access/run_directory.h"
#include "launcher/command/sub_command.h"
#include "launcher/packages/installed_packages.h"
#include "launcher/plugin_text.h"
#include "simulation/load.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;

constexpr std::array kKinds{PluginKind::kEngine,
                            PluginKind::kSensor,
                            PluginKind::kActuator,
                            PluginKind::kRenderer,
                            PluginKind::kExperimentFunctions,
                            PluginKind::kEntityKind,
                            PluginKind::kController};

// Returns the plug-in folders of a user directory, in which build.sh puts them. The current folder may be such a
// directory.
std::vector<std::string> OwnFolders()
{
  std::vector<std::string> folders;
  for (const char* kind : {"controllers", "entities", "functions", "engines", "devices", "renderers"})
    folders.push_back((fs::current_path() / "simulation_build" / kind).string());
  return folders;
}

std::vector<std::string> SearchedFolders()
{
  std::vector<std::string> folders = OwnFolders();
  for (std::string& folder : StandardPluginFolders()) folders.push_back(std::move(folder));
  return folders;
}

bool IsLabel(const std::string& name)
{
  return std::ranges::any_of(
      kKinds, [&](PluginKind kind) { return !PluginCatalogue::Instance().Implementations(kind, name).empty(); });
}

// Loads the named libraries. Returns the labels to describe in detail: labels among the names, and those of libraries
// found by name.
std::vector<std::string> LoadNamed(const std::vector<std::string>& names)
{
  std::vector<std::string> labels;
  for (const std::string& name : names)
  {
    std::error_code none;
    const bool is_file = fs::is_regular_file(name, none);
    if (!is_file && IsLabel(name))
    {
      labels.push_back(name);
      continue;
    }
    const PluginLibrary& library = LoadPluginLibrary(is_file ? fs::absolute(name).string() : name, SearchedFolders());
    if (library.path.empty())
    {
      std::vector<std::string> known;
      for (const PluginKind kind : kKinds)
        for (std::string& label : PluginCatalogue::Instance().Labels(kind)) known.push_back(std::move(label));
      throw UsageError(
          fmt::format("there is no plug-in {}{}; {}", Quoted(name), DidYouMean(name, known), library.error));
    }
    if (!library.error.empty()) throw UsageError(library.error);
    if (is_file) continue;
    for (const auto& [kind, label] : library.registrations.labels) labels.push_back(label);
  }
  return labels;
}

// Loads every library of plug-ins of the simulator, and the libraries that were built here. Names the libraries that
// cannot be loaded.
void LoadAll()
{
  for (const std::string& folder : SearchedFolders())
  {
    const fs::path path(folder);
    std::error_code none;
    // The folders of the simulator's own libraries also have libraries that are no plug-ins.
    const bool holds_plugins = path.filename() == "swarmanoid" || path.parent_path().filename() == "simulation_build" ||
                               path.filename() == "controllers";
    if (!holds_plugins || !fs::is_directory(path, none)) continue;
    std::vector<std::string> files;
    for (const auto& entry : fs::directory_iterator(path))
      if (entry.path().extension() == ".so") files.push_back(entry.path().string());
    std::ranges::sort(files);
    for (const std::string& file : files)
      if (const PluginLibrary& library = LoadPluginLibrary(file, {}); !library.error.empty())
        PrintError("{}\n", library.error);
  }
}

void PrintPlugins(PluginKind kind)
{
  const auto plugins = PluginCatalogue::Instance().Of(kind);
  if (plugins.empty()) return;
  fmt::print("{}\n", PluginKindTitle(kind));
  for (const PluginDescription* plugin : plugins)
  {
    const bool is_device = kind == PluginKind::kSensor || kind == PluginKind::kActuator;
    fmt::print("  {:<52} {}{}\n", PluginName(*plugin), plugin->brief,
               !is_device                ? ""
               : plugin->channel.empty() ? " (generic)"
                                         : " (specific)");
  }
}

struct ListOptions
{
  std::vector<std::string> names;
  bool all = false;
  bool rows = false;
  bool json = false;
};

void PrintJson(const nlohmann::ordered_json& json)
{
  fmt::print("{}\n", json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

int ListPlugins(const ListOptions& options)
{
  RegisterBuiltins();
  if (options.all) LoadAll();
  const std::vector<std::string> labels = LoadNamed(options.names);
  const auto wanted = [&](const PluginDescription& plugin)
  { return labels.empty() || std::ranges::find(labels, plugin.label) != labels.end(); };
  auto json = nlohmann::ordered_json::array();
  for (const PluginKind kind : kKinds)
  {
    if (labels.empty() && !options.rows && !options.json) PrintPlugins(kind);
    for (const PluginDescription* plugin : PluginCatalogue::Instance().Of(kind))
    {
      if (!wanted(*plugin)) continue;
      if (options.json)
        json.push_back(PluginJson(kind, *plugin));
      else if (options.rows)
        fmt::print("{}", PluginRows(kind, *plugin));
      else if (!labels.empty())
        fmt::print("{}", PluginDetails(kind, *plugin));
    }
  }
  if (options.json) PrintJson(json);
  return kExitDone;
}

int ListSchema(const ListOptions& options)
{
  RegisterBuiltins();
  LoadAll();
  LoadNamed(options.names);
  fmt::print("{}", ExperimentXsd());
  return kExitDone;
}

int ListSettings(const std::string& file, bool as_json)
{
  const auto experiment = LoadOrComplain(file, {});
  if (!experiment) return kExitInvalidFile;
  if (as_json)
  {
    PrintJson(SettingsJson(*experiment));
    return kExitDone;
  }
  fmt::print("{}", SettingRows(*experiment));
  return kExitDone;
}

int ListExperiments(bool as_json)
{
  const auto runs = FindLocalRuns();
  auto json = nlohmann::ordered_json::array();
  if (runs.empty() && !as_json) fmt::print("no experiment runs on this machine\n");
  for (const LocalRun& run : runs)
  {
    if (as_json)
    {
      auto& row = json.emplace_back(
          nlohmann::ordered_json{{"experiment", run.experiment}, {"domain", run.domain}, {"space_server", run.server}});
      if (!run.folder.empty()) row["folder"] = run.folder;
      continue;
    }
    fmt::print("{:<32} domain {:<4} space server {}\n", run.experiment, run.domain, run.server);
  }
  if (as_json) PrintJson(json);
  return kExitDone;
}

// Returns how the files of a package differ from its manifest.
std::string FileStateOf(const PackageInFolder& package)
{
  std::string state;
  const auto add = [&](const char* what, const std::vector<std::string>& files)
  {
    if (!files.empty()) state += fmt::format("{}{}: {}", state.empty() ? "" : "; ", what, Listed(files));
  };
  add("changed since", package.changed);
  add("added", package.added);
  return state.empty() ? "unchanged" : state;
}

int ListPackages(const std::string& folder, bool as_json)
{
  const fs::path place = folder.empty() ? FolderOfPackages() : fs::path(folder);
  if (!fs::is_directory(place)) throw UsageError(fmt::format("there is no folder {}", Quoted(place.string())));
  const std::vector<PackageInFolder> packages = PackagesIn(place);
  auto json = nlohmann::ordered_json::array();
  if (packages.empty() && !as_json) fmt::print("no package is in {}\n", place.string());
  int exit_code = kExitDone;
  for (const PackageInFolder& package : packages)
  {
    const PackageManifest& manifest = package.manifest;
    if (!package.mistake.empty())
    {
      PrintError("{}\n", package.mistake);
      exit_code = kExitInvalidFile;
      continue;
    }
    if (as_json)
    {
      auto& row = json.emplace_back(nlohmann::ordered_json{{"name", manifest.name},
                                                           {"release", manifest.release},
                                                           {"author", manifest.author},
                                                           {"licence", manifest.licence},
                                                           {"summary", manifest.summary},
                                                           {"folder", package.folder},
                                                           {"built", package.is_built},
                                                           {"changed", package.changed},
                                                           {"added", package.added}});
      for (const auto& [kind, names] : manifest.Content()) row["content"][kind] = names;
      continue;
    }
    fmt::print("{} {} by {}, {}{}{}\n", manifest.name, manifest.release, manifest.author, manifest.licence,
               manifest.summary.empty() ? "" : ": ", manifest.summary);
    for (const auto& [kind, names] : manifest.Content())
      fmt::print("  {:<12} {}\n", kind, Listed({names.begin(), names.end()}));
    fmt::print("  {:<12} {}\n", "files", FileStateOf(package));
    const std::string build = (fs::relative(package.folder) / "build.sh").string();
    fmt::print("  {:<12} {}\n", "libraries",
               !manifest.HasSources() ? "none"
               : package.is_built     ? (fs::relative(package.folder) / "simulation_build").string()
                                      : "not built; build them by " + ShellWord(build));
  }
  if (as_json) PrintJson(json);
  return exit_code;
}

void AddListCommand(CLI::App& app, int& exit_code)
{
  CLI::App* verb =
      app.add_subcommand("list", "List plug-ins and parameters, or the experiments that run on this machine");
  verb->require_subcommand(1);
  verb->footer(
      "Examples:\n"
      "  swarmanoid list plugins\n"
      "  swarmanoid list plugins footbot_diffusion                  its parameters\n"
      "  swarmanoid list plugins build/lib/swarmanoid/libfootbot_diffusion.so\n"
      "  swarmanoid list settings configs/diffusion_10.xml          what --set may change in it\n"
      "  swarmanoid list schema > experiment.xsd                    for editors, with the plug-ins built here\n"
      "  swarmanoid list experiments\n"
      "  swarmanoid list packages                                   those that `install` put beside your directory");

  auto options = std::make_shared<ListOptions>();
  CLI::App* plugins = verb->add_subcommand("plugins",
                                           "Engines, sensors, actuators, visualisations, experiment functions "
                                           "and controllers");
  plugins->add_option("NAME", options->names,
                      "A plug-in, whose parameters are to be shown, or a library to load first");
  plugins->add_flag("--all", options->all, "With the controllers and functions that came along, and those built here");
  plugins->add_flag("--rows", options->rows, "For programs: a line for each parameter, fields separated by tabs");
  plugins->add_flag("--json", options->json, "For programs: with their parameters");
  plugins->callback([options, &exit_code] { exit_code = ListPlugins(*options); });

  CLI::App* schema =
      verb->add_subcommand("schema", "The XML schema of experiment files, with all plug-ins, for editors");
  schema->add_option("LIBRARY", options->names, "Libraries to load first, beside those built here");
  schema->callback([options, &exit_code] { exit_code = ListSchema(*options); });

  auto file = std::make_shared<std::string>();
  CLI::App* settings =
      verb->add_subcommand("settings", "What --set may change in an experiment, as PATH=VALUE, and what it means");
  settings->add_option("EXPERIMENT", *file, "The experiment file")->required();
  settings->add_flag("--json", options->json, "For programs");
  settings->callback([file, options, &exit_code] { exit_code = ListSettings(*file, options->json); });

  CLI::App* experiments = verb->add_subcommand("experiments", "Experiments that run on this machine as clusters");
  experiments->add_flag("--json", options->json, "For programs");
  experiments->callback([options, &exit_code] { exit_code = ListExperiments(options->json); });

  CLI::App* packages =
      verb->add_subcommand("packages", "Packages of users: what is in them, and whether files changed");
  packages->add_option("FOLDER", *file, "Where they are; otherwise the folder that holds your user directory");
  packages->add_flag("--json", options->json, "For programs");
  packages->callback([file, options, &exit_code] { exit_code = ListPackages(*file, options->json); });
}

const RegisterSubCommand kList(15, "list", AddListCommand);

}  // namespace
}  // namespace swarmanoid

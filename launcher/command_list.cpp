// `swarmanoid list plugins|experiments`: what an experiment file may use, and what runs on this machine.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cctype>
#include <filesystem>
#include <memory>

#include "common/bus/run_directory.h"
#include "common/plugins/catalogue.h"
#include "common/plugins/library.h"
#include "common/program/exit_codes.h"
#include "launcher/commands.h"

namespace swarmanoid
{
namespace
{

std::string Title(PluginKind kind)
{
  std::string title(PluginKindName(kind));
  title[0] = static_cast<char>(std::toupper(title[0]));
  return title.ends_with('s') ? title : title + "s";
}

void PrintPlugins(PluginKind kind)
{
  const auto plugins = PluginCatalogue::Instance().Of(kind);
  if (plugins.empty()) return;
  fmt::print("{}\n", Title(kind));
  for (const PluginDescription* plugin : plugins)
  {
    const std::string name =
        plugin->implementation.empty() ? plugin->label : fmt::format("{} / {}", plugin->label, plugin->implementation);
    const bool is_device = kind == PluginKind::kSensor || kind == PluginKind::kActuator;
    fmt::print("  {:<52} {}{}\n", name, plugin->brief,
               !is_device                ? ""
               : plugin->channel.empty() ? " (generic)"
                                         : " (specific)");
  }
}

int ListPlugins(const std::vector<std::string>& libraries)
{
  RegisterBuiltins();
  for (const std::string& name : libraries)
  {
    // A path from here, or a name to be searched in the folders of plug-ins.
    std::error_code none;
    const std::string path =
        std::filesystem::is_regular_file(name, none) ? std::filesystem::absolute(name).string() : name;
    const PluginLibrary& library = LoadPluginLibrary(path, StandardPluginFolders());
    if (!library.error.empty()) throw UsageError(library.error);
  }
  for (const PluginKind kind : {PluginKind::kEngine, PluginKind::kSensor, PluginKind::kActuator, PluginKind::kRenderer,
                                PluginKind::kExperimentFunctions, PluginKind::kController})
    PrintPlugins(kind);
  return kExitDone;
}

int ListExperiments()
{
  const auto runs = FindLocalRuns();
  if (runs.empty()) fmt::print("no experiment runs on this machine\n");
  for (const LocalRun& run : runs)
    fmt::print("{:<32} domain {:<4} space server {}\n", run.experiment, run.domain, run.server);
  return kExitDone;
}

}  // namespace

void AddListCommand(CLI::App& app, int& exit_code)
{
  CLI::App* verb = app.add_subcommand("list", "List plug-ins, or the experiments that run on this machine");
  verb->require_subcommand(1);
  verb->footer(
      "Examples:\n"
      "  swarmanoid list plugins\n"
      "  swarmanoid list plugins build/lib/swarmanoid/libfootbot_diffusion.so\n"
      "  swarmanoid list experiments");

  auto libraries = std::make_shared<std::vector<std::string>>();
  CLI::App* plugins = verb->add_subcommand("plugins", "Engines, sensors, actuators, visualisations and controllers");
  plugins->add_option("LIBRARY", *libraries, "Libraries to load first, whose plug-ins are to be listed too");
  plugins->callback([libraries, &exit_code] { exit_code = ListPlugins(*libraries); });

  CLI::App* experiments = verb->add_subcommand("experiments", "Experiments that run on this machine as clusters");
  experiments->callback([&exit_code] { exit_code = ListExperiments(); });
}

}  // namespace swarmanoid

// `swarmanoid check`: checks an experiment file, and lists its content.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "common/activity/exit_codes.h"
#include "common/experiment/notes.h"
#include "common/program/colour.h"
#include "common/program/trust_flag.h"
#include "common/run/run_settings.h"
#include "launcher/command/sub_command.h"
#include "launcher/smoke_test.h"
#include "simulation/load.h"

namespace swarmanoid
{
namespace
{

std::string Counted(std::size_t count, std::string_view noun)
{
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

std::map<EntityKind, std::size_t> CountsOf(const Experiment& experiment)
{
  std::map<EntityKind, std::size_t> counts;
  for (const EntityConfiguration& entity : experiment.entities) ++counts[entity.kind];
  return counts;
}

void PrintEntities(const Experiment& experiment)
{
  std::string kinds;
  for (const auto& [kind, count] : CountsOf(experiment))
    kinds += fmt::format("{}{} {}", kinds.empty() ? ": " : ", ", count, TagName(kind));
  fmt::print("  arena         {} x {} x {} m, {}{}\n", experiment.arena_size.x(), experiment.arena_size.y(),
             experiment.arena_size.z(),
             experiment.entities.size() == 1 ? "1 entity" : fmt::format("{} entities", experiment.entities.size()),
             kinds);
}

void PrintControllers(const Experiment& experiment)
{
  for (const ControllerConfiguration& controller : experiment.controllers)
  {
    const auto robots = static_cast<std::size_t>(std::count_if(experiment.entities.begin(), experiment.entities.end(),
                                                               [&](const EntityConfiguration& entity)
                                                               { return entity.controller == controller.id; }));
    fmt::print("  controller    {} ({}, library {}): {}, {}, {}\n", controller.id, controller.tag, controller.library,
               Counted(robots, "robot"), Counted(controller.sensors.size(), "sensor"),
               Counted(controller.actuators.size(), "actuator"));
  }
}

nlohmann::ordered_json JsonOf(const std::vector<Diagnostic>& diagnostics)
{
  auto json = nlohmann::ordered_json::array();
  for (const Diagnostic& each : diagnostics)
    json.push_back({{"file", each.location.file ? *each.location.file : ""},
                    {"line", each.location.line},
                    {"column", each.location.column},
                    {"message", each.message}});
  return json;
}

// Returns the result as JSON. `errors` has the mistakes of the file; other reasons that keep it from starting go to
// standard error.
nlohmann::ordered_json JsonOf(const Experiment& experiment)
{
  nlohmann::ordered_json json{
      {"experiment", experiment.name},
      {"tick_ms", experiment.clock_tick_ms},
      {"ticks", experiment.max_clock},
      {"seed", experiment.seed},
      {"arena_m", {experiment.arena_size.x(), experiment.arena_size.y(), experiment.arena_size.z()}}};
  json["entities"] = nlohmann::ordered_json::object();
  for (const auto& [kind, count] : CountsOf(experiment)) json["entities"][std::string(TagName(kind))] = count;
  const auto add = [&json](const char* section, const auto& parts)
  {
    json[section] = nlohmann::ordered_json::array();
    for (const auto& part : parts) json[section].push_back({{"id", part.id}, {"tag", part.tag}});
  };
  add("engines", experiment.engines);
  add("controllers", experiment.controllers);
  add("functions", experiment.functions);
  add("visualisations", experiment.visualisations);
  json["notes"] = JsonOf(NotesOn(experiment));
  return json;
}

int CheckForPrograms(const RunSettings& options)
{
  RegisterBuiltins();
  const LoadedExperiment loaded = LoadExperimentFile(options.file, ChangesOf(options));
  nlohmann::ordered_json json{{"file", options.file}, {"valid", false}, {"errors", JsonOf(loaded.errors)}};
  int exit_code = kExitInvalidFile;
  if (loaded.experiment)
  {
    exit_code = FilesAreGood(*loaded.experiment) ? SmokeTest(*loaded.experiment) : int{kExitInvalidFile};
    json["valid"] = exit_code == kExitDone;
    json.update(JsonOf(*loaded.experiment));
  }
  fmt::print("{}\n", json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
  return exit_code;
}

int Check(const RunSettings& options)
{
  const auto experiment = LoadOrComplain(options.file, ChangesOf(options));
  if (!experiment) return kExitInvalidFile;
  if (const int code = SmokeTest(*experiment); code != kExitDone) return code;

  fmt::print("{} is {}: experiment {}\n", options.file, Coloured(STDOUT_FILENO, Colour::kGreen, "valid"),
             experiment->name);
  fmt::print("  clock         {} ms a tick, {}, seed {}\n", experiment->clock_tick_ms,
             experiment->max_clock == 0 ? "without end" : Counted(experiment->max_clock, "tick"), experiment->seed);
  PrintEntities(*experiment);
  for (const EngineConfiguration& engine : experiment->engines)
    fmt::print("  engine        {} ({}): {} of the entities{}\n", engine.id, engine.tag, engine.entities.size(),
               engine.split.regions > 1 ? fmt::format(", in {} regions", engine.split.regions) : "");
  PrintControllers(*experiment);
  for (const FunctionsConfiguration& functions : experiment->functions)
    fmt::print("  functions     {} ({})\n", functions.id, functions.tag);
  for (const RenderConfiguration& render : experiment->visualisations)
    fmt::print("  visualisation {} ({})\n", render.id, render.tag);
  for (const Diagnostic& note : NotesOn(*experiment)) fmt::print("{}: note: {}\n", note.location.Text(), note.message);
  return kExitDone;
}

void AddCheckCommand(CLI::App& app, int& exit_code)
{
  auto options = std::make_shared<RunSettings>();
  CLI::App* verb = app.add_subcommand("check", "Look for mistakes in an experiment file without running it");
  auto json = std::make_shared<bool>(false);
  AddOptions(*verb, ChoiceOptionTable(*options));
  AddTrustFlag(*verb);
  verb->add_flag("--json", *json,
                 "For programs: what the experiment holds, or its mistakes with file, line and column");
  verb->footer(
      "Prints what the experiment holds, and notes on what has no effect, and exits with 0, or prints every mistake "
      "with its place and exits with 3.\n"
      "Everything is made as a run makes it and thrown away: Init of controllers and experiment functions is called.\n"
      "Examples:\n"
      "  swarmanoid check configs/diffusion_10.xml\n"
      "  swarmanoid check configs/diffusion_10.xml --set framework.maxclock=100");
  verb->callback([options, json, &exit_code] { exit_code = *json ? CheckForPrograms(*options) : Check(*options); });
}

const RegisterSubCommand kCheck(10, AddCheckCommand);

}  // namespace
}  // namespace swarmanoid

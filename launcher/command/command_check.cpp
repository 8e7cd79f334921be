// `swarmanoid check`: checks an experiment file, and lists its content.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "argos3/converter/convert.h"
#include "common/configuration/wording.h"
#include "common/errors/exit_codes.h"
#include "common/errors/print_error.h"
#include "common/experiment/notes.h"
#include "common/plugins/catalogue.h"
#include "common/program/colour.h"
#include "common/program/trust_flag.h"
#include "common/run/run_options.h"
#include "launcher/command/engine_exchange.h"
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
      {"tick_ms", experiment.TickSeconds() * 1000},
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

// Returns false, after a message, if `engine` is neither empty nor the name of an engine.
bool IsEngineOrComplain(const std::string& engine)
{
  const std::vector<std::string> engines = PluginCatalogue::Instance().Labels(PluginKind::kEngine);
  if (engine.empty() || std::ranges::find(engines, engine) != engines.end()) return true;
  PrintError("--engine: there is no engine {}; there are: {}{}\n", Quoted(engine), Listed(engines),
             DidYouMean(engine, engines));
  return false;
}

// Prints what the engine changes for the experiment.
int PrintExchange(const Experiment& experiment, const std::string& places, const std::string& engine)
{
  const EngineExchange exchange = ExchangeEngines(experiment, places, engine);
  fmt::print("with {}:\n", engine);
  for (const Diagnostic& error : exchange.errors) fmt::print("{}: refused: {}\n", error.location.Text(), error.message);
  for (const Diagnostic& change : exchange.changes) fmt::print("{}: {}\n", change.location.Text(), change.message);
  if (exchange.errors.empty() && exchange.changes.empty()) fmt::print("  nothing changes\n");
  return exchange.errors.empty() ? kExitDone : kExitInvalidFile;
}

int CheckForPrograms(const RunSettings& options, const std::string& engine)
{
  RegisterBuiltins();
  const LoadedExperiment loaded = LoadExperimentFile(options.file, ChangesOf(options));
  nlohmann::ordered_json json{{"file", options.file}, {"valid", false}, {"errors", JsonOf(loaded.errors)}};
  int exit_code = kExitInvalidFile;
  if (loaded.experiment)
  {
    exit_code = FilesAreGood(*loaded.experiment) ? SmokeTest(*loaded.experiment, options.visualisations)
                                                 : int{kExitInvalidFile};
    json["valid"] = exit_code == kExitDone;
    json.update(JsonOf(*loaded.experiment));
    if (!IsEngineOrComplain(engine)) return kExitUsage;
    if (!engine.empty())
    {
      const EngineExchange exchange = ExchangeEngines(*loaded.experiment, loaded.places, engine);
      json["engine"] = {{"name", engine}, {"errors", JsonOf(exchange.errors)}, {"changes", JsonOf(exchange.changes)}};
      if (!exchange.errors.empty() && exit_code == kExitDone) exit_code = kExitInvalidFile;
    }
  }
  fmt::print("{}\n", json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
  return exit_code;
}

int Check(const RunSettings& options, const std::string& other_engine)
{
  if (!options.visualisations) LetUserFunctionsBeMissing();
  std::string places;
  const auto experiment = LoadOrComplain(options.file, ChangesOf(options), &places);
  if (!experiment) return kExitInvalidFile;
  if (!IsEngineOrComplain(other_engine)) return kExitUsage;
  if (const int code = SmokeTest(*experiment, options.visualisations); code != kExitDone) return code;

  fmt::print("{} is {}: experiment {}\n", options.file, Coloured(STDOUT_FILENO, Colour::kGreen, "valid"),
             experiment->name);
  fmt::print("  clock         {} a tick, {}, seed {}\n",
             experiment->ticks_per_second == 0 ? fmt::format("{} ms", experiment->clock_tick_ms)
                                               : fmt::format("1/{} s", experiment->ticks_per_second),
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
  return other_engine.empty() ? int{kExitDone} : PrintExchange(*experiment, places, other_engine);
}

void AddCheckCommand(CLI::App& app, int& exit_code)
{
  auto options = std::make_shared<RunSettings>();
  CLI::App* verb = app.add_subcommand("check", "Look for mistakes in an experiment file without running it");
  auto json = std::make_shared<bool>(false);
  auto engine = std::make_shared<std::string>();
  AddOptions(*verb, ChoiceOptionTable(*options));
  verb->add_option("--engine", *engine, "Also say what this engine in place of the file's engines would change")
      ->type_name("NAME");
  AddTrustFlag(*verb);
  verb->add_flag("--json", *json,
                 "For programs: what the experiment holds, or its mistakes with file, line and column");
  verb->footer(
      "Prints what the experiment holds, and notes on what has no effect, and exits with 0, or prints every mistake "
      "with its place and exits with 3.\n"
      "Everything is made as a run makes it and thrown away: Init of controllers and experiment functions is called.\n"
      "Examples:\n"
      "  swarmanoid check configs/diffusion_10.xml\n"
      "  swarmanoid check configs/diffusion_10.xml --set framework.maxclock=100\n"
      "  swarmanoid check configs/prey_retrieval.xml --engine dynamics2d");
  verb->callback([options, json, engine, &exit_code]
                 { exit_code = *json ? CheckForPrograms(*options, *engine) : Check(*options, *engine); });
}

const RegisterSubCommand kCheck(12, "check", AddCheckCommand);

}  // namespace
}  // namespace swarmanoid

// `swarmanoid check`: is this experiment file right, and what is in it?
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <memory>

#include "common/activity/exit_codes.h"
#include "common/experiment/notes.h"
#include "common/run/run_settings.h"
#include "launcher/commands.h"
#include "launcher/load.h"
#include "launcher/trial_start.h"

namespace swarmanoid
{
namespace
{

std::string Counted(std::size_t count, std::string_view noun)
{
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

void PrintEntities(const Experiment& experiment)
{
  std::map<EntityKind, std::size_t> counts;
  for (const EntityConfiguration& entity : experiment.entities) ++counts[entity.kind];
  std::string kinds;
  for (const auto& [kind, count] : counts)
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

int Check(const RunSettings& options)
{
  const auto experiment = LoadOrComplain(options.file, ChangesOf(options));
  if (!experiment) return kExitInvalidFile;
  if (const int code = TrialStart(*experiment); code != kExitDone) return code;

  fmt::print("{} is valid: experiment {}\n", options.file, experiment->name);
  fmt::print("  clock         {} ms a tick, {}, seed {}\n", experiment->clock_tick_ms,
             experiment->max_clock == 0 ? "without end" : Counted(experiment->max_clock, "tick"), experiment->seed);
  PrintEntities(*experiment);
  for (const EngineConfiguration& engine : experiment->engines)
    fmt::print("  engine        {} ({}): {} of the entities\n", engine.id, engine.tag, engine.entities.size());
  PrintControllers(*experiment);
  for (const FunctionsConfiguration& functions : experiment->functions)
    fmt::print("  functions     {} ({})\n", functions.id, functions.tag);
  for (const RenderConfiguration& render : experiment->visualisations)
    fmt::print("  visualisation {} ({})\n", render.id, render.tag);
  for (const Diagnostic& note : NotesOn(*experiment)) fmt::print("{}: note: {}\n", note.location.Text(), note.message);
  return kExitDone;
}

}  // namespace

void AddCheckCommand(CLI::App& app, int& exit_code)
{
  auto options = std::make_shared<RunSettings>();
  CLI::App* verb = app.add_subcommand("check", "Look for mistakes in an experiment file without running it");
  AddOptions(*verb, ChoiceOptionTable(*options));
  verb->footer(
      "Prints what the experiment holds, and notes on what has no effect, and exits with 0, or prints every mistake "
      "with its place and exits with 3.\n"
      "Everything is made as a run makes it and thrown away: Init of controllers and experiment functions is called.\n"
      "Examples:\n"
      "  swarmanoid check configs/diffusion_10.xml\n"
      "  swarmanoid check configs/diffusion_10.xml --set framework.maxclock=100");
  verb->callback([options, &exit_code] { exit_code = Check(*options); });
}

}  // namespace swarmanoid

#include "seed_experiment.h"

#include <fmt/format.h>

#include "common/experiment/load_experiment.h"
#include "simulation/register_all.h"
#include "tests/world/experiment_text.h"

namespace swarmanoid::test
{
namespace
{

std::string Wall(const char* id, double x, double y, double size_x, double size_y)
{
  return fmt::format("<block id='{}' position='{},{},0.25' size='{},{},0.5'/>", id, x, y, size_x, size_y);
}

}  // namespace

std::uint64_t RunSeedExperiment(const SeedExperiment& experiment,
                                const std::function<void(const CSwarmanoidSpace&)>& watch)
{
  RegisterBuiltins();
  const double side = experiment.arena_m;
  std::string walls;
  if (experiment.walled)
    walls = Wall("west", 0.05, side / 2, 0.1, side) + Wall("east", side - 0.05, side / 2, 0.1, side) +
            Wall("south", side / 2, 0.05, side - 0.2, 0.1) + Wall("north", side / 2, side - 0.05, side - 0.2, 0.1);
  ExperimentText text;
  text.framework = fmt::format("<maxclock>{}</maxclock>", experiment.ticks);
  text.controllers = Controller({.tag = experiment.controller,
                                 .actuators = {"dummy_footbot_wheels", "generic_footbot_leds"},
                                 .sensors = {"generic_footbot_proximity"},
                                 .attributes = "library='" SEED_BEHAVIORS "'"});
  text.size = fmt::format("{0},{0},1", side);
  text.arena = fmt::format("<footbot id='fb' position='{}' controller='c'/>", experiment.start) + walls;
  text.engines = "<dummy_engine id='ground'/>";
  text.physics = "<engine id='ground'><all/></engine>";
  const auto loaded = text.Load();
  if (!loaded) return 0;
  CSimulator simulator(*loaded);
  if (watch) watch(simulator.GetSpace());
  while (simulator.Step())
    if (watch) watch(simulator.GetSpace());
  return simulator.Finish().hash;
}

}  // namespace swarmanoid::test

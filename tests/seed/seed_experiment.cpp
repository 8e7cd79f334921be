#include "seed_experiment.h"

#include <fmt/format.h>

#include "common/experiment/load_experiment.h"
#include "simulation/register_all.h"

namespace swarmanoid::test
{
namespace
{

constexpr const char* kText = R"(<ahss-config>
  <framework>
    <clocktick>100</clocktick>
    <maxclock>{ticks}</maxclock>
  </framework>
  <controllers>
    <{controller} id="c" library="{library}">
      <actuators>
        <footbot_wheels><implementation>dummy_footbot_wheels</implementation></footbot_wheels>
        <footbot_leds><implementation>generic_footbot_leds</implementation></footbot_leds>
      </actuators>
      <sensors>
        <footbot_proximity><implementation>generic_footbot_proximity</implementation></footbot_proximity>
      </sensors>
    </{controller}>
  </controllers>
  <arena size="{side},{side},1" optimization="2D">
    <footbot id="fb">
      <position>{start}</position>
      <orientation>0, 0, 0</orientation>
      <controller>c</controller>
    </footbot>
    {walls}
  </arena>
  <engines>
    <dummy_engine id="ground">
      <subclock>1</subclock>
      <perpendicular_axis>z</perpendicular_axis>
      <distance>0</distance>
    </dummy_engine>
  </engines>
  <arena_physics>
    <engine id="ground"><all/></engine>
  </arena_physics>
</ahss-config>
)";

std::string Wall(const char* id, double x, double y, double size_x, double size_y)
{
  return fmt::format(
      "<block id=\"{}\"><position>{},{},0.25</position><orientation>0,0,0</orientation><size>{},{},0.5</size></block>",
      id, x, y, size_x, size_y);
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
  const std::string text =
      fmt::format(fmt::runtime(kText), fmt::arg("ticks", experiment.ticks), fmt::arg("library", SEED_BEHAVIORS),
                  fmt::arg("controller", experiment.controller), fmt::arg("side", side),
                  fmt::arg("start", experiment.start), fmt::arg("walls", walls));
  const LoadedExperiment loaded = LoadExperimentText(text, "listing.xml", ".");
  for (const Diagnostic& error : loaded.errors) ADD_FAILURE() << error.Text();
  if (!loaded.experiment) return 0;
  CSimulator simulator(*loaded.experiment);
  if (watch) watch(simulator.GetSpace());
  while (simulator.Step())
    if (watch) watch(simulator.GetSpace());
  return simulator.Finish().hash;
}

}  // namespace swarmanoid::test

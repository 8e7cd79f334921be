// The launcher names the actor of a dead process without the experiment, in the same words.
#include "launcher/supervision/run_actors.h"

#include <gtest/gtest.h>

#include "tests/world/small_experiment.h"

namespace swarmanoid
{
namespace
{

std::string TextOf(const Actor& actor)
{
  return std::to_string(actor.kind) + " " + std::to_string(actor.number) + " " + actor.id + " " + actor.type;
}

TEST(RunActors, AreThoseOfTheExperiment)
{
  std::vector<std::string> expected, found;
  const auto note = [](std::vector<std::string>& texts, const auto& actor_of)
  {
    for (const Actor::Kind kind : {Actor::kNobody, Actor::kRobot, Actor::kFunctions, Actor::kEngine,
                                   Actor::kVisualisation, Actor::kSensor, Actor::kActuator, Actor::kWatcher})
      for (const std::uint32_t number : {0U, 1U, 2U, 3U, 4096U, 4097U}) texts.push_back(TextOf(actor_of(kind, number)));
  };
  const auto actors = [&]
  {
    Experiment experiment;
    experiment.engines.emplace_back().id = "e";
    experiment.functions.emplace_back().tag = "f";
    experiment.visualisations.emplace_back().id = "v";
    for (const char* id : {"first", "second"})
    {
      ControllerConfiguration& controller = experiment.controllers.emplace_back();
      controller.id = id;
      controller.sensors.emplace_back().type = "eye";
      controller.actuators.emplace_back().type = "hand";
    }
    experiment.controllers.back().on_failure = OnFailure::kStopRobot;
    for (const char* controller : {"second", "", "first"})
    {
      EntityConfiguration& robot = experiment.entities.emplace_back();
      robot.id = std::string("a robot with a long name and ") + controller;
      robot.controller = controller;
    }
    note(expected, [&](Actor::Kind kind, std::uint32_t number) { return ActorOf(experiment, kind, number); });
    return RunActors(experiment);
  }();
  note(found, [&](Actor::Kind kind, std::uint32_t number) { return actors.Of(kind, number); });
  EXPECT_EQ(found, expected);
  EXPECT_TRUE(actors.MayFail(0));
  EXPECT_FALSE(actors.MayFail(1));
  EXPECT_FALSE(actors.MayFail(2));
  EXPECT_FALSE(actors.MayFail(3));
}

}  // namespace
}  // namespace swarmanoid

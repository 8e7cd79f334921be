// Experiment functions and robots in one world: what the functions change is what the robots sense.
#include <gtest/gtest.h>

#include <fstream>
#include <vector>

#include "behavior_world.h"
#include "common/control_interface/ci_colour.h"

namespace swarmanoid::test
{
namespace
{

TEST(ExperimentFunctions, WhatTheyPaintAndMoveIsWhatRobotsSense)
{
  BehaviorWorld world;
  world.Patch("patch", 5, 5, "green").Footbot("fb", "show_floor", 5, 5).Functions("stage", STAGE_FUNCTIONS);
  std::vector<std::uint32_t> seen;
  world.Run(20, [&] { seen.push_back(static_cast<std::uint32_t>(world.Attribute("fb", "led"))); });
  // The floor is painted before the controllers of tick 5, and the robot put beside it before those of tick 8; the LEDs
  // of a tick are seen at the next one. The functions end the experiment at tick 12.
  constexpr std::uint32_t kGreen = CCI_Colour::GREEN;
  constexpr std::uint32_t kRed = CCI_Colour::RED;
  EXPECT_EQ(world.Space().GetTick(), 12U);
  ASSERT_EQ(seen.size(), 20U);
  for (std::size_t tick = 1; tick <= 12; ++tick)
    EXPECT_EQ(seen[tick - 1], tick <= 5 ? kGreen : tick <= 8 ? kRed : CCI_Colour::WHITE) << "at tick " << tick;
  EXPECT_EQ(world.Place("fb"), Vector3(2, 3, 0));

  std::ifstream metrics(world.End() + "/stage.csv");
  std::vector<std::string> lines;
  for (std::string line; std::getline(metrics, line);) lines.push_back(line);
  ASSERT_EQ(lines.size(), 14U);
  EXPECT_EQ(lines[0], "tick,x");
  EXPECT_EQ(lines[8], "8,5");
  EXPECT_EQ(lines[9], "9,2");
  EXPECT_EQ(lines[13], "end");
}

}  // namespace
}  // namespace swarmanoid::test

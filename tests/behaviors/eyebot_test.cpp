// Tests each eyebot behaviour of the toolkit by its effects in a world.
#include <gtest/gtest.h>

#include <set>
#include <utility>

#include "behavior_world.h"

namespace swarmanoid::test
{
namespace
{

TEST(EyebotHover, StaysWhereItIs)
{
  BehaviorWorld world;
  world.Eyebot("eb", "hover", 5, 5);
  world.Run(100);
  EXPECT_EQ(world.Place("eb"), Vector3(5, 5, 1.5));
}

TEST(EyebotHover, KeepsTheAltitudeThatIsWanted)
{
  for (const double start : {0.5, 2.0})
  {
    BehaviorWorld world("4,4,3", true);
    world.Eyebot("eb", "hover_at_1", 2, 2, start);
    world.Run(150);
    EXPECT_NEAR(world.Place("eb").z(), 1, 0.02) << "from " << start;
    world.Run(100);
    EXPECT_NEAR(world.Place("eb").z(), 1, 0.02) << "from " << start;
    EXPECT_NEAR(world.Place("eb").x(), 2, 0.05);
  }
}

TEST(EyebotSearch, ComesEverywhereInARoom)
{
  BehaviorWorld world("5,5,3");
  world.Walls(5).Eyebot("eb", "search", 2.5, 2.5);
  std::set<std::pair<int, int>> cells;
  world.Run(9000,
            [&]
            {
              EXPECT_EQ(world.Place("eb").z(), 1.5);
              cells.emplace(world.Place("eb").x() / 1.25, world.Place("eb").y() / 1.25);
            });
  EXPECT_EQ(cells.size(), 16U);
}

TEST(EyebotGoTo, HoversAboveTheBlobOfItsColour)
{
  BehaviorWorld world;
  world.Footbot("blue", "show_blue", 6, 5.5).Footbot("red", "show_red", 5, 4.8).Eyebot("eb", "go_to_blue", 5, 5);
  world.Run(150);
  EXPECT_LT(world.Distance("eb", "blue"), 0.25);
  const Vector3 there = world.Place("eb");
  world.Run(20);
  EXPECT_EQ(world.Place("eb"), there);
}

TEST(EyebotFollow, KeepsItsDistanceToARobotThatDrives)
{
  BehaviorWorld world("20,10,3");
  world.Footbot("blue", "drive_blue", 5, 5).Eyebot("eb", "follow_blue", 4.2, 5.3);
  world.Run(200);
  world.Run(400,
            [&]
            {
              EXPECT_LT(world.Distance("eb", "blue"), 0.8);
              EXPECT_GT(world.Distance("eb", "blue"), 0.2);
            });
  EXPECT_GT(world.Place("eb").x(), 10);
}

}  // namespace
}  // namespace swarmanoid::test

// Tests each handbot behaviour of the toolkit by its effects in a world.
#include <gtest/gtest.h>

#include <algorithm>

#include "behavior_world.h"

namespace swarmanoid::test
{
namespace
{

TEST(HandbotClimb, PullsItselfUpUntilTheRopeIsAsShortAsWanted)
{
  BehaviorWorld world("4,4,3", true);
  world.Handbot("hb", "climb", 2, 2);
  world.Run(30);
  EXPECT_EQ(world.Attribute("hb", "rope_attached"), 1);
  const double before = world.Attribute("hb", "rope_length");
  world.Run(370);
  EXPECT_NEAR(world.Attribute("hb", "rope_length"), 1, 0.02);
  // It is as much higher as the rope is shorter, whatever was done before tick 30, and stays there.
  EXPECT_GT(world.Place("hb").z(), 1);
  const double height = world.Place("hb").z();
  EXPECT_LT(world.Attribute("hb", "rope_length"), before);
  world.Run(100);
  EXPECT_NEAR(world.Place("hb").z(), height, 0.03);
}

TEST(HandbotGrasp, TakesWhatStandsBeforeItsHands)
{
  BehaviorWorld world("4,4,3", true);
  world.Block("book", "2.29,2,0.1", "0.04,0.12,0.2", "<movable>true</movable><mass>0.3</mass>");
  world.Handbot("hb", "grasp", 2, 2);
  double widest = 0;
  world.Run(100, [&] { widest = std::max(widest, world.Attribute("hb", "arm", 0)); });
  EXPECT_NEAR(widest, 0.6, 0.1);
  const double left = world.Attribute("hb", "gripped", 0);
  const double right = world.Attribute("hb", "gripped", 1);
  const double held = left > 0 ? left : right;
  ASSERT_GT(held, 0);
  EXPECT_EQ(world.Space().GetEntity(static_cast<std::size_t>(held) - 1).GetId(), "book");
  world.Run(100);
  EXPECT_GT(world.Attribute("hb", "gripped", 0) + world.Attribute("hb", "gripped", 1), 0);
}

TEST(HandbotGrasp, TriesAgainWhereNothingIsThere)
{
  BehaviorWorld world("4,4,3", true);
  world.Handbot("hb", "grasp", 2, 2);
  int openings = 0;
  bool open = false;
  world.Run(300,
            [&]
            {
              const double arm = world.Attribute("hb", "arm", 0);
              openings += !open && arm > 0.5 ? 1 : 0;
              open = arm > 0.5 || (open && arm > 0.1);
              EXPECT_EQ(world.Attribute("hb", "gripped", 0), 0);
            });
  EXPECT_GT(openings, 2);
}

}  // namespace
}  // namespace swarmanoid::test

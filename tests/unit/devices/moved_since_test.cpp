#include "controller_host/devices/sensing/moved_since.h"

#include <gtest/gtest.h>

#include <numeric>

#include "tests/unit/devices/test_world.h"

namespace swarmanoid
{
namespace
{

class MovedSinceTest : public testing::Test
{
protected:
  MovedSinceTest()
  {
    for (int n = 0; n < 21; ++n) world_.AddFootbot(0.4 * n, 1);
    bodies_.resize(21);
    std::iota(bodies_.begin(), bodies_.end(), 0U);
  }

  // Moves one body by `metres` in each tick, and returns the number of searches in `ticks` ticks.
  int Looks(MovedSince& moved, double metres, int ticks)
  {
    int looks = 0;
    for (int tick = 0; tick < ticks; ++tick)
    {
      Pose pose = world_.Space().GetPose(20);
      pose.position.y() += metres;
      world_.Space().SetPose(20, pose);
      moved.Follow(nullptr);
      looks += moved.Holds() && moved.IsNow() ? 1 : 0;
    }
    return looks;
  }

  TestWorld world_;
  std::vector<std::uint32_t> bodies_;
};

TEST_F(MovedSinceTest, LooksAnewBeforeSomebodyHasGoneHalfTheMargin)
{
  MovedSince moved(world_.Space(), bodies_);
  moved.Follow(nullptr);
  ASSERT_TRUE(moved.Holds() && moved.IsNow());
  for (int tick = 0; tick < 100; ++tick)
  {
    const Vector3 then = world_.Space().GetPose(20).position;
    const std::uint64_t number = moved.Number();
    int ticks = 0;
    while (true)
    {
      Looks(moved, 0.004, 1);
      if (moved.Number() != number) break;
      EXPECT_LE((world_.Space().GetPose(20).position - then).norm(), moved.Margin() / 2 + 1e-12);
      ++ticks;
    }
    EXPECT_GE(ticks, 6);
    EXPECT_LE(ticks, 10);
  }
}

TEST_F(MovedSinceTest, LeavesItWhereBodiesAreFast)
{
  MovedSince moved(world_.Space(), bodies_);
  EXPECT_LT(Looks(moved, 0.1, 400), 20);
  EXPECT_GT(Looks(moved, 0.001, 200), 5) << "and tries again";
  EXPECT_TRUE(moved.Holds());
}

TEST_F(MovedSinceTest, DoesNotHoldWhileSomebodyIsTilted)
{
  MovedSince moved(world_.Space(), bodies_);
  moved.Follow(nullptr);
  // By so little that its square is 0.
  world_.Space().SetPose(3, {{1.2, 1, 0}, Quaternion(1, 1e-200, 0, 0)});
  moved.Follow(nullptr);
  EXPECT_FALSE(moved.Holds());
}

TEST_F(MovedSinceTest, LooksAnewWhenSomebodyLeaves)
{
  MovedSince moved(world_.Space(), bodies_);
  moved.Follow(nullptr);
  const std::uint64_t number = moved.Number();
  world_.Space().SetAttribute(world_.Space().PresenceSlot(4), 0);
  Looks(moved, 0, 1);
  EXPECT_FALSE(moved.Holds() && moved.Number() == number);
}

}  // namespace
}  // namespace swarmanoid

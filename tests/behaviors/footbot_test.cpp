// Tests each footbot behaviour of the toolkit by its effects in a world.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "behavior_world.h"
#include "common/math/elementary.h"
#include "common/math/pose.h"
#include "common/space/entity.h"

namespace swarmanoid::test
{
namespace
{

constexpr double kRadius = 0.085036758;
constexpr double kTick = 0.1;

double HeadingOf(BehaviorWorld& world, const std::string& id)
{
  return YawOf(world.Space().FindEntity(id)->GetOrientation());
}

TEST(FootbotRandomWalk, GoesStraightForRandomTimesAndTurnsByRandomAngles)
{
  BehaviorWorld world("200,200,1");
  world.Footbot("fb", "random_walk", 100, 100);
  double straight_s = 0;
  std::vector<double> turns;
  bool turning = false;
  Vector3 last = world.Place("fb");
  double heading = HeadingOf(world, "fb");
  world.Run(20000,
            [&]
            {
              const Vector3 here = world.Place("fb");
              const double way = (here - last).norm();
              const double turned = WrapAngle(HeadingOf(world, "fb") - heading);
              last = here;
              heading = HeadingOf(world, "fb");
              if (std::abs(turned) > 1e-6)
              {
                EXPECT_LT(way, 1e-9);  // on the spot
                if (!turning) turns.push_back(0);
                turns.back() += turned;
                turning = true;
              }
              else
              {
                EXPECT_NEAR(way, 0.1 * kTick, 1e-9);
                straight_s += kTick;
                turning = false;
              }
            });
  // The default of the constructor is 3 s between two turns on average, and up to 2 rad to either side.
  const auto count = static_cast<double>(turns.size());
  ASSERT_GT(count, 100);
  EXPECT_NEAR(straight_s / count, 3, 0.3);
  const auto [least, most] = std::minmax_element(turns.begin(), turns.end());
  EXPECT_GT(*least, -2.01);
  EXPECT_LT(*most, 2.01);
  EXPECT_LT(*least, -1.8);
  EXPECT_GT(*most, 1.8);
}

TEST(FootbotRandomWalk, IsAnotherOneForEachSeedAndRobot)
{
  std::set<double> ends;
  for (int seed = 1; seed <= 3; ++seed)
  {
    BehaviorWorld world;
    world.Seed(seed).Footbot("fb_1", "random_walk", 3, 5).Footbot("fb_2", "random_walk", 7, 5);
    world.Run(300);
    ends.insert(world.Place("fb_1").x() - 3);
    ends.insert(world.Place("fb_2").x() - 7);
  }
  EXPECT_EQ(ends.size(), 6U);
}

class FootbotObstacleAvoidance : public testing::TestWithParam<const char*>
{
};

TEST_P(FootbotObstacleAvoidance, KeepsOffTheWallsFromAnyHeadingAndGoesOn)
{
  for (int heading = 0; heading < 360; heading += 25)
  {
    BehaviorWorld world("2,2,3");
    world.Walls(2).Footbot("fb", GetParam(), 1, 1, heading);
    double way = 0;
    Vector3 last = world.Place("fb");
    world.Run(1000,
              [&]
              {
                const Vector3 here = world.Place("fb");
                ASSERT_GT(std::min({here.x() - 0.1, 1.9 - here.x(), here.y() - 0.1, 1.9 - here.y()}), kRadius + 1e-3)
                    << "from heading " << heading << " at tick " << world.Space().GetTick();
                if (world.Space().GetTick() > 500) way += (here - last).norm();
                last = here;
              });
    // It makes at least half of the way at full speed, so it does not stop before a wall for good.
    EXPECT_GT(way, 0.5 * 500 * kTick * 0.1) << "from heading " << heading;
  }
}

TEST_P(FootbotObstacleAvoidance, LeavesTheWheelsAloneWhereNothingIsNear)
{
  BehaviorWorld world;
  world.Footbot("fb", GetParam(), 1, 5);
  world.Run(100);
  EXPECT_NEAR(world.Place("fb").x(), 2, 1e-9);
  EXPECT_NEAR(world.Place("fb").y(), 5, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Versions, FootbotObstacleAvoidance, testing::Values("avoid_by_vector", "avoid_by_weights"),
                         [](const auto& version) { return std::string(version.param); });

TEST(FootbotRandomWalkWithObstacleAvoidance, ComesEverywhereInARoomWithColumns)
{
  BehaviorWorld world("3,3,3");
  world.Walls(3).Block("a", "1,1,0.5", "0.2,0.2,1").Block("b", "2,1.8,0.5", "0.3,0.2,1");
  world.Footbot("fb", "wander", 1.5, 0.5);
  std::set<std::pair<int, int>> cells;
  world.Run(12000, [&] { cells.emplace(world.Place("fb").x() / 0.75, world.Place("fb").y() / 0.75); });
  EXPECT_EQ(cells.size(), 16U);
}

TEST(FootbotGoToLight, GoesToTheLightFromAnyHeadingAndStopsThere)
{
  for (int heading = -180; heading < 180; heading += 60)
  {
    BehaviorWorld world;
    world.Light("sun", "5,5,0.1", 0.4).Footbot("fb", "go_to_light", 3.5, 4, heading);
    world.Run(600);
    // It stops where the strongest reading is 0.95: (0.4 / d)^2 in the middle of the view of a sensor.
    EXPECT_NEAR(world.Distance("fb", "sun"), 0.41, 0.05) << "from heading " << heading;
    const Vector3 there = world.Place("fb");
    world.Run(50);
    EXPECT_EQ(world.Place("fb"), there) << "from heading " << heading;
  }
}

TEST(FootbotGoToLight, FleesFromItWhereAsked)
{
  BehaviorWorld world;
  world.Light("sun", "5,5,0.3").Footbot("fb", "flee_light", 4.5, 4.5, 45);
  world.Run(200);
  EXPECT_GT(world.Distance("fb", "sun"), 2);
}

TEST(FootbotGoToBlob, GoesToTheNearestOfItsColourAndStops)
{
  BehaviorWorld world;
  world.Footbot("near_blue", "show_blue", 6, 6)
      .Footbot("far_blue", "show_blue", 3, 3)
      .Footbot("red", "show_red", 5.3, 5);
  world.Footbot("fb", "go_to_blue", 5, 5.5, 180);
  world.Run(300);
  // 0.3 m is where the test's behaviour stops; blobs are LEDs on the ring of the other robot.
  EXPECT_LT(world.Distance("fb", "near_blue"), 0.3 + kRadius + 0.02);
  EXPECT_GT(world.Distance("fb", "near_blue"), 0.25);
  const Vector3 stopped = world.Place("fb");
  world.Run(20);
  EXPECT_EQ(world.Place("fb"), stopped);
}

TEST(FootbotGoToBlob, DecidesNothingWithoutABlob)
{
  BehaviorWorld world;
  world.Footbot("red", "show_red", 6, 5).Footbot("fb", "go_to_blue", 5, 5);
  world.Run(50);
  EXPECT_EQ(world.Place("fb"), Vector3(5, 5, 0));
}

TEST(FootbotFlocking, KeepsTheWantedDistanceAndGoesToTheLightTogether)
{
  BehaviorWorld world("12,12,3");
  world.Light("sun", "10,6,1");
  std::vector<std::string> flock;
  for (int i = 0; i < 7; ++i)
  {
    flock.push_back("fb_" + std::to_string(i));
    // The robots start too close to each other, with headings in all directions.
    world.Footbot(flock.back(), "flock", 4 + 0.25 * (i % 3), 6 + 0.25 * (i / 3), 50 * i);
  }
  const auto centre = [&]
  {
    Vector3 sum = Vector3::Zero();
    for (const std::string& id : flock) sum += world.Place(id);
    return Vector3(sum / static_cast<double>(flock.size()));
  };
  const Vector3 start = centre();
  world.Run(600);
  EXPECT_GT((centre() - start).x(), 1);
  for (const std::string& id : flock)
  {
    double nearest = 100;
    for (const std::string& other : flock)
      if (other != id) nearest = std::min(nearest, world.Distance(id, other));
    // The wanted distance is 0.4 m; the light pulls them together a little.
    EXPECT_GT(nearest, 0.25) << id;
    EXPECT_LT(nearest, 0.6) << id;
  }
}

TEST(FootbotGrip, FindsItsWayToThePreyAndHoldsIt)
{
  for (int heading = -150; heading <= 180; heading += 66)
  {
    BehaviorWorld world;
    world.Prey("yellow", 5.5, 5.2, "yellow").Prey("magenta", 4.6, 5, "magenta").Footbot("fb", "grip", 5, 5, heading);
    world.Run(400);
    const double held = world.Attribute("fb", "gripped");
    ASSERT_GT(held, 0) << "from heading " << heading;
    EXPECT_EQ(world.Space().GetEntity(static_cast<std::size_t>(held) - 1).GetId(), "yellow");
  }
}

TEST(FootbotFollowLaser, FollowsTheSpotAndWaitsWhereItIsLost)
{
  BehaviorWorld world;
  world.Eyebot("eb", "lead", 4, 5).Footbot("fb", "follow_laser", 3.6, 5.3, -90);
  // The leader flies 1.2 m in 20 s with its laser on; the spot is straight below.
  world.Run(200);
  EXPECT_GT(world.Place("eb").x(), 5.1);
  EXPECT_LT(world.Distance("fb", "eb"), 0.35);
  world.Run(2);
  const Vector3 waiting = world.Place("fb");
  world.Run(100);
  EXPECT_EQ(world.Place("fb"), waiting);
  EXPECT_GT(world.Distance("fb", "eb"), 0.5);
}

}  // namespace
}  // namespace swarmanoid::test

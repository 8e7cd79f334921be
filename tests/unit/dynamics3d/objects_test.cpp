// Blocks and preys: how they bounce, stack, come to rest and are woken.
#include "dynamics3d_test_world.h"

namespace swarmanoid
{
namespace
{

const Vector3 kCube(0.2, 0.2, 0.2);

// Returns the heights above the ground between the bounces of something dropped from 2 m, at the default settings.
std::vector<double> Bounces(bool is_prey, const char* restitution)
{
  Dynamics3dTestWorld world;
  world.experiment.clock_tick_ms = 10;
  world.Set("restitution", restitution);
  const auto thing = is_prey ? world.AddPrey({5, 5, 2}, 0.5) : world.AddBlock({5, 5, 2.1}, kCube, 1);
  const double rest = is_prey ? 0 : 0.1;
  world.Start();
  std::vector<double> tops;
  double before = 2;
  double now = 2;
  while (tops.size() < 3)
  {
    world.Tick();
    const double next = world.Position(thing).z() - rest;
    if (now > before && now >= next) tops.push_back(now);
    before = now;
    now = next;
  }
  EXPECT_LT(world.Tilt(thing), DegreesToRadians(0.1));
  EXPECT_LT((world.Position(thing) - Vector3(5, 5, 0)).head<2>().norm(), 1e-3);
  return tops;
}

TEST(Dynamics3dObjects, WhatIsDroppedFlatBouncesToTheSquareOfItsRestitutionEachTime)
{
  for (const bool is_prey : {false, true})
  {
    const std::vector<double> tops = Bounces(is_prey, "0.8");
    for (std::size_t bounce = 0; bounce < 3; ++bounce)
      EXPECT_NEAR(tops[bounce], 2 * std::pow(0.64, static_cast<double>(bounce) + 1), 0.015) << bounce;
  }
}

TEST(Dynamics3dObjects, WhatIsElasticKeepsItsHeight)
{
  for (const double top : Bounces(false, "1")) EXPECT_NEAR(top, 2, 0.01);
}

// Whatever it overlaps the ground by when it lands: with the height.
TEST(Dynamics3dObjects, WhatHasNoRestitutionStaysWhereItFell)
{
  for (const double height : {0.4, 1.0, 2.0, 2.02, 2.05})
  {
    Dynamics3dTestWorld world;
    world.experiment.clock_tick_ms = 10;
    const auto cube = world.AddBlock({5, 5, 0.1 + height}, kCube, 1);
    world.Start();
    while (world.Position(cube).z() >= 0.1) world.Tick();
    double highest = 0;
    for (int tick = 0; tick < 100; ++tick)
    {
      world.Tick();
      highest = std::max(highest, world.Position(cube).z());
    }
    EXPECT_LT(highest, 0.101) << height;
  }
}

// A disc that is pushed by a disc along x leaves to the side: without slip at the contact, tan(a / 2) of the angle a to
// its middle grows by e every L (1 + 1 / k), with L the sum of the radii and k = (R f / t)² of the largest force f and
// torque t of its friction on the ground; for a disc k = 9/4.
TEST(Dynamics3dObjects, APreyOffTheMiddleLeavesTheRobotThatPushesIt)
{
  for (const double offset : {0.002, 0.01})
  {
    Dynamics3dTestWorld world;
    const double reach = 0.085036758 + 0.1;
    const auto footbot = world.AddFootbot({2, 5, 0});
    const auto prey = world.AddPrey({2.001 + std::sqrt(reach * reach - offset * offset), 5 + offset, 0}, 0.5);
    world.Drive(footbot, 0.05, 0.05);
    Vector3 arm = Vector3::UnitX();
    for (int tick = 0; tick < 1000 && std::abs(arm.y()) < arm.x(); ++tick)
    {
      world.Tick();
      arm = world.Position(prey) - world.Position(footbot);
    }
    const double way = reach * (1 + 4.0 / 9) * std::log(std::tan(kPi / 8) / std::tan(std::asin(offset / reach) / 2));
    EXPECT_NEAR(world.Position(footbot).x() - 2, way, 0.06 * way) << offset;
  }
}

TEST(Dynamics3dObjects, APileOfTwentyCubesStandsForAMinute)
{
  Dynamics3dTestWorld world;
  std::vector<std::uint32_t> cubes;
  for (int k = 0; k < 20; ++k) cubes.push_back(world.AddBlock({5, 5, 0.1 + 0.2 * k}, kCube, 1));
  world.Run(600);
  for (std::size_t k = 0; k < cubes.size(); ++k)
  {
    EXPECT_LT((world.Position(cubes[k]) - Vector3(5, 5, 0)).head<2>().norm(), 0.005) << k;
    EXPECT_NEAR(world.Position(cubes[k]).z(), 0.1 + 0.2 * static_cast<double>(k), 0.005) << k;
    EXPECT_LT(world.Tilt(cubes[k]), DegreesToRadians(0.2)) << k;
  }
  EXPECT_EQ(world.engine->WorldForTest().SleeperCount(), cubes.size());
}

// A robot drives against a pile that sleeps.
TEST(Dynamics3dObjects, ARobotWakesAPileAndPushesIt)
{
  Dynamics3dTestWorld world;
  const auto lower = world.AddBlock({5.5, 5, 0.05}, {0.2, 0.2, 0.1}, 0.2);
  const auto upper = world.AddBlock({5.5, 5, 0.15}, {0.2, 0.2, 0.1}, 0.2);
  const auto far = world.AddBlock({8, 5, 0.1}, kCube, 0.2);
  const auto footbot = world.AddFootbot({5, 5, 0});
  world.Run(30);
  EXPECT_EQ(world.engine->WorldForTest().SleeperCount(), 3U);
  world.Drive(footbot, 0.2, 0.2);
  world.Run(50);
  EXPECT_EQ(world.engine->WorldForTest().SleeperCount(), 1U);
  const double front = world.Position(footbot).x() + 0.085;
  EXPECT_GT(front, 5.7);
  EXPECT_NEAR(world.Position(lower).x(), front + 0.1, 0.02);
  EXPECT_GT(world.Position(upper).x(), 5.7);
  EXPECT_NEAR(world.Position(far).x(), 8, 1e-4);
  world.Drive(footbot, -0.2, -0.2);
  world.Run(20);
  EXPECT_EQ(world.engine->WorldForTest().SleeperCount(), 3U);
}

TEST(Dynamics3dObjects, AnObjectFallsWhenWhatItSleptOnIsTakenAway)
{
  Dynamics3dTestWorld world;
  const auto lower = world.AddBlock({5, 5, 0.1}, kCube, 1);
  const auto upper = world.AddBlock({5, 5, 0.3}, kCube, 1);
  world.Run(20);
  ASSERT_EQ(world.engine->WorldForTest().SleeperCount(), 2U);
  world.Space().SetPose(lower, {Vector3(8, 5, 0.1), Quaternion::Identity()});
  world.engine->EntityMoved(lower);
  world.Run(10);
  EXPECT_NEAR(world.Position(upper).z(), 0.1, 2e-3);
}

// By Newton's first law, no gliding body is put to sleep, and no body in the air that stands still for a moment.
TEST(Dynamics3dObjects, WhatGlidesSlowlyWithoutFrictionGoesOn)
{
  Dynamics3dTestWorld world("friction", "0");
  const auto block = world.AddBlock({5, 5, 0.1}, kCube, 1);
  const auto mirror = world.AddFootbot({4.805, 5, 0});
  world.MakeMirror(mirror);
  world.Start();
  for (int tick = 1; tick <= 20; ++tick)  // pushed on to 1 cm/s
  {
    world.Tick();
    world.Space().SetPose(mirror, {Vector3(4.805 + 0.001 * tick, 5, 0), Quaternion::Identity()});
  }
  world.Space().SetPose(mirror, {Vector3(2, 5, 0), Quaternion::Identity()});
  world.Run(2);
  const double start = world.Position(block).x();
  world.Run(100);
  EXPECT_NEAR(world.Position(block).x() - start, 0.1, 0.002);
}

// A scene and its mirror image in the plane y = 5 are in one world: three preys, one of which a robot pushes onto the
// others, and a cube that falls.
TEST(Dynamics3dObjects, MirroredScenesStayMirrored)
{
  Dynamics3dTestWorld world;
  std::vector<std::uint32_t> things[2];
  std::uint32_t robots[2];
  for (const int side : {0, 1})
  {
    const double sign = side == 0 ? 1 : -1;
    robots[side] = world.AddFootbot({3, 5 + sign * 1, 0});
    // A round robot pushes a round prey off its way, and the offset grows by e every 0.27 m, rounding too.
    things[side].push_back(world.AddPrey({3.3, 5 + sign * 1.03, 0}, 0.3));
    things[side].push_back(world.AddPrey({3.6, 5 + sign * 1.05, 0}, 0.3));
    things[side].push_back(world.AddPrey({3.6, 5 + sign * 0.8, 0}, 0.3));
    things[side].push_back(world.AddBlock({3, 5 + sign * 2, 1}, kCube, 1));
    things[side].push_back(robots[side]);
  }
  world.Set("restitution", "0.5");
  for (const auto robot : robots) world.Drive(robot, 0.2, 0.2);
  world.Run(15);
  for (std::size_t k = 0; k < things[0].size(); ++k)
  {
    const Vector3 a = world.Position(things[0][k]);
    const Vector3 b = world.Position(things[1][k]);
    EXPECT_LT((a - Vector3(b.x(), 10 - b.y(), b.z())).norm(), 0.01) << "thing " << k;
  }
  EXPECT_GT(world.Position(things[0][1]).x(), 3.65) << "the robot was to push";
}

}  // namespace
}  // namespace swarmanoid

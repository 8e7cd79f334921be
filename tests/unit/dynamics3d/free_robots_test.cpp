// A closed form moves robots that touch only level ground. The tests check which ones, and that it makes no difference.
#include <algorithm>
#include <cmath>
#include <functional>

#include "common/math/random.h"
#include "dynamics3d_test_world.h"
#include "engine_worker/engines/dynamics3d/differential_drive.h"

namespace swarmanoid
{
namespace
{

using dynamics3d::OdeWorld;

const dReal* VelocityOf(Dynamics3dTestWorld& world, std::uint32_t entity)
{
  return dBodyGetLinearVel(world.engine->WorldForTest().Body(world.engine->ModelForTest(entity)->MainBody()));
}

bool IsFree(const Dynamics3dTestWorld& world, std::uint32_t entity)
{
  const auto* robot = dynamic_cast<const dynamics3d::WheeledModel*>(world.engine->ModelForTest(entity));
  return robot != nullptr && robot->IsFree();
}

// It is the same world twice, once with all robots in the solver.
struct FreeAndSolved
{
  explicit FreeAndSolved(const std::function<void(Dynamics3dTestWorld&)>& add)
  {
    solved.Set("solve_all", "true");
    for (Dynamics3dTestWorld* world : {&free, &solved})
    {
      add(*world);
      world->UseTurrets();
      world->Start();
    }
  }
  void Drive(std::uint32_t robot, double left, double right)
  {
    for (Dynamics3dTestWorld* world : {&free, &solved}) world->Drive(robot, left, right);
  }
  void Tick()
  {
    free.Tick();
    solved.Tick();
  }

  Dynamics3dTestWorld free, solved;
};

TEST(Dynamics3dFreeRobots, AFreeRobotGoesWhereTheSolverWouldTakeIt)
{
  double farthest = 0, largest_turn = 0;
  for (std::uint32_t trial = 0; trial < 20; ++trial)
  {
    std::uint32_t robot = 0;
    FreeAndSolved worlds([&](Dynamics3dTestWorld& world) { robot = world.AddFootbot({5, 5, 0}, 0.4 * trial); });
    for (int tick = 0; tick < 200; ++tick)
    {
      if (tick % 10 == 0)
      {
        RandomStream random(7, trial, 0, static_cast<std::uint32_t>(tick));
        const double left = random.Uniform(-0.3, 0.3);
        worlds.Drive(robot, left, random.Uniform(-0.3, 0.3));
        for (Dynamics3dTestWorld* world : {&worlds.free, &worlds.solved})
          world->Command("footbot_turret", robot, {left});
      }
      worlds.Tick();
      ASSERT_EQ(worlds.free.engine->FreeRobotCount(), 1U);
      ASSERT_EQ(worlds.solved.engine->FreeRobotCount(), 0U);
      EXPECT_NEAR(worlds.free.Attribute(robot, "turret_angle"), worlds.solved.Attribute(robot, "turret_angle"), 1e-5);
      // A robot that pitches while it speeds up turns its wheels against itself, and its middle to and fro.
      for (int wheel = 0; wheel < 2; ++wheel)
        ASSERT_NEAR(worlds.free.Sensor("footbot_encoders", robot, wheel),
                    worlds.solved.Sensor("footbot_encoders", robot, wheel), 1e-3)
            << trial << ", tick " << tick;
      for (int axis = 0; axis < 3; ++axis)
        ASSERT_NEAR(worlds.free.Sensor("footbot_accelerometer", robot, axis),
                    worlds.solved.Sensor("footbot_accelerometer", robot, axis), 0.5)
            << trial << ", tick " << tick;
    }
    farthest = std::max(farthest, (worlds.free.Position(robot) - worlds.solved.Position(robot)).norm());
    largest_turn = std::max(largest_turn, std::abs(WrapAngle(worlds.free.Yaw(robot) - worlds.solved.Yaw(robot))));
  }
  EXPECT_LT(farthest, 0.015);
  EXPECT_LT(largest_turn, DegreesToRadians(1.5));
}

// Until the command is reached.
TEST(Dynamics3dFreeRobots, AFreeRobotSpeedsUpAsItsMotorsAllow)
{
  Dynamics3dTestWorld world;
  world.experiment.clock_tick_ms = 10;
  const auto robot = world.AddFootbot({2, 5, 0});
  world.Drive(robot, 0.3, 0.3);
  for (int tick = 1; tick <= 11; ++tick)
  {
    world.Tick();
    const double t = 0.01 * tick;
    EXPECT_NEAR(world.Position(robot).x() - 2, WayOfStartingFootbot(t), 1e-3) << t;
  }
  EXPECT_EQ(world.engine->FreeRobotCount(), 1U);
  world.Run(10);
  EXPECT_NEAR(VelocityOf(world, robot)[0], 0.3, 1e-9);
}

TEST(Dynamics3dFreeRobots, OnAnArcTheyStayOnTheCircle)
{
  Dynamics3dTestWorld world;
  const auto robot = world.AddFootbot({5, 5, 0});
  world.Drive(robot, 0.1, 0.2);
  world.Run(10);
  // The middle is 0.21 m to the left.
  const double yaw = world.Yaw(robot);
  const Vector3 middle = world.Position(robot) + 0.21 * Vector3(-std::sin(yaw), std::cos(yaw), 0);
  for (int tick = 0; tick < 500; ++tick)
  {
    world.Tick();
    ASSERT_NEAR((world.Position(robot) - middle).norm(), 0.21, 1e-9) << tick;
  }
}

// A robot drives into a wall, a prey and another robot: it meets each with the speed of the free robot, at its outline.
TEST(Dynamics3dFreeRobots, TheyMeetThingsWhereAndAsFastAsSolvedOnesDo)
{
  std::uint32_t into_wall = 0, into_prey = 0, prey = 0, left = 0, right = 0;
  FreeAndSolved worlds(
      [&](Dynamics3dTestWorld& world)
      {
        into_wall = world.AddFootbot({1, 1, 0});
        world.AddWall({2.05, 1, 0.25}, {0.1, 1, 0.5});
        into_prey = world.AddFootbot({1, 4, 0});
        prey = world.AddPrey({2, 4, 0}, 0.5);
        left = world.AddFootbot({1, 7, 0});
        right = world.AddFootbot({2, 7, 0}, kPi);
      });
  for (const auto robot : {into_wall, into_prey, left, right}) worlds.Drive(robot, 0.2, 0.2);
  for (int tick = 0; tick < 60; ++tick)
  {
    worlds.Tick();
    if (tick == 15)
    {
      EXPECT_EQ(worlds.free.engine->FreeRobotCount(), 4U);
    }
    for (const auto robot : {into_wall, into_prey, prey, left, right})
      ASSERT_LT((worlds.free.Position(robot) - worlds.solved.Position(robot)).norm(), 0.005)
          << "e" << robot << ", tick " << tick;
  }
  EXPECT_EQ(worlds.free.engine->FreeRobotCount(), 0U);
  EXPECT_NEAR(worlds.free.Position(into_wall).x(), 2 - 0.085, 1e-3);
  EXPECT_GT(worlds.free.Position(prey).x(), 2.05);
}

// A wall that a robot passes at some millimetres does not hold it, and costs no time in the solver.
TEST(Dynamics3dFreeRobots, WhoPassesCloselyStaysFree)
{
  Dynamics3dTestWorld world;
  const auto robot = world.AddFootbot({1, 1, 0});
  world.AddWall({2, 1 + 0.085036758 + 0.006 + 0.05, 0.25}, {1, 0.1, 0.5});
  const auto other = world.AddFootbot({1, 3, 0});
  world.AddWall({2, 3 + 0.085036758 + 0.001 + 0.05, 0.25}, {1, 0.1, 0.5});
  world.Start();
  for (const auto each : {robot, other}) world.Drive(each, 0.2, 0.2);
  int solved = 0;
  for (int tick = 0; tick < 100; ++tick)
  {
    world.Tick();
    ASSERT_TRUE(IsFree(world, robot)) << tick;
    solved += IsFree(world, other) ? 0 : 1;
  }
  EXPECT_NEAR(solved, 58, 8) << "1.17 m at 0.2 m/s";
  EXPECT_NEAR(world.Position(robot).x(), 3, 0.01);
  EXPECT_NEAR(world.Position(robot).y(), 1, 1e-6);
}

TEST(Dynamics3dFreeRobots, TheStartAndTheEndOfAContactKeepTheSpeed)
{
  Dynamics3dTestWorld world;
  const auto robot = world.AddFootbot({1, 1, 0}, 0.3);
  const auto eyebot = world.AddEyebot({1.9, 1.3, 0.2});
  world.Drive(robot, 0.2, 0.2);
  int changes = 0;
  bool was_free = true;
  for (int tick = 0; tick < 120; ++tick)
  {
    world.Tick();
    const dReal* velocity = VelocityOf(world, robot);
    if (tick > 3)
    {
      ASSERT_NEAR(velocity[0], 0.2 * std::cos(0.3), 1e-3) << tick;
      ASSERT_NEAR(velocity[1], 0.2 * std::sin(0.3), 1e-3) << tick;
    }
    changes += IsFree(world, robot) != was_free ? 1 : 0;
    was_free = IsFree(world, robot);
  }
  EXPECT_EQ(changes, 2) << "it passes below the eyebot, too low to be met and too high to be sure";
  (void)eyebot;
}

TEST(Dynamics3dFreeRobots, NobodyIsFreeOnWhatIsNotLevelGround)
{
  const auto count = [](const std::function<void(Dynamics3dTestWorld&)>& change)
  {
    Dynamics3dTestWorld world;
    world.AddFootbot({5, 5, 0});
    world.AddFootbot({2, 2, 0});
    change(world);
    world.Drive(0, 0.1, 0.1);
    world.Drive(1, 0.1, 0.1);
    world.Run(3);
    return world.engine->FreeRobotCount();
  };
  EXPECT_EQ(count([](Dynamics3dTestWorld&) {}), 2U);
  EXPECT_EQ(count([](Dynamics3dTestWorld& world) { world.Set("orientation", "0, 2, 0"); }), 0U);
  EXPECT_EQ(count([](Dynamics3dTestWorld& world) { world.Set("gravity", "0, 0.1, -9.81"); }), 0U);
  EXPECT_EQ(count([](Dynamics3dTestWorld& world) { world.Set("gravity", "0, 0, 0"); }), 0U);
  EXPECT_EQ(count([](Dynamics3dTestWorld& world) { world.Set("ground", "false"); }), 0U);
  EXPECT_EQ(count([](Dynamics3dTestWorld& world) { world.Set("wheel_friction", "0"); }), 0U);
  EXPECT_EQ(count([](Dynamics3dTestWorld& world) { world.Set("solve_all", "true"); }), 0U);
  EXPECT_EQ(count([](Dynamics3dTestWorld& world) { world.experiment.entities[0].pose.position.z() = 0.5; }), 1U)
      << "one falls";
  EXPECT_EQ(
      count([](Dynamics3dTestWorld& world) { world.experiment.entities[0].pose.position = Vector3(2.172, 2, 0); }), 0U)
      << "they touch";
}

// A body that falls fast far away makes no other body solved. Above the robots it does, since it may hit one.
TEST(Dynamics3dFreeRobots, WhatFallsIsMetBelowIt)
{
  Dynamics3dTestWorld world;
  const auto far = world.AddFootbot({2, 2, 0});
  const auto below = world.AddFootbot({6, 6, 0});
  const auto prey = world.AddPrey({6, 6, 3}, 0.2);
  world.Start();
  bool was_free = true;
  for (int tick = 0; tick < 12; ++tick)
  {
    world.Tick();
    EXPECT_TRUE(IsFree(world, far)) << tick;
    EXPECT_TRUE(was_free || !IsFree(world, below)) << tick;
    was_free = IsFree(world, below);
    EXPECT_TRUE(was_free || tick > 3);
  }
  EXPECT_FALSE(was_free);
  EXPECT_GT(world.Position(prey).z(), 0.1) << "it lies on the robot, or has bounced";
}

// In the solver the robots almost roll, at all lengths of its steps, at rest and on the tightest curve.
TEST(Dynamics3dFreeRobots, WhoWasSolvedBecomesFree)
{
  for (const char* step : {"2.5", "5", "10"})
    for (const double left : {0.0, 0.3, -0.3})
    {
      Dynamics3dTestWorld world("step_ms", step);
      const auto robot = world.AddFootbot({5, 5, 0.06}, 0.3);
      world.Drive(robot, left, left == 0 ? 0 : 0.3);
      world.Tick();
      EXPECT_FALSE(IsFree(world, robot)) << step << " ms";
      world.Run(9);
      EXPECT_TRUE(IsFree(world, robot)) << step << " ms, " << left << " m/s";
    }
}

// A standing robot keeps the bits of its pose, however often it was moved before.
TEST(Dynamics3dFreeRobots, WhoStandsDoesNotCreep)
{
  Dynamics3dTestWorld world;
  const auto robot = world.AddFootbot({2, 2, 0}, 0.3);
  world.Drive(robot, 0.1, 0.23);
  world.Run(50);
  world.Drive(robot, 0, 0);
  world.Run(5);
  const Pose before = world.Space().GetPose(robot);
  world.Run(500);
  const Pose after = world.Space().GetPose(robot);
  EXPECT_EQ(before.position, after.position);
  EXPECT_EQ(before.orientation.coeffs(), after.orientation.coeffs());
}

TEST(Dynamics3dFreeRobots, TheArenasWallsAreMet)
{
  Dynamics3dTestWorld world;
  world.experiment.arena_size = {2, 2, 1};
  world.Set("arena_walls", "true");
  std::vector<std::uint32_t> robots;
  for (int k = 0; k < 4; ++k)
    robots.push_back(
        world.AddFootbot({1 + 0.2 * std::cos(k * kPi / 2), 1 + 0.2 * std::sin(k * kPi / 2), 0}, k * kPi / 2));
  for (const auto robot : robots) world.Drive(robot, 0.2, 0.2);
  world.Space().SetPose(robots[0], {Vector3(-3, 1, 0), Quaternion::Identity()});
  world.engine->EntityMoved(robots[0]);
  world.Run(1);
  EXPECT_FALSE(IsFree(world, robots[0])) << "behind a wall";
  world.Space().SetPose(robots[0], {Vector3(1.2, 1, 0), Quaternion::Identity()});
  world.engine->EntityMoved(robots[0]);
  world.Run(20);
  EXPECT_EQ(world.engine->FreeRobotCount(), 4U);
  world.Run(60);
  EXPECT_EQ(world.engine->FreeRobotCount(), 0U);
  for (int k = 0; k < 4; ++k)
    EXPECT_NEAR((world.Position(robots[static_cast<std::size_t>(k)]) - Vector3(1, 1, 0)).norm(), 1 - 0.085, 2e-3);
}

// A body that is faster than expected is still met: the search for free robots is repeated.
TEST(Dynamics3dFreeRobots, WhoIsPushedFarWithinATickMeetsThoseWhoWereFree)
{
  Dynamics3dTestWorld world("restitution", "1", "friction", "0");
  const auto heavy = world.AddPrey({1, 1, 0}, 20);
  const auto hit = world.AddFootbot({1.19, 1, 0});
  const auto robot = world.AddFootbot({1.41, 1, 0});
  world.Tick();
  EXPECT_TRUE(IsFree(world, robot));
  OdeWorld& ode = world.engine->WorldForTest();
  dBodySetLinearVel(ode.Body(world.engine->ModelForTest(heavy)->MainBody()), 0.9, 0, 0);
  world.Tick();
  // The prey hits the one, which goes nearly twice as fast and meets the other within the tick.
  EXPECT_FALSE(IsFree(world, robot));
  EXPECT_GT(world.Position(robot).x() - world.Position(hit).x(), 0.17 - 0.01);
}

// A swarm that drives, meets walls and other robots, pushes, grips and parts.
class Crowd : public Dynamics3dTestWorld
{
public:
  explicit Crowd(std::vector<std::size_t> order = {})
  {
    Set("arena_walls", "true");
    experiment.arena_size = {4, 4, 2};
    if (order.empty())
      for (std::size_t k = 0; k < kRobots; ++k) order.push_back(k);
    robots_.resize(kRobots);
    for (const std::size_t k : order)
    {
      const auto place = static_cast<double>(k);
      robots_[k] =
          AddFootbot({0.5 + 0.6 * static_cast<double>(k % 6), 0.5 + 0.6 * static_cast<double>(k / 6), 0}, 0.7 * place);
    }
    for (int k = 0; k < 4; ++k) AddPrey({0.8 + 0.6 * k, 1.4, 0}, 0.5, 0.08);
    for (int k = 0; k < 3; ++k) AddBlock({0.8 + 0.6 * k, 2, 0.15}, {0.04, 0.04, 0.3}, 0.2);
    AddWall({2, 3, 0.2}, {1, 0.1, 0.4}, 0.5);
    mirror_ = AddFootbot({0.2, 3.8, 0});
    MakeMirror(mirror_);
    Start();
  }
  void Advance()
  {
    const auto tick = static_cast<std::uint32_t>(Space().GetTick());
    for (std::size_t k = 0; k < kRobots; ++k)
    {
      RandomStream random(seed, k, 0, tick / 12);
      Drive(robots_[k], random.Uniform(-0.1, 0.3), random.Uniform(-0.1, 0.3));
      Command("footbot_gripper", robots_[k], {random.Uniform() < 0.1 ? 1.0 : 0.0});
    }
    const double along = 0.01 * tick;
    Space().SetPose(mirror_, {Vector3(0.3 + along, 3.8 - along, 0), QuaternionFromYaw(along)});
    Tick();
  }
  std::uint32_t Robot(std::size_t k) const { return robots_[k]; }
  Vector3 PlaceOf(std::size_t k) { return Position(robots_[k]); }

  static constexpr std::size_t kRobots = 24;
  std::uint64_t seed = 3;

private:
  std::vector<std::uint32_t> robots_;
  std::uint32_t mirror_ = 0;
};

TEST(Dynamics3dFreeRobots, ARestoredRunHasTheSameBits)
{
  std::vector<std::size_t> counts;
  for (std::uint64_t seed = 3; seed < 11; ++seed)
  {
    Crowd continuing, restored;
    continuing.seed = restored.seed = seed;
    for (int tick = 0; tick < 150; ++tick)
    {
      if (tick % 7 == 0) restored.ReplaceEngineBySavedState();
      continuing.Advance();
      restored.Advance();
      ASSERT_EQ(continuing.Space().Hash(), restored.Space().Hash()) << "seed " << seed << ", tick " << tick;
      for (std::size_t k = 0; k < Crowd::kRobots; ++k)
        ASSERT_EQ(continuing.Sensor("footbot_accelerometer", continuing.Robot(k), 0),
                  restored.Sensor("footbot_accelerometer", restored.Robot(k), 0));
      const std::size_t count = continuing.engine->FreeRobotCount();
      ASSERT_EQ(count, restored.engine->FreeRobotCount());
      if (std::ranges::find(counts, count) == counts.end()) counts.push_back(count);
    }
  }
  EXPECT_GT(counts.size(), 5U) << "robots become free and cease to be";
}

// Compared with all pairs: robots far from all others are free, touching robots are not, and none passes through
// another.
TEST(Dynamics3dFreeRobots, WhoIsFreeIsWhoTouchesNobody)
{
  Crowd world;
  int free = 0, solved = 0;
  for (int tick = 0; tick < 200; ++tick)
  {
    world.Advance();
    for (std::size_t a = 0; a < Crowd::kRobots; ++a)
    {
      double gap = 1e9;
      for (std::size_t b = 0; b < Crowd::kRobots; ++b)
        if (a != b) gap = std::min(gap, (world.PlaceOf(a) - world.PlaceOf(b)).norm() - 2 * 0.085036758);
      ASSERT_GT(gap, -3e-3) << "tick " << tick;
      // The positions are those after the last step, so pairs that have just parted or will just meet are not tested.
      if (gap < 0)
      {
        ASSERT_FALSE(IsFree(world, world.Robot(a))) << "tick " << tick << ", robot " << a;
      }
      free += IsFree(world, world.Robot(a)) ? 1 : 0;
      solved += IsFree(world, world.Robot(a)) ? 0 : 1;
    }
  }
  EXPECT_GT(free, 1000);
  EXPECT_GT(solved, 500);
}

TEST(Dynamics3dFreeRobots, TheOrderOfTheFileDoesNotMatterToThem)
{
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < Crowd::kRobots; ++k) order.push_back((7 * k + 3) % Crowd::kRobots);
  Crowd one, other(order);
  for (int tick = 0; tick < 5; ++tick)
  {
    one.Advance();
    other.Advance();
    for (std::size_t k = 0; k < Crowd::kRobots; ++k)
    {
      ASSERT_EQ(IsFree(one, one.Robot(k)), IsFree(other, other.Robot(k))) << tick;
      if (IsFree(one, one.Robot(k)))
      {
        ASSERT_EQ((one.PlaceOf(k) - other.PlaceOf(k)).norm(), 0) << tick;
      }
    }
  }
}

}  // namespace
}  // namespace swarmanoid

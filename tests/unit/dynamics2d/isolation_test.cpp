// Bodies that meet no other body within a tick are left out of the solver. The tests check which ones, and that it
// makes no difference.
#include <algorithm>
#include <cmath>
#include <functional>

#include "common/math/random.h"
#include "dynamics2d_test_world.h"

namespace swarmanoid
{
namespace
{

// Two worlds that differ in one distant body, which is so fast that the solver moves all bodies.
class Pair
{
public:
  explicit Pair(const std::function<void(Dynamics2dTestWorld&)>& add)
  {
    for (const bool fast : {false, true})
    {
      Dynamics2dTestWorld& world = fast ? solved : isolated;
      world.Set("ground_friction", "0.3");
      add(world);
      const auto far_away = world.AddPrey(-80, 80, 1);
      world.UseTurrets();
      world.Start();
      keep_fast_ = [this, far_away] { solved.engine->SetVelocity(far_away, {0, 3, 0}); };
    }
  }
  void Tick()
  {
    keep_fast_();
    isolated.Tick();
    solved.Tick();
  }

  Dynamics2dTestWorld isolated, solved;

private:
  std::function<void()> keep_fast_;
};

TEST(Dynamics2d, AnIsolatedRobotAndItsTurretMoveAsTheSolverWouldMoveThem)
{
  std::uint32_t robot = 0;
  Pair worlds([&](Dynamics2dTestWorld& world) { robot = world.AddFootbot(2, 2, 0.4); });
  RandomStream random(9, 0, 0, 0);
  for (int tick = 0; tick < 400; ++tick)
  {
    // Also harder than its wheels can follow within a tick.
    if (tick % 10 == 0)
    {
      const double left = random.Uniform(-0.8, 0.8);
      const double right = random.Uniform(-0.8, 0.8);
      for (Dynamics2dTestWorld* world : {&worlds.isolated, &worlds.solved})
      {
        world->Drive(robot, left, right);
        world->Command("footbot_turret", robot, {left});
      }
    }
    worlds.Tick();
    ASSERT_NE(worlds.isolated.engine->StatusText().find(", 2 of 2 bodies isolated"), std::string::npos);
    ASSERT_NE(worlds.solved.engine->StatusText().find(", 0 of 2 bodies isolated"), std::string::npos);
    EXPECT_LT((worlds.isolated.Position(robot) - worlds.solved.Position(robot)).norm(), 1e-9) << tick;
    EXPECT_NEAR(WrapAngle(worlds.isolated.Yaw(robot) - worlds.solved.Yaw(robot)), 0, 1e-9) << tick;
    EXPECT_EQ(worlds.isolated.Attribute(robot, "turret_angle"), worlds.solved.Attribute(robot, "turret_angle")) << tick;
    for (int i = 0; i < 2; ++i)
      EXPECT_NEAR(worlds.isolated.Sensor("footbot_encoders", robot, i),
                  worlds.solved.Sensor("footbot_encoders", robot, i), 1e-9);
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(worlds.isolated.Sensor("footbot_accelerometer", robot, i),
                  worlds.solved.Sensor("footbot_accelerometer", robot, i), 1e-7);
  }
}

TEST(Dynamics2d, AnIsolatedPreySlidesAndSpinsAsTheSolverWouldHaveIt)
{
  std::uint32_t prey = 0;
  Pair worlds([&](Dynamics2dTestWorld& world) { prey = world.AddPrey(2, 2, 1.5); });
  for (Dynamics2dTestWorld* world : {&worlds.isolated, &worlds.solved})
    world->engine->SetVelocity(prey, {0.8, -0.3, 6});
  for (int tick = 0; tick < 30; ++tick)
  {
    worlds.Tick();
    EXPECT_LT((worlds.isolated.Position(prey) - worlds.solved.Position(prey)).norm(), 1e-9) << tick;
    EXPECT_NEAR(WrapAngle(worlds.isolated.Yaw(prey) - worlds.solved.Yaw(prey)), 0, 1e-9) << tick;
  }
  EXPECT_GT((worlds.isolated.Position(prey) - Vector3(2, 2, 0)).norm(), 0.1);
}

// The prey is out of reach of any single body within the tick, but a body that was hit reaches it.
TEST(Dynamics2d, WhoIsPushedFarWithinATickMeetsThoseWhoWereIsolated)
{
  Dynamics2dTestWorld world("restitution", "1", "ground_friction", "0");
  const auto heavy = world.AddPrey(1, 1, 50);
  const auto light = world.AddPrey(1.205, 1, 0.1);
  const auto third = world.AddPrey(1.46, 1, 0.1);
  world.Start();
  world.engine->SetVelocity(heavy, {0.9, 0, 0});
  world.Tick();
  // The first hits the second, which goes twice as fast and meets the third within the tick.
  EXPECT_GT(world.Position(third).x() - world.Position(light).x(), 0.2 - 0.05);
  world.Run(2);
  EXPECT_GT(world.Position(third).x(), 1.5);
  EXPECT_GT(world.Position(third).x() - world.Position(light).x(), 0.2 - 2e-3);
}

TEST(Dynamics2d, AnIsolatedRobotGripsWhatIsPutBeforeIt)
{
  Dynamics2dTestWorld world;
  const auto robot = world.AddFootbot(2, 2);
  const auto prey = world.AddPrey(5, 5, 1);
  world.Command("footbot_gripper", robot, {1});
  world.Run(3);
  EXPECT_EQ(world.Attribute(robot, "gripped"), 0);
  world.Space().SetPose(prey, {Vector3(2.202, 2, 0), Quaternion::Identity()});
  world.engine->EntityMoved(prey);
  world.Tick();
  EXPECT_EQ(world.Attribute(robot, "gripped"), 1.0 + prey);
}

// Robots that become isolated and meet again, among walls and a mirror: a restored world has the same bits.
TEST(Dynamics2d, ARestoredEngineContinuesWithTheSameBitsWithIsolatedBodies)
{
  const auto make = [](Dynamics2dTestWorld& world, std::uint32_t& mirror)
  {
    for (int i = 0; i < 25; ++i) world.AddFootbot(1 + 0.6 * (i % 5), 1 + 0.6 * (i / 5), 0.7 * i);
    for (int i = 0; i < 4; ++i) world.AddPrey(1.3 + 0.6 * i, 1.3, 0.5, 0.08);
    mirror = world.AddFootbot(0.5, 0.5);
    world.MakeMirror(mirror);
    world.AddWall({4, 2, 0.2}, {0.1, 4, 0.4}, 0.1);
    world.AddWall({0.5, 2, 0.2}, {0.1, 4, 0.4}, -0.1);
    world.Start();
  };
  const auto step = [](Dynamics2dTestWorld& world, std::uint32_t mirror)
  {
    const std::uint64_t tick = world.Space().GetTick();
    for (std::uint32_t robot = 0; robot < 25; ++robot)
    {
      RandomStream random(3, robot, 0, static_cast<std::uint32_t>(tick / 15));
      world.Drive(robot, random.Uniform(-0.1, 0.3), random.Uniform(-0.1, 0.3));
    }
    const double along = 0.01 * static_cast<double>(tick);
    world.Space().SetPose(mirror, {Vector3(0.8 + along, 0.8 + along, 0), QuaternionFromYaw(along)});
    world.Tick();
  };
  Dynamics2dTestWorld continuing, restored;
  std::uint32_t mirror = 0;
  make(continuing, mirror);
  make(restored, mirror);
  std::vector<std::string> seen;
  for (int tick = 0; tick < 150; ++tick)
  {
    if (tick % 25 == 0)
    {
      continuing.engine->Canonicalise();
      restored.Space().SetTick(continuing.Space().GetTick());
      for (std::uint32_t i = 0; i < continuing.Space().Size(); ++i)
        restored.Space().SetPose(i, continuing.Space().GetPose(i));
      ByteWriter state;
      continuing.engine->SaveState(state);
      restored.engine = restored.MakeEngine();
      ByteReader reader(state.Bytes());
      restored.engine->LoadState(reader);
    }
    step(continuing, mirror);
    step(restored, mirror);
    ASSERT_EQ(continuing.Space().Hash(), restored.Space().Hash()) << tick;
    const std::string text = continuing.engine->StatusText();
    if (std::ranges::find(seen, text) == seen.end()) seen.push_back(text);
  }
  EXPECT_GT(seen.size(), 10U) << "bodies change sides";
}

}  // namespace
}  // namespace swarmanoid

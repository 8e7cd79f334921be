// Walls, planes, mirrors and what the engine refuses.
#include <gmock/gmock.h>

#include <cmath>

#include <filesystem>

#include "common/math/random.h"
#include "common/space/terrain/terrain.h"
#include "dynamics2d_test_world.h"
#include "engine_worker/engines/terrain_walls.h"
#include "tests/world/message_of.h"
#include "tests/world/small_experiment.h"

namespace swarmanoid
{
namespace
{

TEST(Dynamics2d, FastRobotsDoNotCrossAThinWall)
{
  Dynamics2dTestWorld world;
  const auto robot = world.AddFootbot(1, 1);
  world.AddWall({2, 1, 0.1}, {0.01, 4, 0.2});
  world.Drive(robot, 3, 3);
  for (int i = 0; i < 30; ++i)
  {
    world.Tick();
    ASSERT_LT(world.Position(robot).x(), 2 - 0.085 + 0.002) << i;
  }
}

TEST(Dynamics2d, AStaticBlockBlocksWhereItIsCutHoweverFarItsCentre)
{
  Dynamics2dTestWorld world;
  const auto robot = world.AddFootbot(1, 1);
  world.AddWall({30, 1, 45}, {57, 1, 100});   // reaches from x = 1.5 and from below the ground to 95 m
  world.AddWall({1.3, 1, 45}, {0.1, 1, 89});  // starts half a metre above the ground
  world.Drive(robot, 0.3, 0.3);
  world.Run(50);
  EXPECT_NEAR(world.Position(robot).x(), 1.5 - 0.1, 2e-3) << "its gripper touches the near face";
}

TEST(Dynamics2d, RobotsWorkOnAllThreePlanes)
{
  const std::map<std::string, std::pair<Vector3, Vector3>> starts_and_directions{
      {"x", {{0.5, 1, 1}, Vector3::UnitY()}},
      {"y", {{1, 0.5, 1}, Vector3::UnitZ()}},
      {"z", {{1, 1, 0.5}, Vector3::UnitX()}}};
  for (const auto& [axis, start] : starts_and_directions)
  {
    Dynamics2dTestWorld world("perpendicular_axis", axis, "distance", "0.5");
    const auto robot = world.EngineTestWorld::AddFootbot(start.first);
    const Vector3 obstacle = start.first + start.second;
    world.AddWall(obstacle, {0.2, 0.2, 0.2});
    world.Start();
    // On the plane, forward is its first axis at heading 0.
    world.Space().SetPose(robot, PlaneFrame(axis == "x"   ? PlaneAxis::kX
                                            : axis == "y" ? PlaneAxis::kY
                                                          : PlaneAxis::kZ,
                                            0.5)
                                     .ToSpace({axis == "y" ? 1.0 : 1.0, 1, 0}));
    world.engine->EntityMoved(robot);
    world.Drive(robot, 0.2, 0.2);
    world.Run(10);
    EXPECT_LT((world.Position(robot) - start.first - 0.2 * start.second).norm(), 6e-3) << axis;
    world.Run(60);
    EXPECT_LT((world.Position(robot) - start.first - 0.8 * start.second).norm(), 2e-3)
        << axis << ": the block stops it";
  }
}

// By the gripper in front, or by the round body behind which the turret holds it.
TEST(Dynamics2d, AMirrorPushesAndIsNotPushed)
{
  for (const double turret : {0.0, kPi})
  {
    Dynamics2dTestWorld world;
    const auto mirror = world.AddFootbot(1, 1);
    const auto prey = world.AddPrey(1.4, 1, 1);
    world.MakeMirror(mirror);
    world.Space().SetAttribute(world.Space().GetEntity(mirror).SlotOf("turret_angle"), turret);
    for (int i = 0; i < 50; ++i)
    {
      world.Space().SetPose(mirror, {Vector3(1 + 0.02 * i, 1, 0), Quaternion::Identity()});
      world.Tick();
      ASSERT_DOUBLE_EQ(world.Position(mirror).x(), 1 + 0.02 * i);
    }
    EXPECT_NEAR(world.Position(prey).x(), 2 + (turret == 0 ? 0.1 : 0.085) + 0.1, 5e-3) << turret;
  }
}

// It is put beside a prey, from far away: it did not come there through the prey.
TEST(Dynamics2d, AMirrorThatIsPutElsewhereSweepsNobodyAway)
{
  Dynamics2dTestWorld world;
  const auto mirror = world.AddFootbot(1, 1);
  const auto prey = world.AddPrey(3.4, 1, 1);
  world.MakeMirror(mirror);
  world.Run(3);
  world.Space().SetPose(mirror, {Vector3(3.2, 1, 0), Quaternion::Identity()});
  world.Run(3);
  EXPECT_LT((world.Position(prey) - Vector3(3.4, 1, 0)).norm(), 1e-3);
}

TEST(Dynamics2d, AMirrorAboveThePlaneTouchesNothing)
{
  Dynamics2dTestWorld world;
  const auto mirror = world.AddEyebot({1, 1, 1});
  const auto prey = world.AddPrey(1.4, 1, 1);
  world.MakeMirror(mirror);
  world.Start();
  for (int i = 0; i < 20; ++i)
  {
    world.Space().SetPose(mirror, {Vector3(1 + 0.02 * i, 1, 1), Quaternion::Identity()});
    world.Tick();
  }
  EXPECT_NEAR(world.Position(prey).x(), 1.4, 1e-6);
}

TEST(Dynamics2d, AnEntityThatIsMovedFromOutsideStartsAtRestThere)
{
  Dynamics2dTestWorld world;
  const auto prey = world.AddPrey(1, 1, 1);
  world.Start();
  world.engine->SetVelocity(prey, {2, 0, 0});
  world.Run(1);
  world.Space().SetPose(prey, {Vector3(5, 6, 0), QuaternionFromYaw(1)});
  world.engine->EntityMoved(prey);
  world.Run(5);
  EXPECT_LT((world.Position(prey) - Vector3(5, 6, 0)).norm(), 1e-6);
  EXPECT_NEAR(world.Yaw(prey), 1, 1e-6);
}

TEST(Dynamics2d, BodiesBelowTheSolversToleranceAreRefusedByName)
{
  Dynamics2dTestWorld world;
  world.AddPrey(1, 1, 1, 0.0005);
  EXPECT_THAT(test::MessageOf<ConfigurationError>([&] { world.Start(); }), testing::HasSubstr("'e0'"));
}

TEST(Dynamics2d, ACommandThatIsNotANumberNamesTheRobot)
{
  Dynamics2dTestWorld world;
  const auto robot = world.AddFootbot(1, 1);
  world.Drive(robot, std::nan(""), 0);
  EXPECT_THROW(world.Tick(), std::runtime_error);
}

TEST(Dynamics2d, RobotsStayOnATiltedPlane)
{
  Dynamics2dTestWorld world("tilt", "0, 30, 0");
  const auto robot = world.AddFootbot(0, 0);
  world.Drive(robot, 0.1, 0.1);
  world.Run(20);
  const Vector3 downhill(std::cos(kPi / 6), 0, -std::sin(kPi / 6));
  EXPECT_LT((world.Position(robot) - 0.2 * downhill).norm(), 2e-3);
  EXPECT_LT((world.Space().GetEntity(robot).GetOrientation() * Vector3::UnitX() - downhill).norm(), 1e-6);
}

TEST(Dynamics2d, FrictionOfAnEntityGoesBeforeThatOfTheEngine)
{
  Dynamics2dTestWorld world;
  const auto slippery = world.AddPrey(1, 1, 1);
  const auto rough = world.AddPrey(1, 3, 1);
  world.experiment.entities[slippery].tree = test::TreeOf({{"ground_friction", "0.01"}});
  world.Start();
  world.engine->SetVelocity(slippery, {1, 0, 0});
  world.engine->SetVelocity(rough, {1, 0, 0});
  world.Run(10);
  EXPECT_NEAR(world.Position(slippery).x() - 1, 1 - 0.5 * 0.01 * 9.81, 3e-3);
  EXPECT_LT(world.Position(rough).x() - 1, 0.12);
}

// Sixty robots wander through a real corridor, in which the voxels at the height of the plane are walls.
TEST(Dynamics2d, TerrainIsWallsAtTheHeightOfThePlane)
{
  const std::string map = "/usr/share/doc/liboctomap-dev/examples/data/geb079.bt";
  if (!std::filesystem::exists(map)) GTEST_SKIP() << map << " is not installed";
  const VoxelTerrain terrain(map);
  const double level = terrain.Low().z() + 1;
  const auto blocked = [&](double x, double y, double margin)
  {
    for (int i = 0; i < 16; ++i)
      if (terrain.IsSolid({x + margin * Cos(i * kPi / 8), y + margin * Sin(i * kPi / 8), level + kTerrainStep_m}))
        return true;
    return false;
  };

  Dynamics2dTestWorld world("distance", std::to_string(level));
  world.AddTerrain("octomap", {{"file", map}}, Vector3::Zero());
  RandomStream random(5, 0, 0, 0);
  std::vector<std::uint32_t> robots;
  while (robots.size() < 60)
  {
    const double x = random.Uniform(terrain.Low().x(), terrain.High().x());
    const double y = random.Uniform(terrain.Low().y(), terrain.High().y());
    if (!blocked(x, y, 0.2) && !blocked(x, y, 0.1)) robots.push_back(world.AddFootbot(x, y, random.Uniform(-3, 3)));
  }
  world.Start();
  int at_walls = 0;
  for (int tick = 0; tick < 100; ++tick)
  {
    for (const auto robot : robots) world.Drive(robot, 0.3, tick % 30 < 20 ? 0.3 : 0.1);
    world.Tick();
    for (const auto robot : robots)
    {
      const Vector3 position = world.Position(robot);
      ASSERT_FALSE(blocked(position.x(), position.y(), 0.07)) << "a robot is in a wall at " << position.transpose();
      at_walls += blocked(position.x(), position.y(), 0.095) ? 1 : 0;
    }
  }
  EXPECT_GT(at_walls, 0) << "some reach a wall";
}

// A pile of robots drives against each other. No overlap lasts, and no robot is thrown away.
TEST(Dynamics2d, ACrowdStaysApart)
{
  Dynamics2dTestWorld world;
  std::vector<std::uint32_t> robots;
  for (int i = 0; i < 64; ++i)
  {
    const double x = 1 + 0.25 * (i % 8);
    const double y = 1 + 0.25 * (i / 8);
    robots.push_back(world.AddFootbot(x, y, Atan2(2 - y, 2 - x)));
  }
  for (const auto robot : robots) world.Drive(robot, 0.3, 0.3);
  world.Run(100);
  for (const auto a : robots)
  {
    EXPECT_LT((world.Position(a) - Vector3(2, 2, 0)).norm(), 1.7);
    for (const auto b : robots)
    {
      if (b <= a) continue;
      EXPECT_GT((world.Position(a) - world.Position(b)).norm(), 2 * 0.085 - 0.003);
    }
  }
}

}  // namespace
}  // namespace swarmanoid

// Walls, mirrors, the engine's frame, and long runs.
#include <cmath>

#include "common/math/random.h"
#include "dynamics3d_test_world.h"

namespace swarmanoid
{
namespace
{

TEST(Dynamics3dWalls, AStaticBlockWhoseCentreIsFarOutsideStillBlocks)
{
  Dynamics3dTestWorld world;
  const auto footbot = world.AddFootbot({4, 5, 0});
  world.AddWall({105, 5, 0.25}, {200, 1, 0.5});  // from x = 5 on
  world.Drive(footbot, 0.2, 0.2);
  world.Run(100);
  EXPECT_NEAR(world.Position(footbot).x(), 5 - 0.085, 0.01);
}

TEST(Dynamics3dWalls, RobotsStayWithinTheWallsOfTheArena)
{
  Dynamics3dTestWorld world;
  world.experiment.arena_size = {1, 1, 1};
  world.Set("arena_walls", "true");
  std::vector<std::uint32_t> footbots;
  for (int k = 0; k < 4; ++k) footbots.push_back(world.AddFootbot({0.5, 0.5 + 0.2 * (k - 2), 0}, 1.5 * k));
  for (const auto footbot : footbots) world.Drive(footbot, 0.3, 0.29);
  world.Run(200);
  for (const auto footbot : footbots)
  {
    const Vector3 p = world.Position(footbot);
    for (const int axis : {0, 1})
    {
      EXPECT_GT(p[axis], 0.08);
      EXPECT_LT(p[axis], 0.92);
    }
    EXPECT_NEAR(p.z(), 0, 0.01);
  }
}

TEST(Dynamics3dWalls, RobotsThatMeetHeadOnStandUprightAndApart)
{
  Dynamics3dTestWorld world;
  const auto left = world.AddFootbot({4.5, 5, 0}, 0);
  const auto right = world.AddFootbot({5.5, 5.01, 0}, kPi);
  world.Drive(left, 0.3, 0.3);
  world.Drive(right, 0.3, 0.3);
  for (int tick = 0; tick < 100; ++tick)
  {
    world.Tick();
    ASSERT_LT(world.Tilt(left), DegreesToRadians(5));
    ASSERT_GT((world.Position(left) - world.Position(right)).norm(), 2 * 0.085 - 0.003);
  }
}

TEST(Dynamics3dMirrors, AMirrorPushesAndIsNotPushed)
{
  Dynamics3dTestWorld world;
  const auto block = world.AddBlock({5.2, 5, 0.1}, {0.2, 0.2, 0.2}, 1);
  const auto mirror = world.AddFootbot({4.9, 5, 0});
  world.MakeMirror(mirror);
  world.Start();
  for (int tick = 0; tick < 50; ++tick)
  {
    world.Tick();
    world.Space().SetPose(mirror, {Vector3(4.9 + 0.01 * (tick + 1), 5, 0), Quaternion::Identity()});
  }
  // The mirror's front is at 5.4 + 0.085 less a tick.
  EXPECT_NEAR(world.Position(block).x(), 5.4 + 0.085 + 0.1, 0.02);
  EXPECT_NEAR(world.Position(block).y(), 5, 0.02);
}

TEST(Dynamics3dFrame, AnEngineElsewhereInTheSpaceDoesTheSame)
{
  const auto run = [](const char* position, const char* orientation, const Pose& frame)
  {
    Dynamics3dTestWorld world("position", position, "orientation", orientation);
    // Gravity is along the frame's -z.
    const Vector3 down = frame.orientation * Vector3(0, 0, -9.81);
    world.Set("gravity", fmt::format("{}, {}, {}", down.x(), down.y(), down.z()));
    const Pose footbot_at = frame.Compose({Vector3(1, 1, 0), QuaternionFromYaw(0.4)});
    const auto footbot = world.Add(EntityKind::kFootbot, footbot_at.position, footbot_at.orientation,
                                   {0.085036758, 0.085036758, 0.146899733});
    const Pose block_at = frame.Compose({Vector3(1.3, 1.15, 0.05), Quaternion::Identity()});
    const auto block =
        world.Add(EntityKind::kBlock, block_at.position, block_at.orientation, {0.1, 0.1, 0.1}, 0.3, true);
    world.Drive(footbot, 0.15, 0.15);
    world.Run(30);
    return std::pair(frame.Inverse().Compose(world.Space().GetPose(footbot)),
                     frame.Inverse().Compose(world.Space().GetPose(block)));
  };
  const auto [footbot, block] = run("0, 0, 0", "0, 0, 0", Pose());
  const Pose tilted{Vector3(3, -2, 1),
                    QuaternionFromEuler({DegreesToRadians(30), DegreesToRadians(-20), DegreesToRadians(70)})};
  const auto [other_footbot, other_block] = run("3, -2, 1", "30, -20, 70", tilted);
  EXPECT_GT(block.position.x(), 1.35) << "the robot was to push the block";
  EXPECT_LT((footbot.position - other_footbot.position).norm(), 5e-3);
  EXPECT_LT((block.position - other_block.position).norm(), 6e-3);
}

TEST(Dynamics3dSpeed, FlatOutFootbotsNeitherLeaveTheGroundNorTunnelThroughWalls)
{
  Dynamics3dTestWorld world;
  const auto footbot = world.AddFootbot({4, 5, 0});
  world.AddWall({5, 5, 0.25}, {0.02, 2, 0.5});
  world.Drive(footbot, 3, 3);  // ten times the robot's own speed
  for (int tick = 0; tick < 50; ++tick)
  {
    world.Tick();
    ASSERT_LT(world.Position(footbot).x(), 5);
    ASSERT_LT(world.Position(footbot).z(), 0.2);
  }
}

TEST(Dynamics3dStability, AHeapComesToRestAndStaysThereFor100000Steps)
{
  Dynamics3dTestWorld world;
  std::vector<std::uint32_t> things;
  for (int k = 0; k < 4; ++k) things.push_back(world.AddBlock({5 + 0.01 * k, 5, 0.1 + 0.11 * k}, {0.2, 0.2, 0.1}, 1));
  things.push_back(world.AddPrey({5.5, 5, 0}, 0.5));
  things.push_back(world.AddFootbot({5, 5.4, 0}));
  things.push_back(world.AddHandbot({4, 5, 0}));
  world.Run(50);
  std::vector<Vector3> before;
  for (const auto thing : things) before.push_back(world.Position(thing));
  world.Run(450);
  for (std::size_t k = 0; k < things.size(); ++k)
    EXPECT_LT((world.Position(things[k]) - before[k]).norm(), 0.015) << "entity " << k;
  // Only the creep of docs/engines.md remains, 0.2 mm/s.
  world.Run(4500);
  for (std::size_t k = 0; k < things.size(); ++k)
  {
    const Vector3 way = world.Position(things[k]) - before[k];
    EXPECT_LT(way.norm(), 0.0002 * 495) << "entity " << k;
    EXPECT_LT(std::abs(way.z()), 0.002) << "entity " << k;
  }
}

TEST(Dynamics3dErrors, CommandsThatAreNoNumbersAreNamed)
{
  Dynamics3dTestWorld world;
  const auto footbot = world.AddFootbot({5, 5, 0});
  world.Command("footbot_wheels", footbot, {std::nan(""), 0});
  EXPECT_THROW(world.Tick(), std::runtime_error);
}

}  // namespace
}  // namespace swarmanoid

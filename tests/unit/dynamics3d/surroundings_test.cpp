// Walls, terrain, holes, mirrors, the engine's frame, and long runs.
#include <octomap/octomap.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>

#include "common/math/random.h"
#include "dynamics3d_test_world.h"
#include "engine_worker/engines/dynamics3d/terrain_shape.h"
#include "engine_worker/engines/dynamics3d/voxel_contacts.h"

namespace swarmanoid
{
namespace
{

// A real corridor, part of Debian's liboctomap-dev.
constexpr const char* kBuilding = "/usr/share/doc/liboctomap-dev/examples/data/geb079.bt";

// An OctoMap file that lives as long as the test.
class MapFile
{
public:
  explicit MapFile(octomap::OcTree& tree)
      : path_(std::filesystem::temp_directory_path() / (std::to_string(getpid()) + "dynamics3d_test.bt"))
  {
    tree.updateInnerOccupancy();
    tree.writeBinary(path_.string());
  }
  ~MapFile() { std::filesystem::remove(path_); }
  std::string Path() const { return path_.string(); }

private:
  std::filesystem::path path_;
};

// A floor of 4 m by 2 m whose surface is at z = 0, cells of 5 cm.
octomap::OcTree FloorTree()
{
  octomap::OcTree tree(0.05);
  for (int x = 0; x < 80; ++x)
    for (int y = 0; y < 40; ++y)
      tree.updateNode(
          octomap::point3d(0.025F + 0.05F * static_cast<float>(x), 0.025F + 0.05F * static_cast<float>(y), -0.025F),
          true, true);
  return tree;
}

TEST(Dynamics3dWalls, AStaticBlockWhoseCentreIsFarOutsideStillBlocks)
{
  Dynamics3dTestWorld world;
  const auto footbot = world.AddFootbot({4, 5, 0});
  world.AddWall({105, 5, 0.25}, {200, 1, 0.5});  // from x = 5 on
  world.AddCommands("footbot_wheels", 2);
  world.Start();
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
  world.AddCommands("footbot_wheels", 2);
  world.Start();
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
  world.AddCommands("footbot_wheels", 2);
  world.Start();
  world.Drive(left, 0.3, 0.3);
  world.Drive(right, 0.3, 0.3);
  for (int tick = 0; tick < 100; ++tick)
  {
    world.Tick();
    ASSERT_LT(world.Tilt(left), DegreesToRadians(5));
    ASSERT_GT((world.Position(left) - world.Position(right)).norm(), 2 * 0.085 - 0.003);
  }
}

TEST(Dynamics3dTerrain, AWheelRollsOverAHeightfieldAtTheSpeedOfTheWheels)
{
  // Hills of 1.5 cm, 1 m long: put in as a terrain in memory.
  std::vector<double> heights;
  for (int row = 0; row < 41; ++row)
    for (int column = 0; column < 81; ++column) heights.push_back(0.015 * Sin(2 * kPi * column * 0.05));
  const auto hills = std::make_shared<const HeightTerrain>(heights, 81, 41, 4.0, 2.0);
  Dynamics3dTestWorld world;
  world.Set("ground", "false");
  const auto footbot = world.AddFootbot({1, 1, 0.001});
  world.AddCommands("footbot_wheels", 2);
  world.Start();
  std::unique_ptr<dynamics3d::TerrainShape> shape = AddHeightfield(world.engine->World(), 0xfffffff0U, hills, Pose());
  world.Drive(footbot, 0.1, 0.1);
  for (int tick = 0; tick < 150; ++tick)
  {
    world.Tick();
    const Vector3 p = world.Position(footbot);
    ASSERT_NEAR(p.z(), 0.015 * Sin(2 * kPi * p.x()), 0.006) << "at x = " << p.x();
  }
  EXPECT_NEAR(world.Position(footbot).x(), 2.5, 0.05);
  EXPECT_NEAR(world.Position(footbot).y(), 1, 0.05);
  world.engine.reset();
}

TEST(Dynamics3dTerrain, AHeightfieldStandsWhereItsTerrainSays)
{
  // A ramp that rises along y: heights must not be mirrored.
  std::vector<double> heights;
  for (int row = 0; row < 21; ++row)
    for (int column = 0; column < 11; ++column) heights.push_back(0.1 * row * 0.1 + 0.02 * column * 0.1);
  const auto ramp = std::make_shared<const HeightTerrain>(heights, 11, 21, 1.0, 2.0);
  Dynamics3dTestWorld world;
  world.Set("ground", "false");
  world.AddFootbot({0, 0, 0});
  world.Start();
  const Pose pose{Vector3(3, 4, 0.5), Quaternion::Identity()};
  auto shape = AddHeightfield(world.engine->World(), 0xfffffff0U, ramp, pose);
  RandomStream random(1, 0, 0, 0);
  for (int k = 0; k < 200; ++k)
  {
    const double x = random.Uniform(0.05, 0.95);
    const double y = random.Uniform(0.05, 1.95);
    const double distance = world.engine->World().DistanceToStatic(pose.Apply({x, y, 1}), -Vector3::UnitZ(), 5);
    EXPECT_NEAR(1 - distance, 0.1 * y + 0.02 * x, 1e-9);
  }
  world.engine.reset();
}

TEST(Dynamics3dTerrain, AFootbotDrivesOverAFloorOfVoxelsAsOverAPlane)
{
  octomap::OcTree tree = FloorTree();
  const MapFile file(tree);
  Dynamics3dTestWorld world;
  world.Set("ground", "false");
  const auto footbot = world.AddFootbot({0.5, 1, 0});
  world.AddTerrain("octomap", {{"file", file.Path()}}, Vector3::Zero());
  world.AddCommands("footbot_wheels", 2);
  world.Start();
  world.Drive(footbot, 0.1, 0.1);
  for (int tick = 0; tick < 200; ++tick)
  {
    world.Tick();
    ASSERT_NEAR(world.Position(footbot).z(), 0, 1.5e-3);
  }
  EXPECT_NEAR(world.Position(footbot).x(), 2.5, 0.04);
  EXPECT_NEAR(world.Position(footbot).y(), 1, 0.02);
}

TEST(Dynamics3dTerrain, VoxelsStopRobotsAndBearBlocksAndPreys)
{
  octomap::OcTree tree = FloorTree();
  for (int y = 0; y < 40; ++y)
    for (int z = 0; z < 6; ++z)
      tree.updateNode(
          octomap::point3d(2.025F, 0.025F + 0.05F * static_cast<float>(y), 0.025F + 0.05F * static_cast<float>(z)),
          true, true);
  const MapFile file(tree);
  Dynamics3dTestWorld world;
  world.Set("ground", "false");
  const auto footbot = world.AddFootbot({1.5, 1, 0});
  const auto prey = world.AddPrey({1, 0.5, 0.02}, 0.3);
  const auto block = world.AddBlock({1, 1.5, 0.08}, {0.2, 0.15, 0.1}, 0.5);
  const auto handbot = world.AddHandbot({3, 1, 0.01});
  const auto eyebot = world.AddEyebot({3, 0.4, 0.8});
  world.AddTerrain("octomap", {{"file", file.Path()}}, Vector3::Zero());
  world.AddCommands("footbot_wheels", 2);
  world.AddCommands("eyebot_propellers", 4);
  world.Start();
  world.Drive(footbot, 0.2, 0.2);
  world.Command("eyebot_propellers", eyebot, {0, 0, -0.3, 0});
  world.Run(60);
  EXPECT_NEAR(world.Position(footbot).x(), 2 - 0.085, 0.01);
  EXPECT_NEAR(world.Position(prey).z(), 0, 3e-3);
  EXPECT_NEAR(world.Position(block).z(), 0.05, 3e-3);
  EXPECT_NEAR(world.Position(handbot).z(), 0, 0.01);
  EXPECT_NEAR(world.Position(eyebot).z(), 0, 0.01);
}

// Cells of a box (m), 5 cm each.
void Fill(octomap::OcTree& tree, const Vector3& low, const Vector3& high)
{
  const Vector3 half = Vector3::Constant(0.025);
  for (Vector3 at = low + half; at.z() < high.z(); at.z() += 0.05)
    for (at.y() = low.y() + 0.025; at.y() < high.y(); at.y() += 0.05)
      for (at.x() = low.x() + 0.025; at.x() < high.x(); at.x() += 0.05)
        tree.updateNode(
            octomap::point3d(static_cast<float>(at.x()), static_cast<float>(at.y()), static_cast<float>(at.z())), true,
            true);
}

// Things much larger than the pillar, dropped on its middle, and one that leans on two pillars of unequal height.
TEST(Dynamics3dTerrain, WhatIsLargerThanAPillarOfCellsRestsOnItAsOnABlock)
{
  octomap::OcTree tree(0.05);
  Fill(tree, {0.9, 0.9, 0}, {1.1, 1.1, 0.3});
  Fill(tree, {2.9, 0.9, 0}, {3.1, 1.1, 0.3});
  Fill(tree, {0.9, 2.9, 0}, {1.1, 3.1, 0.3});
  Fill(tree, {1.5, 2.9, 0}, {1.7, 3.1, 0.4});
  const MapFile file(tree);
  const auto run = [&](bool cells)
  {
    Dynamics3dTestWorld world;
    std::vector<std::uint32_t> things;
    things.push_back(world.AddBlock({1, 1, 0.4}, {0.8, 0.8, 0.05}, 1));
    things.push_back(world.AddPrey({3, 1, 0.4}, 1, 0.3, 0.1));
    things.push_back(world.AddBlock({1.3, 3, 0.45}, {0.9, 0.1, 0.05}, 1));
    if (cells)
      world.AddTerrain("octomap", {{"file", file.Path()}}, Vector3::Zero());
    else
    {
      world.AddWall({1, 1, 0.15}, {0.2, 0.2, 0.3});
      world.AddWall({3, 1, 0.15}, {0.2, 0.2, 0.3});
      world.AddWall({1, 3, 0.15}, {0.2, 0.2, 0.3});
      world.AddWall({1.6, 3, 0.2}, {0.2, 0.2, 0.4});
    }
    world.Start();
    world.Run(100);
    EXPECT_EQ(world.engine->World().SleeperCount(), 3U) << (cells ? "cells" : "blocks");
    std::vector<Pose> poses;
    for (const auto thing : things) poses.push_back(world.Space().GetPose(thing));
    return poses;
  };
  const std::vector<Pose> on_blocks = run(false);
  const std::vector<Pose> on_cells = run(true);
  EXPECT_NEAR(on_cells[0].position.z(), 0.325, 2e-3);
  EXPECT_NEAR(on_cells[1].position.z(), 0.3, 2e-3);
  for (std::size_t k = 0; k < 3; ++k)
  {
    EXPECT_LT((on_cells[k].position - on_blocks[k].position).norm(), 0.01) << k;
    EXPECT_LT(on_cells[k].orientation.angularDistance(on_blocks[k].orientation), 0.02) << k;
  }
}

// The merged boxes are the occupied cells, each once.
TEST(Dynamics3dTerrain, MergedBoxesHoldTheOccupiedCellsOnce)
{
  octomap::OcTree tree(0.05);
  RandomStream random(3, 0, 0, 0);
  for (int k = 0; k < 1500; ++k)
    tree.updateNode(
        octomap::point3d(static_cast<float>(random.Uniform(0, 0.6)), static_cast<float>(random.Uniform(0, 0.6)),
                         static_cast<float>(random.Uniform(0, 0.4))),
        true, true);
  const MapFile file(tree);
  const VoxelTerrain terrain(file.Path());
  std::vector<bool> taken;
  std::vector<dynamics3d::CellBox> boxes;
  for (int k = 0; k < 50; ++k)
  {
    const Vector3 low(random.Uniform(-0.2, 0.6), random.Uniform(-0.2, 0.6), random.Uniform(-0.2, 0.4));
    const Vector3 high = low + Vector3(random.Uniform(0, 0.5), random.Uniform(0, 0.5), random.Uniform(0, 0.5));
    const dynamics3d::CellBox range = dynamics3d::CellsAround(terrain, low, high);
    MergeCells(terrain, range, taken, boxes);
    for (int z = range.low[2]; z <= range.high[2]; ++z)
      for (int y = range.low[1]; y <= range.high[1]; ++y)
        for (int x = range.low[0]; x <= range.high[0]; ++x)
        {
          const auto holds = [&](const dynamics3d::CellBox& box)
          {
            return x >= box.low[0] && x <= box.high[0] && y >= box.low[1] && y <= box.high[1] && z >= box.low[2] &&
                   z <= box.high[2];
          };
          ASSERT_EQ(std::count_if(boxes.begin(), boxes.end(), holds), terrain.IsOccupied(x, y, z) ? 1 : 0);
        }
  }
}

// Cells that hang 10 cm above the ground are lower than a footbot.
TEST(Dynamics3dTerrain, ABeamOfCellsStopsARobotThatIsHigherThanTheGapBelow)
{
  octomap::OcTree tree(0.05);
  Fill(tree, {2, 0.5, 0.1}, {2.05, 1.5, 0.15});
  Fill(tree, {3, 0.5, 0.2}, {3.05, 1.5, 0.25});
  const MapFile file(tree);
  Dynamics3dTestWorld world;
  const auto stopped = world.AddFootbot({1.6, 1, 0});
  const auto free = world.AddFootbot({2.6, 1, 0});
  world.AddTerrain("octomap", {{"file", file.Path()}}, Vector3::Zero());
  world.AddCommands("footbot_wheels", 2);
  world.Start();
  for (const auto robot : {stopped, free}) world.Drive(robot, 0.2, 0.2);
  world.Run(50);
  EXPECT_NEAR(world.Position(stopped).x(), 2 - 0.085, 0.01);
  EXPECT_NEAR(world.Position(free).x(), 3.6, 0.05);
}

TEST(Dynamics3dTerrain, SpheresRestOnAFlatFloorWithoutFeelingItsCells)
{
  octomap::OcTree tree = FloorTree();
  const MapFile file(tree);
  const VoxelTerrain terrain(file.Path());
  RandomStream random(2, 0, 0, 0);
  for (int k = 0; k < 2000; ++k)
  {
    const Vector3 centre(random.Uniform(0.3, 3.7), random.Uniform(0.3, 1.7), random.Uniform(0.001, 0.12));
    const double radius = random.Uniform(0.02, 0.15);
    std::vector<dynamics3d::VoxelContact> contacts;
    FindVoxelContacts(terrain, centre, radius, contacts);
    if (centre.z() >= radius)
    {
      EXPECT_TRUE(contacts.empty());
      continue;
    }
    ASSERT_EQ(contacts.size(), 1U) << "one contact for one plane";
    EXPECT_NEAR(contacts[0].normal.z(), 1, 1e-12);
    EXPECT_NEAR(contacts[0].depth, radius - centre.z(), 1e-6);
  }
}

TEST(Dynamics3dTerrain, AFootbotStandsOnTheFloorOfARealBuilding)
{
  if (!std::filesystem::exists(kBuilding)) GTEST_SKIP() << kBuilding << " is not installed";
  const VoxelTerrain terrain(kBuilding);
  // A place with floor below, free above, flat around.
  std::optional<Vector3> place;
  for (double x = terrain.Low().x() + 1; x < terrain.High().x() - 1 && !place; x += 0.25)
    for (double y = terrain.Low().y() + 1; y < terrain.High().y() - 1 && !place; y += 0.25)
    {
      const auto floor = terrain.GroundBelow({x, y, terrain.Low().z() + 1});
      if (!floor) continue;
      bool flat = true;
      for (double dx = -0.24; dx <= 0.25 && flat; dx += 0.08)
        for (double dy = -0.24; dy <= 0.25 && flat; dy += 0.08)
        {
          const auto here = terrain.GroundBelow({x + dx, y + dy, *floor + 0.5});
          flat = here && std::abs(*here - *floor) < 1e-6;
        }
      if (flat) place = Vector3(x, y, *floor);
    }
  ASSERT_TRUE(place.has_value());
  Dynamics3dTestWorld world;
  world.Set("ground", "false");
  const auto footbot = world.AddFootbot(*place + Vector3(0, 0, 0.01));
  world.AddTerrain("octomap", {{"file", kBuilding}}, Vector3::Zero());
  world.AddCommands("footbot_wheels", 2);
  world.Start();
  world.Run(20);
  EXPECT_NEAR(world.Position(footbot).z(), place->z(), 2e-3);
  world.Drive(footbot, 0.1, 0.1);
  world.Run(10);
  EXPECT_NEAR((world.Position(footbot) - *place).head<2>().norm(), 0.1, 0.01);
}

TEST(Dynamics3dTerrain, AFootbotFallsIntoAHoleAndStaysThere)
{
  Dynamics3dTestWorld world;
  const auto footbot = world.AddFootbot({4, 5, 0});
  world.Add(EntityKind::kHole, {5, 5, 0}, Quaternion::Identity(), {0.6, 0.6, 0}, 0, false);
  world.AddCommands("footbot_wheels", 2);
  world.Start();
  world.Drive(footbot, 0.2, 0.2);
  double highest = 0;
  for (int tick = 0; tick < 150; ++tick)
  {
    world.Tick();
    highest = std::max(highest, world.Position(footbot).z());
  }
  EXPECT_LT(world.Position(footbot).z(), -0.3);
  EXPECT_GT(world.Position(footbot).z(), -0.6);
  EXPECT_LT(highest, 0.05);
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
    Dynamics3dTestWorld world;
    world.Set("position", position);
    world.Set("orientation", orientation);
    // Gravity along the frame's -z.
    const Vector3 down = frame.orientation * Vector3(0, 0, -9.81);
    world.Set("gravity", fmt::format("{}, {}, {}", down.x(), down.y(), down.z()));
    const Pose footbot_at = frame.Compose({Vector3(1, 1, 0), QuaternionFromYaw(0.4)});
    const auto footbot = world.Add(EntityKind::kFootbot, footbot_at.position, footbot_at.orientation,
                                   {0.085036758, 0.085036758, 0.146899733});
    const Pose block_at = frame.Compose({Vector3(1.3, 1.15, 0.05), Quaternion::Identity()});
    const auto block =
        world.Add(EntityKind::kBlock, block_at.position, block_at.orientation, {0.1, 0.1, 0.1}, 0.3, true);
    world.AddCommands("footbot_wheels", 2);
    world.Start();
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
  world.AddCommands("footbot_wheels", 2);
  world.Start();
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
  world.Start();
  world.Run(50);
  std::vector<Vector3> before;
  for (const auto thing : things) before.push_back(world.Position(thing));
  world.Run(450);
  for (std::size_t k = 0; k < things.size(); ++k)
    EXPECT_LT((world.Position(things[k]) - before[k]).norm(), 0.015) << "entity " << k;
  // The creep that docs/engines.md tells of, 0.2 mm/s, and nothing else.
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
  world.AddCommands("footbot_wheels", 2);
  world.Start();
  world.Command("footbot_wheels", footbot, {std::nan(""), 0});
  EXPECT_THROW(world.Tick(), std::runtime_error);
}

}  // namespace
}  // namespace swarmanoid

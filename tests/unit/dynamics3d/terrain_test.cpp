// Heightfields, voxels of maps, holes.
#include <octomap/octomap.h>

#include <cmath>
#include <filesystem>

#include "common/math/random.h"
#include "dynamics3d_test_world.h"
#include "engine_worker/engines/dynamics3d/terrain_shape.h"
#include "engine_worker/engines/dynamics3d/voxel_contacts.h"
#include "tests/world/temporary_folder.h"

namespace swarmanoid
{
namespace
{

// It is a real corridor, part of Debian's liboctomap-dev.
constexpr const char* kBuilding = "/usr/share/doc/liboctomap-dev/examples/data/geb079.bt";

// It is an OctoMap file that lives as long as the test.
class MapFile
{
public:
  explicit MapFile(octomap::OcTree& tree)
  {
    tree.updateInnerOccupancy();
    tree.writeBinary(Path());
  }
  std::string Path() const { return folder_ / "map.bt"; }

private:
  test::TemporaryFolder folder_;
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

TEST(Dynamics3dTerrain, AWheelRollsOverAHeightfieldAtTheSpeedOfTheWheels)
{
  // Hills of 1.5 cm, 1 m long: put in as a terrain in memory.
  std::vector<double> heights;
  for (int row = 0; row < 41; ++row)
    for (int column = 0; column < 81; ++column) heights.push_back(0.015 * Sin(2 * kPi * column * 0.05));
  const auto hills = std::make_shared<const HeightTerrain>(heights, 81, 41, 4.0, 2.0);
  Dynamics3dTestWorld world("ground", "false");
  const auto footbot = world.AddFootbot({1, 1, 0.001});
  world.Start();
  std::unique_ptr<dynamics3d::TerrainShape> shape =
      AddHeightfield(world.engine->WorldForTest(), 0xfffffff0U, hills, Pose());
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
  Dynamics3dTestWorld world("ground", "false");
  world.AddFootbot({0, 0, 0});
  world.Start();
  const Pose pose{Vector3(3, 4, 0.5), Quaternion::Identity()};
  auto shape = AddHeightfield(world.engine->WorldForTest(), 0xfffffff0U, ramp, pose);
  RandomStream random(1, 0, 0, 0);
  for (int k = 0; k < 200; ++k)
  {
    const double x = random.Uniform(0.05, 0.95);
    const double y = random.Uniform(0.05, 1.95);
    const double distance = world.engine->WorldForTest().DistanceToStatic(pose.Apply({x, y, 1}), -Vector3::UnitZ(), 5);
    EXPECT_NEAR(1 - distance, 0.1 * y + 0.02 * x, 1e-9);
  }
  world.engine.reset();
}

TEST(Dynamics3dTerrain, AFootbotDrivesOverAFloorOfVoxelsAsOverAPlane)
{
  octomap::OcTree tree = FloorTree();
  const MapFile file(tree);
  Dynamics3dTestWorld world("ground", "false");
  const auto footbot = world.AddFootbot({0.5, 1, 0});
  world.AddTerrain("octomap", {{"file", file.Path()}}, Vector3::Zero());
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
  Dynamics3dTestWorld world("ground", "false");
  const auto footbot = world.AddFootbot({1.5, 1, 0});
  const auto prey = world.AddPrey({1, 0.5, 0.02}, 0.3);
  const auto block = world.AddBlock({1, 1.5, 0.08}, {0.2, 0.15, 0.1}, 0.5);
  const auto handbot = world.AddHandbot({3, 1, 0.01});
  const auto eyebot = world.AddEyebot({3, 0.4, 0.8});
  world.AddTerrain("octomap", {{"file", file.Path()}}, Vector3::Zero());
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
    world.Run(100);
    EXPECT_EQ(world.engine->WorldForTest().SleeperCount(), 3U) << (cells ? "cells" : "blocks");
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
  // The place has floor below, is free above, and is flat around.
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
  Dynamics3dTestWorld world("ground", "false");
  const auto footbot = world.AddFootbot(*place + Vector3(0, 0, 0.01));
  world.AddTerrain("octomap", {{"file", kBuilding}}, Vector3::Zero());
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

}  // namespace
}  // namespace swarmanoid

// Terrain is walls on the plane, the same ones in both two-dimensional engines.
#include <gtest/gtest.h>
#include <octomap/OcTree.h>

#include <cmath>
#include <filesystem>

#include "common/math/random.h"
#include "common/space/terrain/terrain.h"
#include "engine_fixture.h"
#include "engine_worker/engines/terrain_walls.h"
#include "tests/world/temporary_folder.h"

namespace swarmanoid
{
namespace
{

constexpr double kCell = 0.05;

// A ramp of steps over x = 1 … 3 that rises by one cell every half metre, along the whole map in y. At a plane's height
// z, what is solid begins where the ramp first is higher than z.
std::string WriteSteps(const test::TemporaryFolder& folder)
{
  octomap::OcTree map(kCell);
  for (int x = 0; x < 40; ++x)
    for (int y = 0; y < 40; ++y)
      for (int z = 0; z <= x / 10; ++z)
        map.updateNode(octomap::point3d(static_cast<float>(1 + (x + 0.5) * kCell),
                                        static_cast<float>((y + 0.5) * kCell), static_cast<float>((z + 0.5) * kCell)),
                       true);
  const std::string path = folder / "steps.bt";
  map.writeBinary(path);
  return path;
}

// Where a robot that drives along x from 0.5 m ends, and its clearance to the terrain at the plane's height.
double DriveAtTheSteps(const std::string& engine, const std::string& distance, const std::string& map)
{
  EngineFixture world;
  world.Configuration().tag = engine;
  world.Parameter("distance", distance);
  world.AddTerrain(map);
  const std::uint32_t robot = world.Add(EntityKind::kFootbot, {0.5, 1, std::stod(distance)});
  world.AddCommands("footbot_wheels", 2, {robot});
  world.Command(0) = world.Command(1) = WheelSpeed(0.2);
  world.Ticks(250);
  // A kinematic robot bounces off by a part of its way in a tick: the mean place is the one to compare.
  double mean = 0;
  for (int k = 0; k < 20; ++k)
  {
    world.Tick();
    mean += world.PoseOf(robot).position.x() / 20;
  }
  return mean;
}

TEST(TerrainInThePlane, RobotsOfBothEnginesStopAtTheSameStep)
{
  const test::TemporaryFolder folder;
  const std::string map = WriteSteps(folder);
  // The plane is cut 2 cm above itself: on the ground the first step, at 1 m, is a wall; 7 cm up the second one, whose
  // top is at 10 cm; 12 cm up the third. The gripper at the robot's front reaches 0.1 m ahead of its centre.
  for (const auto& [distance, wall] : {std::pair("0", 1.0), std::pair("0.07", 1.5), std::pair("0.12", 2.0)})
  {
    const double kinematic = DriveAtTheSteps("dummy_engine", distance, map);
    const double dynamic = DriveAtTheSteps("dynamics2d", distance, map);
    EXPECT_NEAR(dynamic, wall - 0.1, 0.005) << distance;
    EXPECT_NEAR(kinematic, wall - 0.1, 0.025) << distance;
  }
}

TEST(TerrainInThePlane, NobodyEntersARealBuildingsWalls)
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

  EngineFixture world;
  world.Parameter("distance", std::to_string(level));
  world.AddTerrain(map);
  RandomStream random(5, 0, 0, 0);
  std::vector<std::uint32_t> robots;
  while (robots.size() < 60)
  {
    const double x = random.Uniform(terrain.Low().x(), terrain.High().x());
    const double y = random.Uniform(terrain.Low().y(), terrain.High().y());
    if (!blocked(x, y, 0.2) && !blocked(x, y, 0.1))
      robots.push_back(world.Add(EntityKind::kFootbot, {x, y, level}, {0, 0, random.Uniform(-3, 3)}));
  }
  world.AddCommands("footbot_wheels", 2, robots);
  world.Start();
  int at_walls = 0;
  for (int tick = 0; tick < 150; ++tick)
  {
    for (std::size_t k = 0; k < robots.size(); ++k)
    {
      world.Command(2 * k) = WheelSpeed(0.3);
      world.Command(2 * k + 1) = WheelSpeed(tick % 30 < 20 ? 0.3 : 0.1);
    }
    world.Tick();
    for (const std::uint32_t robot : robots)
    {
      const Vector3 position = world.PoseOf(robot).position;
      ASSERT_FALSE(blocked(position.x(), position.y(), 0.07)) << "a robot is in a wall at " << position.transpose();
      at_walls += blocked(position.x(), position.y(), 0.105) ? 1 : 0;
    }
  }
  EXPECT_GT(at_walls, 0) << "some reach a wall";
}

TEST(TerrainInThePlane, ATerrainThatIsNotLevelWithThePlaneIsRefused)
{
  EngineFixture world;
  world.Parameter("perpendicular_axis", "x");
  const test::TemporaryFolder folder;
  const std::string map = WriteSteps(folder);
  world.AddTerrain(map);
  EXPECT_THROW(world.Start(), ConfigurationError);
}

}  // namespace
}  // namespace swarmanoid

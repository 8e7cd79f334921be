// Sensors and terrain: an OctoMap wall and floor, made for the test.
#include <octomap/octomap.h>

#include "common/control_interface/ci_range_and_bearing.h"
#include "common/control_interface/eyebot/ci_eyebot_altitude_sensor.h"
#include "common/control_interface/footbot/ci_footbot_ground_sensor.h"
#include "common/control_interface/footbot/ci_footbot_light_sensor.h"
#include "common/control_interface/footbot/ci_footbot_omnidirectional_camera_sensor.h"
#include "common/control_interface/footbot/ci_footbot_proximity_sensor.h"
#include "tests/unit/devices/test_world.h"
#include "tests/world/small_experiment.h"
#include "tests/world/temporary_folder.h"

namespace swarmanoid
{
namespace
{

// Cubes of 5 cm: a floor from (0, 0) to (2, 2) whose top is z = 1, with a hole from (1, 1) to (1.2, 1.2), and on it a
// wall from (0.5, 0) to (0.55, 2), 0.3 m high. It is entity 0.
class TerrainWorld : public TestWorld
{
public:
  explicit TerrainWorld(const char* engine_tag = "dynamics3d")
  {
    Configuration().engines[0].tag = engine_tag;
    octomap::OcTree tree(0.05);
    const auto fill = [&](double x, double y, double z)
    { tree.updateNode(octomap::point3d(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)), true); };
    for (int i = 0; i < 40; ++i)
      for (int j = 0; j < 40; ++j)
      {
        const bool is_hole = i >= 20 && i < 24 && j >= 20 && j < 24;
        if (!is_hole) fill(0.05 * i + 0.025, 0.05 * j + 0.025, 0.975);
        if (i == 10)
          for (int k = 0; k < 6; ++k) fill(0.525, 0.05 * j + 0.025, 1.025 + 0.05 * k);
      }
    tree.updateInnerOccupancy();
    tree.writeBinary(path_);

    const auto terrain = Add(EntityKind::kTerrain, {0, 0, 0}, 0, {0, 0, 0}, false);
    Configuration().entities[terrain].tree = test::TerrainTree("octomap", {{"file", path_}});
  }

private:
  test::TemporaryFolder folder_;
  std::string path_ = folder_ / "map.bt";
};

TEST(TerrainSensing, ProximityRaysEndAtAVoxelWall)
{
  TerrainWorld world;
  world.AddFootbot(0.4, 0.5, kPi / 24, 1);  // the wall is 0.1 m ahead of the middle
  world.AddFootbot(1.5, 0.5, kPi / 24, 1);
  TestSensor sensor(world, "footbot_proximity", "generic_footbot_proximity", {1, 2});
  sensor.Update();
  const auto near = sensor.Of<CCI_FootBotProximitySensor>(0).GetAllSensorReadings();
  // A ray 7.5 degrees beside the front, turned by 7.5 degrees, is 15 degrees off the normal of the wall.
  const double distance = 0.1 / std::cos(kPi / 12) - 0.085036758;
  EXPECT_NEAR(near[0], 0.0100527 / (distance + 0.000163144), 1e-3);
  EXPECT_EQ(near[12], 0);
  for (const double reading : sensor.Of<CCI_FootBotProximitySensor>(1).GetAllSensorReadings()) EXPECT_EQ(reading, 0);
}

TEST(TerrainSensing, ATerrainOfAnotherWorldIsNotFelt)
{
  TerrainWorld world;
  world.AddEngine("other");
  world.AddFootbot(0.4, 0.5, 0, 1, 1);
  TestSensor sensor(world, "footbot_proximity", "generic_footbot_proximity", {1});
  sensor.Update();
  for (const double reading : sensor.Of<CCI_FootBotProximitySensor>(0).GetAllSensorReadings()) EXPECT_EQ(reading, 0);
}

TEST(TerrainSensing, AVoxelWallHidesLedsMessagesAndLightsBehindIt)
{
  TerrainWorld world;
  world.AddFootbot(0.3, 0.5, 0, 1);
  world.AddFootbot(0.75, 0.5, 0, 1);  // behind the wall
  world.AddFootbot(0.3, 0.9, 0, 1);   // on this side
  world.Add(EntityKind::kLightBulb, {1.5, 0.5, 1.1}, 0, {0, 0, 0}, false);
  world.Add(EntityKind::kLightBulb, {1.5, 0.5, 3.0}, 0, {0, 0, 0}, false);  // over the wall
  for (const std::uint32_t robot : {2U, 3U})
  {
    for (int led = 0; led < 12; ++led) world.Space().GetEntity(robot).SetAttribute("led", CCI_Colour::RED, led);
    world.Space().GetEntity(robot).SetAttribute("message", 1);
  }
  world.Space().GetEntity(5).SetAttribute("intensity", 0);
  TestSensor camera(world, "footbot_omnidirectional_camera", "generic_footbot_omnidirectional_camera", {1},
                    {{"aperture", "80"}});
  camera.Update();
  const auto blobs = camera.Of<CCI_FootBotOmnidirectionalCameraSensor>(0).GetAllBlobs();
  ASSERT_EQ(blobs.size(), 1U);
  EXPECT_NEAR(blobs[0].angle_rad, kPi / 2, 1e-9);
  TestSensor receiver(world, "range_and_bearing", "generic_range_and_bearing", {1});
  receiver.Update();
  ASSERT_EQ(receiver.Of<CCI_RangeAndBearingSensor>(0).GetAllPackets().size(), 1U);
  TestSensor light(world, "footbot_light", "generic_footbot_light", {1});
  light.Update();
  for (const double reading : light.Of<CCI_FootBotLightSensor>(0).GetAllSensorReadings()) EXPECT_EQ(reading, 0);
  world.Space().GetEntity(5).SetAttribute("intensity", 1);
  light.Update();
  EXPECT_GT(light.Of<CCI_FootBotLightSensor>(0).GetAllSensorReadings()[0], 0);
}

TEST(TerrainSensing, AltitudeIsMeasuredToTheTerrain)
{
  TerrainWorld world;
  world.AddEyebot(1.5, 1.5, 2.5);
  world.AddEyebot(1.1, 1.1, 2.5);  // over the hole
  TestSensor sensor(world, "eyebot_altitude", "generic_eyebot_altitude", {1, 2});
  sensor.Update();
  EXPECT_NEAR(sensor.Of<CCI_EyeBotAltitudeSensor>(0).GetAltitude(), 1.5, 1e-6);
  EXPECT_NEAR(sensor.Of<CCI_EyeBotAltitudeSensor>(1).GetAltitude(), 2.5, 1e-12);
}

TEST(TerrainSensing, TheLaserSpotLiesOnTheTerrainAndIsSeenThere)
{
  TerrainWorld world;
  world.AddFootbot(1.5, 1.2, 0, 1);
  world.AddEyebot(1.5, 1.5, 2.5);
  world.Space().GetEntity(2).SetAttribute("laser", 1);
  TestSensor camera(world, "footbot_omnidirectional_camera", "generic_footbot_omnidirectional_camera", {1});
  camera.Update();
  const auto blobs = camera.Of<CCI_FootBotOmnidirectionalCameraSensor>(0).GetAllBlobs();
  ASSERT_EQ(blobs.size(), 1U);
  EXPECT_NEAR(blobs[0].distance_m, 0.3, 1e-6);
}

TEST(TerrainSensing, TheGroundSensorSeesHolesOfTheTerrain)
{
  for (const std::string engine : {"dynamics3d", "kinematics2d"})
  {
    TerrainWorld world(engine.c_str());
    world.AddFootbot(0.975, 1.1, 0, 1);  // sensor 0 is 0.08 m ahead: over the hole
    world.AddFootbot(1.5, 0.5, 0, 1);
    TestSensor sensor(world, "footbot_ground", "generic_footbot_ground", {1, 2});
    sensor.Update();
    const auto& at_hole = sensor.Of<CCI_FootBotGroundSensor>(0);
    EXPECT_EQ(at_hole.GetAllSensorReadings()[0], engine == "dynamics3d" ? 0 : 1);  // planes have ground everywhere
    EXPECT_EQ(at_hole.GetAllSensorReadings()[4], 1);
    EXPECT_EQ(at_hole.GetFloorColour(), 0xffffffU);
    for (const double reading : sensor.Of<CCI_FootBotGroundSensor>(1).GetAllSensorReadings()) EXPECT_EQ(reading, 1);
  }
}

}  // namespace
}  // namespace swarmanoid

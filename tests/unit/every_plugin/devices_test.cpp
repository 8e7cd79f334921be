// Every sensor and actuator that is registered, on every kind of robot that can carry it, in every engine that serves
// it, where there is nothing, or one thing, to be sensed. The tables of plug-ins and kinds make the scenes, so that a
// new device, kind or engine is covered without a new test.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>

#include "common/checkpoint/checkpoint.h"
#include "common/space/space.h"
#include "space_server/experiment_functions.h"
#include "tests/unit/every_plugin/small_scene.h"
#include "tests/world/temporary_folder.h"

namespace swarmanoid
{
namespace
{

std::string Robot(EntityKind robot) { return EntityElement(robot, "robot", kRobotX_m, kRobotY_m, "c"); }

// Calls use(scene) with each robot, engine and set of devices; the arena is still empty.
template <class Use>
void ForEachSet(Use use)
{
  for (const PluginDescription* engine : AllEngines())
    for (const EntityKind robot : AllRobots())
    {
      if (!Simulates(*engine, robot)) continue;
      for (const Devices& devices : DeviceSets(robot, *engine))
      {
        SCOPED_TRACE(fmt::format("{} in {}", TagName(robot), engine->label));
        use(SmallScene{.engine = engine->label, .devices = devices, .arena = {}}, robot, *engine);
      }
    }
}

TEST(SimplestScenes, ARobotAloneReadsFiniteNumbersWithinTheirRanges)
{
  ForEachSet(
      [](SmallScene scene, EntityKind robot, const PluginDescription&)
      {
        scene.arena = Robot(robot);
        RunScene(scene);
      });
}

// If two devices share computed data, one device alone might find it missing.
TEST(SimplestScenes, EachDeviceByItselfNeedsNoOther)
{
  ForEachSet(
      [](SmallScene scene, EntityKind robot, const PluginDescription& engine)
      {
        const Devices all = scene.devices;
        for (const PluginDescription* sensor : all.sensors)
          for (const EntityKind other : {EntityKind::kGroundPatch, EntityKind::kLightBulb, robot})
          {
            if (!sensor->channel.empty() && other != robot) continue;
            if (sensor->channel.empty() && engine.label != "kinematics2d") continue;
            SCOPED_TRACE(fmt::format("sensor {} ({}) and a {}", sensor->label, sensor->implementation, TagName(other)));
            scene.devices = {{sensor}, {}};
            scene.arena =
                Robot(robot) + EntityElement(other, "other", kRobotX_m + NearDistance(robot, other), kRobotY_m);
            RunScene(scene);
          }
        for (const PluginDescription* actuator : all.actuators)
        {
          SCOPED_TRACE(fmt::format("actuator {} ({})", actuator->label, actuator->implementation));
          scene.devices = {{}, {actuator}};
          scene.arena = Robot(robot);
          RunScene(scene);
        }
      });
}

TEST(SimplestScenes, OneEntityOfEachKindIsSensedNearAndFar)
{
  ForEachSet(
      [](SmallScene scene, EntityKind robot, const PluginDescription& engine)
      {
        for (const EntityKind other : AllKinds())
        {
          if (!IsBodiless(other) && !Simulates(engine, other)) continue;
          SCOPED_TRACE(fmt::format("beside one {}", TagName(other)));
          for (const double x : {kRobotX_m + NearDistance(robot, other), kFarX_m})
          {
            scene.arena = Robot(robot) + EntityElement(other, "other", x, kRobotY_m);
            RunScene(scene);
          }
        }
      });
}

TEST(SimplestScenes, WhatComesLaterIsSensedThen)
{
  ForEachSet(
      [](SmallScene scene, EntityKind robot, const PluginDescription& engine)
      {
        for (const EntityKind other : AllKinds())
        {
          if (!CanWait(other) || (!IsBodiless(other) && !Simulates(engine, other))) continue;
          SCOPED_TRACE(fmt::format("a {} that comes later", TagName(other)));
          scene.arena = Robot(robot) + Waiting(other, "other");
          const double x = kRobotX_m + NearDistance(robot, other);
          std::string added;
          RunScene(scene,
                   [&](CSimulator& simulator)
                   {
                     const Pose pose{{x, kRobotY_m, HeightOf(other)}, Quaternion::Identity()};
                     if (simulator.GetSpace().GetTick() == 2) added = simulator.GetEditor().AddEntity("other", pose);
                     if (simulator.GetSpace().GetTick() == 6) simulator.GetEditor().RemoveEntity(added);
                   });
        }
      });
}

// On hills of a millimetre the robot stands as on the floor.
TEST(SimplestScenes, TerrainIsSensed)
{
  std::set<std::string> engines;
  ForEachSet(
      [&](SmallScene scene, EntityKind robot, const PluginDescription& engine)
      {
        if (!Simulates(engine, EntityKind::kTerrain)) return;
        engines.insert(engine.label);
        const std::string terrain = fmt::format(
            "<terrain id='hills'><heightmap file='configs/terrain/hills.png' size='{0},{0}' height='0.001'/></terrain>",
            kArena_m);
        for (const std::string& robots : {std::string(), Robot(robot)})
        {
          scene.arena = terrain + robots;
          RunScene(scene);
        }
      });
  EXPECT_FALSE(engines.empty());
}

TEST(SimplestScenes, TwoRobotsWithTheSameDevicesSenseEachOther)
{
  ForEachSet(
      [](SmallScene scene, EntityKind robot, const PluginDescription&)
      {
        for (const double x : {kRobotX_m + NearDistance(robot, robot), kFarX_m})
        {
          scene.arena = Robot(robot) + EntityElement(robot, "second", x, kRobotY_m, "c");
          RunScene(scene);
        }
      });
}

TEST(SimplestScenes, AnArenaWithoutRobotsRuns)
{
  ForEachSet([](SmallScene scene, EntityKind, const PluginDescription&) { RunScene(scene); });
}

TEST(SimplestScenes, ARobotInAReserveWaitsAndWorksWhenItIsAdded)
{
  ForEachSet(
      [](SmallScene scene, EntityKind robot, const PluginDescription&)
      {
        scene.arena = Waiting(robot, "robot", "c");
        RunScene(scene);
        RunScene(scene,
                 [](CSimulator& simulator)
                 {
                   const Pose pose{{kRobotX_m, kRobotY_m, 0}, Quaternion::Identity()};
                   if (simulator.GetSpace().GetTick() == 3) simulator.GetEditor().AddEntity("robot", pose);
                 });
      });
}

// The same scene in another way: with threads, and from a checkpoint in its middle.
TEST(SimplestScenes, ThreadsAndCheckpointsChangeNoBit)
{
  const test::TemporaryFolder folder;
  ForEachSet(
      [&](SmallScene scene, EntityKind robot, const PluginDescription&)
      {
        scene.framework = "<canonical_period>4</canonical_period>";
        scene.arena =
            Robot(robot) + EntityElement(robot, "second", kRobotX_m + NearDistance(robot, robot), kRobotY_m, "c");
        const std::unique_ptr<Experiment> experiment = Read(scene);
        ASSERT_NE(experiment, nullptr);
        SimulatorOptions options;
        options.threads = 1;
        options.output_folder = folder.Path();
        options.checkpoint_every = 4;
        const std::uint64_t hash = RunScene(*experiment, options);
        options.restore_file = folder / CheckpointName(4);
        options.checkpoint_every = 0;
        EXPECT_EQ(RunScene(*experiment, options), hash) << "from a checkpoint";
        options.restore_file.clear();
        options.threads = 3;
        EXPECT_EQ(RunScene(*experiment, options), hash) << "with 3 threads";
      });
}

// Readings of devices that fail stay within their ranges, and what faults remember is saved.
TEST(SimplestScenes, EachDeviceMayFail)
{
  const test::TemporaryFolder folder;
  ForEachSet(
      [&](SmallScene scene, EntityKind robot, const PluginDescription&)
      {
        scene.framework = "<canonical_period>4</canonical_period>";
        scene.faults =
            "<fault id='lost' kind='drop' value='0.5'/><fault id='dead' kind='dead' entities='robot' from='3' to='5'/>"
            "<fault id='off' kind='off' entities='second' from='2' to='6'/>";
        scene.arena =
            Robot(robot) + EntityElement(robot, "second", kRobotX_m + NearDistance(robot, robot), kRobotY_m, "c");
        const std::unique_ptr<Experiment> experiment = Read(scene);
        ASSERT_NE(experiment, nullptr);
        SimulatorOptions options;
        options.output_folder = folder.Path();
        options.checkpoint_every = 4;
        const std::uint64_t hash = RunScene(*experiment, options);
        options.restore_file = folder / CheckpointName(4);
        options.checkpoint_every = 0;
        EXPECT_EQ(RunScene(*experiment, options), hash) << "from a checkpoint";
      });
}

// A device that no scene above has would be covered by nothing.
TEST(SimplestScenes, EachDeviceIsCarriedBySomeRobotInSomeEngine)
{
  std::map<const PluginDescription*, bool> met;
  for (const PluginKind kind : {PluginKind::kSensor, PluginKind::kActuator})
    for (const PluginDescription* device : PluginCatalogue::Instance().Of(kind)) met[device] = false;
  ForEachSet(
      [&](const SmallScene& scene, EntityKind, const PluginDescription&)
      {
        for (const PluginDescription* sensor : scene.devices.sensors) met[sensor] = true;
        for (const PluginDescription* actuator : scene.devices.actuators) met[actuator] = true;
      });
  for (const auto& [device, is_met] : met)
    EXPECT_TRUE(is_met) << NameOfPlugin(PluginKind::kSensor, device->label, device->implementation);
}

}  // namespace
}  // namespace swarmanoid

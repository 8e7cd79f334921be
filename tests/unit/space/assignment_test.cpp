#include "common/messages/assignment.h"

#include <gmock/gmock.h>

#include "common/plugins/catalogue.h"
#include "tests/world/small_experiment.h"

namespace swarmanoid
{
namespace
{

using testing::ElementsAre;
using testing::IsEmpty;

// Two specific devices and a generic one, known to the catalogue of this program.
void RegisterDevices()
{
  static const bool registered = []
  {
    const auto add = [](PluginKind kind, const char* label, const char* channel, int width)
    {
      return PluginCatalogue::Instance().Add(
          kind, {.label = label, .implementation = "test", .channel = channel, .channel_width = width});
    };
    return add(PluginKind::kActuator, "test_wheels", "test_wheels", 2) &&
           add(PluginKind::kActuator, "test_leds", "", 0) && add(PluginKind::kSensor, "test_torque", "test_torque", 3);
  }();
  ASSERT_TRUE(registered);
}

EntityConfiguration Robot(const std::string& id, const std::string& controller)
{
  EntityConfiguration robot = test::Entity(EntityKind::kFootbot, id);
  robot.controller = controller;
  return robot;
}

// Robots 0, 2, 4 in engine 0 and 1, 3 in engine 1; robot 4 also mirrored in engine 1; 5 a wall in both; 6 a robot in no
// engine.
Experiment Mixed()
{
  RegisterDevices();
  Experiment experiment;
  ControllerConfiguration driver;
  driver.id = "driver";
  driver.actuators = {{"test_wheels", "test", {}}};
  driver.sensors = {{"test_torque", "test", {}}};
  ControllerConfiguration blinker;
  blinker.id = "blinker";
  blinker.actuators = {{"test_wheels", "test", {}}, {"test_leds", "test", {}}};
  experiment.controllers = {driver, blinker};
  experiment.entities = {Robot("r0", "driver"), Robot("r1", "driver"), Robot("r2", "driver"), Robot("r3", "blinker"),
                         Robot("r4", "driver"), EntityConfiguration{}, Robot("r6", "blinker")};
  experiment.engines.resize(2);
  experiment.engines[0].entities = {0, 2, 4, 5};
  experiment.engines[1].entities = {1, 3, 4, 5};
  return experiment;
}

TEST(Assignment, TheFirstEngineThatListsAnEntityOwnsIt)
{
  const Assignment assignment = MakeAssignment(Mixed(), 1);
  EXPECT_THAT(assignment.owner, ElementsAre(0, 1, 0, 1, 0, -1, -1));
  EXPECT_THAT(assignment.engines[0].owned, ElementsAre(0, 2, 4));
  EXPECT_THAT(assignment.engines[1].owned, ElementsAre(1, 3));
  EXPECT_THAT(assignment.engines[1].mirrored, ElementsAre(4));
  EXPECT_THAT(assignment.engines[0].fixed, ElementsAre(5));
  EXPECT_THAT(assignment.engines[1].fixed, ElementsAre(5));
}

TEST(Assignment, RegionsAreCountedOverAllEngines)
{
  Experiment experiment = Mixed();
  experiment.engines.resize(3);
  experiment.engines[0].id = "a";
  experiment.engines[0].split = {3, 0};
  experiment.engines[2].id = "c";
  experiment.engines[2].split = {4, 2};
  EXPECT_EQ(RegionsOf(experiment.engines[0]), 3U);
  EXPECT_EQ(RegionsOf(experiment.engines[1]), 0U);
  EXPECT_EQ(RegionNumber(experiment, 0, 2), 2U);
  EXPECT_EQ(RegionNumber(experiment, 2, 0), 3U);
  EXPECT_EQ(RegionNumber(experiment, 3, 0), 7U);
  EXPECT_EQ(RegionName(experiment, 2, 1), "region 1 of engine 'c'");
}

TEST(Assignment, HostsFollowTheEngines)
{
  const Assignment assignment = MakeAssignment(Mixed(), 3);
  // Ordered by owner: 6 (none), 0 2 4 (first engine), 1 3 (second).
  EXPECT_THAT(assignment.hosts[0].robots, ElementsAre(0, 6));
  EXPECT_THAT(assignment.hosts[1].robots, ElementsAre(2, 4));
  EXPECT_THAT(assignment.hosts[2].robots, ElementsAre(1, 3));
  EXPECT_THAT(assignment.engines[0].commands_from, ElementsAre(0, 1));
  EXPECT_THAT(assignment.engines[1].commands_from, ElementsAre(2));
}

TEST(Assignment, OnlyHostsWithGenericActuatorsOrLooseRobotsReportToTheServer)
{
  Experiment experiment = Mixed();
  experiment.entities[6].controller = "driver";
  const Assignment assignment = MakeAssignment(experiment, 3);
  EXPECT_TRUE(assignment.hosts[0].reports_to_server);   // r6 has wheels alone too, and is in no engine
  EXPECT_FALSE(assignment.hosts[1].reports_to_server);  // wheels alone
  EXPECT_TRUE(assignment.hosts[2].reports_to_server);   // r3 has LEDs
}

// Each robot's values written by its host arrive at its place in its engine, whatever the number of hosts.
TEST(Assignment, EveryValueArrivesAtItsRobot)
{
  const Experiment experiment = Mixed();
  for (const unsigned hosts : {1U, 2U, 3U, 7U, 100U})
  {
    const Assignment assignment = MakeAssignment(experiment, hosts);
    ASSERT_LE(assignment.hosts.size(), 6U);
    std::vector<std::vector<double>> messages;
    for (const HostLayout& host : assignment.hosts)
    {
      std::vector<double> values(host.command_size, -1);
      for (const ChannelBlock& block : host.commands)
        for (std::size_t k = 0; k < block.entities.size(); ++k)
          for (int w = 0; w < block.width; ++w)
            values[block.offset + k * static_cast<std::size_t>(block.width) + static_cast<std::size_t>(w)] =
                10.0 * block.entities[k] + w;
      messages.push_back(std::move(values));
    }
    for (const EngineLayout& engine : assignment.engines)
    {
      std::vector<double> values(engine.command_size, -1);
      for (const ValueCopy& copy : engine.command_copies)
        std::copy_n(messages[copy.source].begin() + static_cast<std::ptrdiff_t>(copy.from), copy.count,
                    values.begin() + static_cast<std::ptrdiff_t>(copy.to));
      ASSERT_EQ(engine.commands.size(), 1U);
      EXPECT_EQ(engine.commands[0].entities, engine.owned);
      for (std::size_t k = 0; k < engine.owned.size(); ++k)
        for (std::size_t w = 0; w < 2; ++w)
          EXPECT_EQ(values[engine.commands[0].offset + 2 * k + w], 10.0 * engine.owned[k] + static_cast<double>(w));
    }
  }
}

TEST(Assignment, SensorValuesTravelTheOtherWay)
{
  const Assignment assignment = MakeAssignment(Mixed(), 2);
  EXPECT_THAT(assignment.engines[0].sensors[0].entities, ElementsAre(0, 2, 4));
  EXPECT_THAT(assignment.engines[1].sensors[0].entities, ElementsAre(1));
  EXPECT_THAT(assignment.hosts[0].frames_from, ElementsAre(0));
  EXPECT_THAT(assignment.hosts[1].frames_from, ElementsAre(0, 1));
}

// With wheels alone, in one engine.
Experiment Drivers(std::uint32_t robots)
{
  RegisterDevices();
  Experiment experiment;
  ControllerConfiguration driver;
  driver.id = "driver";
  driver.actuators = {{"test_wheels", "test", {}}};
  experiment.controllers = {driver};
  experiment.engines.resize(1);
  for (std::uint32_t i = 0; i < robots; ++i)
  {
    experiment.entities.push_back(Robot("r" + std::to_string(i), "driver"));
    experiment.engines[0].entities.push_back(i);
  }
  return experiment;
}

TEST(Assignment, ContiguousValuesAreOneCopy)
{
  const Experiment experiment = Drivers(1000);
  const Assignment assignment = MakeAssignment(experiment, 4);
  EXPECT_EQ(assignment.engines[0].command_copies.size(), 4U);
}

// For any order of the file, a square of robots is halved, and its halves are cut across the longer side.
TEST(Assignment, HostsHaveRobotsThatStartNearOneAnother)
{
  Experiment experiment = Drivers(64);
  for (std::uint32_t i = 0; i < 64; ++i)
  {
    const std::uint32_t scattered = i * 29 % 64;
    experiment.entities[i].pose.position = {scattered % 8 * 1.0, scattered / 8 * 1.0, 0};
  }
  const Assignment assignment = MakeAssignment(experiment, 4);
  for (std::size_t h = 0; h < 4; ++h)
  {
    ASSERT_EQ(assignment.hosts[h].robots.size(), 16U);
    EXPECT_TRUE(std::ranges::is_sorted(assignment.hosts[h].robots));
    for (const std::uint32_t robot : assignment.hosts[h].robots)
    {
      const Vector3& place = experiment.entities[robot].pose.position;
      EXPECT_EQ(place.x() < 4 ? 0U : 1U, h / 2) << "host " << h;
      EXPECT_EQ(place.y() < 4 ? 0U : 1U, h % 2) << "host " << h;
    }
  }
}

// The robots start in the order of a row, and have changed their order since.
TEST(Assignment, RobotsAreDealtByWhereTheyAre)
{
  Experiment experiment = Drivers(6);
  experiment.entities.insert(experiment.entities.begin() + 2, EntityConfiguration{});  // a wall
  for (EngineConfiguration& engine : experiment.engines) engine.entities = {0, 1, 3, 4, 5, 6};
  for (std::uint32_t i = 0; i < 7; ++i) experiment.entities[i].pose.position = {i * 1.0, 0, 0};
  EXPECT_THAT(DealRobots(experiment, 3).of_robots, ElementsAre(0, 0, 1, 1, 2, 2));
  std::vector<double> poses(6 * 7);
  for (std::size_t k = 0; k < 6; ++k) poses[k] = static_cast<double>((k * 5 + 2) % 6);  // 2 1 0 5 4 3
  const HostTable table = DealRobots(experiment, 3, poses);
  EXPECT_THAT(table.of_robots, ElementsAre(1, 0, 0, 2, 2, 1));
  const Assignment assignment = MakeAssignment(experiment, table);
  EXPECT_EQ(assignment.table, table);
  EXPECT_THAT(assignment.host, ElementsAre(1, 0, -1, 0, 2, 2, 1));
  EXPECT_THAT(assignment.hosts[1].robots, ElementsAre(0, 6));
  poses.pop_back();
  EXPECT_THROW(DealRobots(experiment, 3, poses), std::runtime_error);
}

TEST(Assignment, ATableIsOfTheRobotsOfTheExperiment)
{
  const Experiment experiment = Drivers(3);
  EXPECT_NO_THROW(MakeAssignment(experiment, HostTable{2, {1, 1, 1}}));
  for (const HostTable& table : {HostTable{1, {}}, HostTable{2, {0, 1}}, HostTable{4, {0, 1, 2}},
                                 HostTable{2, {0, 1, 2}}, HostTable{0, {0, 0, 0}}})
    EXPECT_THROW(MakeAssignment(experiment, table), std::runtime_error);
}

TEST(Assignment, AnExperimentWithoutRobotsHasOneIdleHost)
{
  const Experiment experiment;
  const Assignment assignment = MakeAssignment(experiment, 4);
  ASSERT_EQ(assignment.hosts.size(), 1U);
  EXPECT_THAT(assignment.hosts[0].robots, IsEmpty());
  EXPECT_FALSE(assignment.hosts[0].reports_to_server);
}

}  // namespace
}  // namespace swarmanoid

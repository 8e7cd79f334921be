// The result of a scene for each robot in each engine, and for each of its devices: tests/results/scenes.toml. With
// SWARMANOID_WRITE_RESULTS=1 the table is written again.
#include <fmt/format.h>
#include <gtest/gtest.h>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <string>

#include "common/control_interface/ci_controller.h"
#include "test_folders.h"
#include "tests/unit/every_plugin/small_scene.h"

namespace swarmanoid
{
namespace
{

constexpr const char* kReader = "results_reader";
constexpr const char* kTable = SWARMANOID_SOURCE_FOLDER "/tests/results/scenes.toml";
constexpr const char* kAbout =
    "# The results of small scenes after 200 ticks: of each robot in each engine with all its devices, and of each "
    "device by itself on a\n"
    "# robot that has it. A hash is of the state and of all that was read. The test Results of unit_every_plugin "
    "compares; with\n"
    "# SWARMANOID_WRITE_RESULTS=1 it writes them again. A row that changes is a change of results: the commit says "
    "why, CHANGELOG.md says\n"
    "# it to users.\n\n";

std::uint64_t& HashOfReadings()
{
  static std::uint64_t hash = 0;
  return hash;
}

constexpr std::uint64_t kFirstDrive = 4, kLetsGo = 100;  // ticks

// Adds all that is read to a hash. Actuators get their highest values first, all columns alike, then others; grippers
// close before anything else moves, and stay closed for half of the time.
class CResultsReader : public CCI_Controller
{
public:
  int Init(const TConfigurationTree) override { return RETURN_OK; }

  void ControlStep() override
  {
    for (const std::string& type : GetRobot()->SensorTypes())
    {
      const CCI_Sensor& sensor = *GetRobot()->GetSensor(type);
      std::vector<double> values;
      sensor.ReadColumns(values);
      // The table is older than this column, which the ground sensors have at the end.
      if (!values.empty() && sensor.Columns().back().name == "floor") values.pop_back();
      sensor.ReadRows(values);
      HashOfReadings() = XXH3_64bits_withSeed(values.data(), values.size() * sizeof(double), HashOfReadings());
    }
    for (const std::string& type : GetRobot()->ActuatorTypes())
    {
      const std::uint64_t tick = GetRobot()->GetTick();
      const bool is_gripper = type.find("gripper") != std::string::npos;
      if (tick < kFirstDrive && !is_gripper) continue;
      std::vector<double> values;
      for (const CCI_Column& column : GetRobot()->GetActuator(type)->Columns())
      {
        const double low = std::max(column.minimum, -1.0);
        const double high = std::isfinite(column.maximum) ? column.maximum : column.unit == "rad/s" ? 10 : 1;
        const std::uint64_t step = tick / 16 * 7 + values.size() * (tick / 48) * 3 + 4;
        const double part = is_gripper && tick < kLetsGo ? 1 : static_cast<double>(step % 5) / 4;
        const double value = low + part * (high - low);
        const bool is_whole = column.unit == "colour" || column.unit == "yes/no";
        values.push_back(is_whole ? std::floor(value) : value);
      }
      GetRobot()->GetActuator(type)->SetColumns(values);
    }
  }
};
REGISTER_CONTROLLER(CResultsReader, kReader)

std::string ResultOf(const SmallScene& scene)
{
  const std::unique_ptr<Experiment> experiment = Read(scene);
  if (experiment == nullptr) return "";
  HashOfReadings() = 0;
  SimulatorOptions options;
  options.threads = 1;
  CSimulator simulator(*experiment, options);
  while (simulator.Step()) continue;
  const std::uint64_t hash = simulator.Finish().hash;
  return fmt::format("{:016x}", XXH3_64bits_withSeed(&hash, sizeof hash, HashOfReadings()));
}

// A robot stands before a prey, with another one at its back, a third one that pushes a prey along a wall, and
// something for each sense.
std::string ArenaOf(EntityKind robot, const PluginDescription& engine)
{
  const double near = NearDistance(robot, robot);
  std::string arena = EntityElement(robot, "robot", kRobotX_m, kRobotY_m, "c") +
                      EntityElement(robot, "second", kRobotX_m - near, kRobotY_m + 0.03, "c") +
                      EntityElement(EntityKind::kLightBulb, "lamp", kRobotX_m + 0.5, kRobotY_m + 1) +
                      EntityElement(EntityKind::kGroundPatch, "patch", kRobotX_m + 0.1, kRobotY_m);
  constexpr double kPrey_m = 0.1;  // radius
  const double within_reach = NearDistance(robot, EntityKind::kCylindricPrey) - 0.12;
  const double before_wall = kRobotX_m + 2;
  if (Simulates(engine, EntityKind::kCylindricPrey))
    arena += EntityElement(EntityKind::kCylindricPrey, "prey", kRobotX_m + within_reach, kRobotY_m) +
             EntityElement(EntityKind::kCylindricPrey, "pushed", before_wall + within_reach + 0.05, kRobotY_m + 0.05);
  if (Simulates(engine, EntityKind::kWall))
    arena += EntityElement(robot, "third", before_wall, kRobotY_m, "c") +
             fmt::format(
                 "<wall id='wall' position='{},{},0.1' orientation='20,0,0' size='0.1,2,0.2' friction='0.1' "
                 "restitution='0.6'/>",
                 before_wall + within_reach + kPrey_m + 0.2, kRobotY_m);
  if (Simulates(engine, EntityKind::kBlock))
    arena += EntityElement(EntityKind::kBlock, "block", kRobotX_m, kRobotY_m - 0.6);
  return arena;
}

std::map<std::string, std::string> AllResults()
{
  std::map<std::string, std::string> results;
  for (const PluginDescription* engine : AllEngines())
    for (const EntityKind robot : AllRobots())
    {
      if (!Simulates(*engine, robot)) continue;
      const std::string arena = ArenaOf(robot, *engine);
      const auto add = [&](const std::string& what, const Devices& devices)
      {
        const std::string name = fmt::format("{}, {}", engine->label, what);
        SCOPED_TRACE(name);
        if (!results.contains(name))
          results[name] = ResultOf(
              {.engine = engine->label, .devices = devices, .arena = arena, .controller = kReader, .ticks = 200});
      };
      for (const Devices& devices : DeviceSets(robot, *engine))
      {
        add(fmt::format("{}", TagName(robot)), devices);
        for (const PluginDescription* sensor : devices.sensors)
          add(fmt::format("sensor {} ({})", sensor->label, sensor->implementation), {{sensor}, {}});
        for (const PluginDescription* actuator : devices.actuators)
          add(fmt::format("actuator {} ({})", actuator->label, actuator->implementation), {{}, {actuator}});
      }
    }
  return results;
}

std::map<std::string, std::string> ReadTable()
{
  std::map<std::string, std::string> table;
  std::ifstream file(kTable);
  for (std::string line; std::getline(file, line);)
  {
    const std::size_t middle = line.find("\" = \"");
    if (line.starts_with('"') && middle != std::string::npos)
      table[line.substr(1, middle - 1)] = line.substr(middle + 5, 16);
  }
  return table;
}

TEST(Results, OfSmallScenesAreThoseOfTheTable)
{
  const std::map<std::string, std::string> results = AllResults();
  if (std::getenv("SWARMANOID_WRITE_RESULTS") != nullptr)
  {
    std::ofstream file(kTable);
    file << kAbout;
    for (const auto& [name, hash] : results) file << fmt::format("\"{}\" = \"{}\"\n", name, hash);
  }
  const std::map<std::string, std::string> table = ReadTable();
  for (const auto& [name, hash] : results)
  {
    const auto row = table.find(name);
    EXPECT_EQ(row == table.end() ? "no row" : row->second, hash) << "the result of '" << name << "' changed";
  }
  for (const auto& [name, hash] : table)
    EXPECT_TRUE(results.contains(name)) << "no scene is '" << name << "', which tests/results/scenes.toml has";
}

}  // namespace
}  // namespace swarmanoid

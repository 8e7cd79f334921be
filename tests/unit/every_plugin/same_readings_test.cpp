// The devices that exchange values with an engine read and do the same in all three engines, within what the engines
// say of themselves: one has no masses, one no height.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "common/control_interface/ci_controller.h"
#include "common/experiment/load_experiment.h"
#include "common/space/space.h"
#include "simulation/simulator.h"
#include "test_folders.h"
#include "tests/unit/every_plugin/small_scene.h"
#include "tests/world/experiment_text.h"

namespace swarmanoid
{
namespace
{

constexpr int kTicksOfScene = 20;
constexpr std::uint64_t kFirstPull = 3;  // grippers close before wheels turn

struct Device
{
  std::string label, implementation;
  std::vector<double> told{};  // actuators: their columns
};

struct CarryingRobot
{
  std::string id, tag, position, orientation;
  std::vector<Device> actuators, sensors;
};

// The expected reading of the last tick, equal within a tolerance in each engine that serves the device. `value` is the
// known value.
struct Reading
{
  std::string robot, sensor, column;
  double value, tolerance;
};

const double kFullSpeed = 0.3 / 0.029112741;              // rad/s of a wheel
constexpr double kWheelForce = 0.8 * 1.6 * 9.81;          // N: what the wheels of a footbot exert
constexpr double kFullTraction = kWheelForce / 25;        // of 25 N
constexpr double kFullTorque = kWheelForce * 0.07 / 1.5;  // of 1.5 N m

const std::vector<CarryingRobot>& Robots()
{
  const Device gripper{"footbot_gripper", "dummy_footbot_gripper", {1}};
  const auto wheels = [](double left, double right) {
    return Device{"footbot_wheels", "dummy_footbot_wheels", {left, right}};
  };
  const std::vector<Device> grip_sensors = {{"footbot_turret_torque", "engine_footbot_turret_torque"},
                                            {"footbot_gripper", "generic_footbot_gripper"}};
  static const std::vector<CarryingRobot> robots = {
      {"driver",
       "footbot",
       "1,1,0",
       "0,0,0",
       {wheels(3, 5)},
       {{"footbot_encoders", "engine_footbot_encoders"},
        {"footbot_accelerometer", "engine_footbot_accelerometer"},
        {"positioning", "generic_positioning"}}},
      // Two pull at one prey, and two would turn another one in opposite directions.
      {"puller", "footbot", "3.8,4,0", "0,0,0", {gripper, wheels(-kFullSpeed, -kFullSpeed)}, grip_sensors},
      {"puller_2", "footbot", "4.2,4,0", "0,0,180", {gripper, wheels(-kFullSpeed, -kFullSpeed)}, grip_sensors},
      {"turner", "footbot", "3.8,8,0", "0,0,0", {gripper, wheels(-kFullSpeed, kFullSpeed)}, grip_sensors},
      {"turner_2", "footbot", "4.2,8,0", "0,0,180", {gripper, wheels(kFullSpeed, -kFullSpeed)}, grip_sensors},
      {"turret",
       "footbot",
       "8,1,0",
       "0,0,0",
       {{"footbot_turret", "dummy_footbot_turret", {0.5}}},
       {{"footbot_turret_encoder", "generic_footbot_turret_encoder"}}},
      {"arms",
       "handbot",
       "8,4,0",
       "0,0,0",
       {{"handbot_head", "dummy_handbot_head", {0.2}},
        {"handbot_arms", "dummy_handbot_arms", {0.3, 0.2, 0.2, 0.1}},
        {"handbot_hands", "dummy_handbot_hands", {1, 0}}},
       {{"handbot_joints", "generic_handbot_joints"}}},
      {"climber",
       "handbot",
       "8,6,0",
       "0,0,0",
       {{"handbot_rope", "dummy_handbot_rope", {1, 0}}},
       {{"handbot_joints", "generic_handbot_joints"}}},
      {"flyer",
       "eyebot",
       "8,9,0",
       "0,0,0",
       {{"eyebot_propellers", "dummy_eyebot_propellers", {0.3, 0.1, 0.2, 0.25}},
        {"eyebot_attachment", "dummy_eyebot_attachment", {1}}},
       {{"positioning", "generic_positioning"}, {"gyroscope", "generic_gyroscope"}}},
      {"epuck",
       "epuck",
       "1,9,0",
       "0,0,90",
       {{"wheels", "generic_wheels", {4, 4}}},
       {{"positioning", "generic_positioning"}}}};
  return robots;
}

const std::vector<Reading>& Readings()
{
  constexpr double kSeconds = 0.1 * (kTicksOfScene - 1);  // the last step reads what 19 ticks did
  static const std::vector<Reading> readings = {
      {"driver", "footbot_encoders", "left", 3, 0.1},
      {"driver", "footbot_encoders", "right", 5, 0.1},
      {"driver", "footbot_accelerometer", "forward", 0, 0.05},
      {"driver", "footbot_accelerometer", "left", 4 * 0.029112741 * 2 * 0.029112741 / 0.14, 0.02},
      {"driver", "footbot_accelerometer", "up", 9.81, 0.05},
      {"puller", "footbot_turret_torque", "forward traction", kFullTraction, 0.06},
      {"puller", "footbot_turret_torque", "left traction", 0, 0.05},
      {"puller", "footbot_turret_torque", "torque", 0, 0.05},
      {"puller_2", "footbot_turret_torque", "forward traction", kFullTraction, 0.06},
      {"puller", "footbot_gripper", "aperture", 0, 1e-9},
      {"puller", "footbot_gripper", "gripping", 1, 0},
      {"turner", "footbot_turret_torque", "torque", -kFullTorque, 0.1},
      {"turner_2", "footbot_turret_torque", "torque", kFullTorque, 0.1},
      {"turret", "footbot_turret_encoder", "angle", 0.5 * kSeconds, 0.01},
      {"arms", "handbot_joints", "head", 0.2 * kSeconds, 0.03},
      {"arms", "handbot_joints", "left arm", 0.3 * kSeconds, 0.03},
      {"arms", "handbot_joints", "right arm", 0.2 * kSeconds, 0.03},
      {"arms", "handbot_joints", "left wrist", 0.2 * kSeconds, 0.03},
      {"arms", "handbot_joints", "right wrist", 0.1 * kSeconds, 0.03},
      {"arms", "handbot_joints", "left hand", 0, 1e-9},
      {"arms", "handbot_joints", "left hand holds", 0, 0},
      {"climber", "handbot_joints", "rope attached", 1, 0},
      {"climber", "handbot_joints", "rope length", 3 - 0.16, 0.05},
      {"flyer", "gyroscope", "yaw", 0.25, 0.02},
      {"epuck", "positioning", "y", 9 + 4 * 0.0205 * kSeconds, 0.02}};
  return readings;
}

std::map<std::string, double>& Seen()
{
  static std::map<std::string, double> seen;
  return seen;
}

class CSameReadingsProbe : public CCI_Controller
{
public:
  int Init(const TConfigurationTree) override { return RETURN_OK; }
  void ControlStep() override
  {
    const std::string& id = GetRobot()->GetId();
    const auto& robot = *std::ranges::find(Robots(), id, &CarryingRobot::id);
    for (const Device& device : robot.actuators)
      if (GetRobot()->HasActuator(device.label) &&
          (device.label != "footbot_wheels" || robot.actuators.size() == 1 || GetRobot()->GetTick() >= kFirstPull))
        GetRobot()->GetActuator(device.label)->SetColumns(device.told);
    for (const std::string& type : GetRobot()->SensorTypes())
    {
      const CCI_Sensor& sensor = *GetRobot()->GetSensor(type);
      const std::vector<CCI_Column> columns = sensor.Columns();
      std::vector<double> values;
      sensor.ReadColumns(values);
      for (std::size_t i = 0; i < columns.size(); ++i) Seen()[id + "." + type + "." + columns[i].name] = values.at(i);
    }
  }
};
REGISTER_CONTROLLER(CSameReadingsProbe, "same_readings_probe")

// The readings of the last tick in an engine, without devices that it does not serve.
std::map<std::string, double> SeenIn(const PluginDescription& engine, const std::string& parameters)
{
  const auto is_served = [&](PluginKind kind, const Device& device)
  {
    const std::string& channel = PluginCatalogue::Instance().Find(kind, device.label, device.implementation)->channel;
    return channel.empty() || std::ranges::find(engine.channels, channel) != engine.channels.end();
  };
  test::ExperimentText text{.framework = fmt::format("<maxclock>{}</maxclock><plugin_path>{}</plugin_path>",
                                                     kTicksOfScene, SWARMANOID_BUILD_FOLDER "/lib/swarmanoid"),
                            .kinds = "<epuck library='epuck'/>",
                            .size = "12,12,3",
                            .engines = fmt::format("<{} id='e'{}/>", engine.label, parameters)};
  for (const CarryingRobot& robot : Robots())
  {
    const auto served = [&](PluginKind kind, const std::vector<Device>& devices)
    {
      std::vector<std::string> names;
      for (const Device& device : devices)
        if (is_served(kind, device)) names.push_back(device.implementation);
      return names;
    };
    text.controllers += test::Controller({.tag = "same_readings_probe",
                                          .id = robot.id,
                                          .actuators = served(PluginKind::kActuator, robot.actuators),
                                          .sensors = served(PluginKind::kSensor, robot.sensors)});
    text.arena += fmt::format("<{} id='{}' position='{}' orientation='{}' controller='{}'/>", robot.tag, robot.id,
                              robot.position, robot.orientation, robot.id);
  }
  for (const char* y : {"4", "8"})
    text.arena +=
        fmt::format("<cylindric_prey id='prey_{0}' position='4,{0},0' radius='0.1' height='0.1' mass='0.5'/>", y);
  const auto experiment = text.Load();
  Seen().clear();
  if (experiment != nullptr)
  {
    CSimulator simulator(*experiment, {});
    while (simulator.Step()) continue;
    simulator.Finish();
  }
  return Seen();
}

TEST(SameReadings, DevicesOfEnginesAgreeInSignAndSizeInAllThree)
{
  RegisterEverything();
  const std::vector<std::pair<std::string, std::string>> engines = {
      {"kinematics2d", ""}, {"dynamics2d", ""}, {"dynamics3d", " ceiling='true'"}};
  for (const auto& [label, parameters] : engines)
  {
    const PluginDescription& engine = *PluginCatalogue::Instance().Find(PluginKind::kEngine, label);
    const std::map<std::string, double> seen = SeenIn(engine, parameters);
    for (const Reading& reading : Readings())
    {
      const std::string name = reading.robot + "." + reading.sensor + "." + reading.column;
      const auto found = seen.find(name);
      if (found == seen.end())
      {
        EXPECT_EQ(reading.sensor, "footbot_accelerometer") << name << " is not read in " << label;
        continue;
      }
      EXPECT_NEAR(found->second, reading.value, reading.tolerance) << name << " in " << label;
    }
  }
}

TEST(SameReadings, EachDeviceOfAnEngineIsInTheScene)
{
  RegisterEverything();
  std::set<std::string> met;
  for (const CarryingRobot& robot : Robots())
  {
    for (const Device& device : robot.actuators) met.insert("actuator " + device.label);
    for (const Device& device : robot.sensors) met.insert("sensor " + device.label);
  }
  for (const PluginKind kind : {PluginKind::kSensor, PluginKind::kActuator})
    for (const PluginDescription* device : PluginCatalogue::Instance().Of(kind))
    {
      if (device->channel.empty()) continue;
      EXPECT_TRUE(met.contains(fmt::format("{} {}", PluginKindName(kind), device->label)))
          << NameOfPlugin(kind, device->label, device->implementation)
          << " exchanges values with engines: add it to Robots() and what it reads to Readings()";
    }
}

}  // namespace
}  // namespace swarmanoid

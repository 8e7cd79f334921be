// The devices that exchange values with an engine have equal readings and effects in all three engines, within the
// stated limits of the engines: one has no masses, one no height.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "common/control_interface/ci_controller.h"
#include "common/experiment/load_experiment.h"
#include "common/math/elementary.h"
#include "common/plugin_descriptions/engine_differences.h"
#include "common/space/space.h"
#include "simulation/simulator.h"
#include "space_server/experiment_functions.h"
#include "test_folders.h"
#include "tests/unit/engines/jointed_robots.h"
#include "tests/unit/every_plugin/small_scene.h"
#include "tests/world/experiment_text.h"
#include "tests/world/temporary_folder.h"

namespace swarmanoid
{
namespace
{

constexpr int kTicksOfScene = 20;
constexpr double kSeconds = 0.1 * (kTicksOfScene - 1);  // the last step reads what 19 ticks did
constexpr double kCeiling_m = 3;

// A device, and what a robot tells it from tick `from` until tick `until`.
struct Device
{
  std::string label, implementation;
  std::vector<double> told{};  // actuators: their columns
  std::uint64_t from = 0, until = kTicksOfScene;
  std::string parameters{};
};

struct CarryingRobot
{
  std::string id, tag, position, orientation;
  std::vector<Device> actuators, sensors;
  bool at_ceiling = false;
};

// A value after the last tick: "ROBOT.SENSOR.COLUMN", or "ENTITY.x", "ENTITY.y", "ENTITY.z" (m, of the position), or
// "ENTITY.ATTRIBUTE". Engines agree with `value` within `tolerance`, except those of `others`, whose difference stands
// in the table EngineDifferences.
struct Reading
{
  std::string name;
  double value, tolerance;
  std::string channel;  // of the device whose effect it is
  std::map<std::string, double> others{};
};

constexpr double kWheelRadius_m = 0.029112741;
constexpr double kFullSpeed = 0.3 / kWheelRadius_m;       // rad/s of a wheel
constexpr double kWheelForce = 0.8 * 1.6 * 9.81;          // N: what the wheels of a footbot exert
constexpr double kFullTraction = kWheelForce / 25;        // as a fraction of 25 N
constexpr double kFullTorque = kWheelForce * 0.07 / 1.5;  // as a fraction of 1.5 N m
constexpr double kDragged = 0.5 * 0.5 * 9.81 / 25;        // the friction of a prey of 0.5 kg, as a fraction of 25 N
constexpr std::uint64_t kFirstPull = 3;                   // grippers close before wheels turn
constexpr double kPullSeconds = 0.1 * (kTicksOfScene - kFirstPull);

Device Wheels(double left, double right, std::uint64_t from = 0)
{
  return {"footbot_wheels", "dummy_footbot_wheels", {left, right}, from};
}

const std::vector<CarryingRobot>& Robots()
{
  const Device gripper{"footbot_gripper", "dummy_footbot_gripper", {1}};
  const Device pull = Wheels(-kFullSpeed, -kFullSpeed, kFirstPull);
  const std::vector<Device> encoders = {{"footbot_encoders", "engine_footbot_encoders"}};
  const std::vector<Device> grip_sensors = {{"footbot_turret_torque", "engine_footbot_turret_torque"},
                                            {"footbot_gripper", "generic_footbot_gripper"},
                                            {"footbot_turret_encoder", "generic_footbot_turret_encoder"}};
  const std::vector<Device> joints = {{"handbot_joints", "generic_handbot_joints"}};
  // The last two drive on, across their turrets.
  const auto across = [&](double turn) -> std::vector<Device>
  {
    return {{"footbot_turret", "dummy_footbot_turret", {turn}, 0, 5},
            {"footbot_gripper", "dummy_footbot_gripper", {1}, 6},
            Wheels(kFullSpeed, kFullSpeed, 8)};
  };
  static const std::vector<CarryingRobot> robots = {
      {"driver",
       "footbot",
       "1,1,0",
       "0,0,0",
       {Wheels(3, 5)},
       {encoders[0], {"footbot_accelerometer", "engine_footbot_accelerometer"}}},
      {"backer", "footbot", "3,1,0", "0,0,90", {Wheels(-4, 2)}, encoders},
      // Two pull at one prey, and two would turn another one in opposite directions.
      {"puller", "footbot", "3.8,4,0", "0,0,0", {gripper, pull}, grip_sensors},
      {"puller_2", "footbot", "4.2,4,0", "0,0,180", {gripper, pull}, grip_sensors},
      {"turner", "footbot", "3.8,8,0", "0,0,0", {gripper, Wheels(-kFullSpeed, kFullSpeed, kFirstPull)}, grip_sensors},
      {"turner_2",
       "footbot",
       "4.2,8,0",
       "0,0,180",
       {gripper, Wheels(kFullSpeed, -kFullSpeed, kFirstPull)},
       grip_sensors},
      // Two in the west and the east push and pull a prey to the west, two in the north and the south to the east.
      {"west", "footbot", "5.8,6,0", "0,0,0", {gripper, Wheels(-kFullSpeed, -kFullSpeed, 8)}, grip_sensors},
      {"east", "footbot", "6.2,6,0", "0,0,180", {gripper, Wheels(kFullSpeed, kFullSpeed, 8)}, grip_sensors},
      {"south", "footbot", "6,5.795,0", "0,0,0", across(kPi), grip_sensors},
      {"north", "footbot", "6,6.205,0", "0,0,0", across(-kPi), grip_sensors},
      // They drag what they hold.
      {"dragger", "footbot", "3.8,2,0", "0,0,0", {gripper, pull}, grip_sensors},
      {"box_dragger", "footbot", "6.8,2,0", "0,0,0", {gripper, pull}, grip_sensors},
      {"robot_dragger", "footbot", "9.8,2,0", "0,0,0", {gripper, pull}, grip_sensors},
      {"dragged", "footbot", "10,2,0", "0,0,0", {}, {}},
      // A gripper reaches 12 cm from the axis of its turret.
      {"near_reach", "footbot", "1.785,5,0", "0,0,0", {gripper}, grip_sensors},
      {"far_reach", "footbot", "1.775,6,0", "0,0,0", {gripper}, grip_sensors},
      {"turret",
       "footbot",
       "8,1,0",
       "0,0,0",
       {{"footbot_turret", "dummy_footbot_turret", {-0.5}}},
       {{"footbot_turret_encoder", "generic_footbot_turret_encoder"}}},
      {"quick_turret",
       "footbot",
       "9,1,0",
       "0,0,0",
       {{"footbot_turret", "dummy_footbot_turret", {6}, 0, 5, "max_speed='10'"}},
       {{"footbot_turret_encoder", "generic_footbot_turret_encoder"}}},
      {"loaded_turret",
       "footbot",
       "1.8,8,0",
       "0,0,0",
       {gripper, {"footbot_turret", "dummy_footbot_turret", {0.5}, kFirstPull}},
       grip_sensors},
      {"arms",
       "handbot",
       "8,4,0",
       "0,0,0",
       {{"handbot_head", "dummy_handbot_head", {-0.2}},
        {"handbot_arms", "dummy_handbot_arms", {0.3, 0.2, 0.2, 0.1}},
        {"handbot_hands", "dummy_handbot_hands", {1, 0}}},
       joints},
      {"wide_arms",
       "handbot",
       "10,4,0",
       "0,0,0",
       {{"handbot_arms", "dummy_handbot_arms", {1, -1, 1, -1}}, {"handbot_hands", "dummy_handbot_hands", {0, 0}}},
       joints},
      {"climber", "handbot", "8,6,0", "0,0,0", {{"handbot_rope", "dummy_handbot_rope", {1, -0.1}}}, joints},
      {"lifter",
       "handbot",
       "10,6,0",
       "0,0,0",
       {{"handbot_hands", "dummy_handbot_hands", {1, 1}},
        {"handbot_rope", "dummy_handbot_rope", {1, -0.1}, kFirstPull}},
       joints},
      {"flyer",
       "eyebot",
       "8,9,0",
       "0,0,0",
       {{"eyebot_propellers", "dummy_eyebot_propellers", {0.3, 0.1, 0.2, 0.25}}},
       {{"gyroscope", "generic_gyroscope"}}},
      {"hanger",
       "eyebot",
       "2,10,2.42",
       "0,0,0",
       {{"eyebot_propellers", "dummy_eyebot_propellers", {0.3, 0, 0, 0}},
        {"eyebot_attachment", "dummy_eyebot_attachment", {1}}},
       {},
       true},
      // It flies against the hanger.
      {"pusher",
       "eyebot",
       "1.4,10,2.42",
       "0,0,0",
       {{"eyebot_propellers", "dummy_eyebot_propellers", {0.3, 0, 0, 0}}},
       {},
       true},
      {"leaver",
       "eyebot",
       "6,10,2.42",
       "0,0,0",
       {{"eyebot_propellers", "dummy_eyebot_propellers", {0.3, 0, 0, 0}},
        {"eyebot_attachment", "dummy_eyebot_attachment", {1}, 0, 10}},
       {},
       true},
      {"epuck", "epuck", "1,10,0", "0,0,90", {{"wheels", "generic_wheels", {4, 4}}}, {}},
      // Of the lift, the shoulder and the elbow.
      {"carrier",
       "test_cart_with_arm",
       "4,10,0",
       "0,0,0",
       {{"joints", "generic_joints", {0.15, 1, -0.5}}},
       {{"joints", "generic_joints"}}}};
  return robots;
}

constexpr const char* kThings = R"(
  <cylindric_prey id='prey_4' position='4,4,0' radius='0.1' height='0.1' mass='0.5'/>
  <cylindric_prey id='prey_8' position='4,8,0' radius='0.1' height='0.1' mass='0.5'/>
  <cylindric_prey id='prey_6' position='6,6,0' radius='0.1' height='0.1' mass='0.5'/>
  <cylindric_prey id='dragged_prey' position='4,2,0' radius='0.1' height='0.1' mass='0.5'/>
  <block id='dragged_box' movable='true' position='7,2,0.1' size='0.2,0.2,0.2' mass='0.5'/>
  <cylindric_prey id='near_prey' position='2,5,0' radius='0.1' height='0.1' mass='0.5'/>
  <cylindric_prey id='far_prey' position='2,6,0' radius='0.1' height='0.1' mass='0.5'/>
  <cylindric_prey id='turned_prey' position='2,8,0' radius='0.1' height='0.1' mass='0.5'/>
  <block id='lifted_box' movable='true' position='10.31,6,0.1' size='0.1,0.16,0.2' mass='0.02'/>)";

const std::vector<Reading>& Readings()
{
  constexpr double kEpuckWheel_m = 0.0205;
  static const std::vector<Reading> readings = {
      {"driver.footbot_encoders.left", 3, 0.1, "footbot_encoders"},
      {"driver.footbot_encoders.right", 5, 0.1, "footbot_encoders"},
      {"backer.footbot_encoders.left", -4, 0.1, "footbot_encoders"},
      {"backer.footbot_encoders.right", 2, 0.1, "footbot_encoders"},
      {"driver.footbot_accelerometer.forward", 0, 0.05, "footbot_accelerometer"},
      {"driver.footbot_accelerometer.left", 4 * kWheelRadius_m * 2 * kWheelRadius_m / 0.14, 0.02,
       "footbot_accelerometer"},
      {"driver.footbot_accelerometer.up", 9.81, 0.05, "footbot_accelerometer"},
      // Along its arc of 0.28 m the driver turns by 0.79 rad.
      {"driver.x", 1.2, 0.01, "footbot_wheels"},
      {"driver.y", 1.083, 0.01, "footbot_wheels"},

      {"puller.footbot_turret_torque.forward traction", kFullTraction, 0.06, "footbot_turret_torque"},
      {"puller.footbot_turret_torque.left traction", 0, 0.05, "footbot_turret_torque"},
      {"puller.footbot_turret_torque.torque", 0, 0.05, "footbot_turret_torque"},
      {"puller_2.footbot_turret_torque.forward traction", kFullTraction, 0.06, "footbot_turret_torque"},
      {"turner.footbot_turret_torque.torque", -kFullTorque, 0.1, "footbot_turret_torque"},
      {"turner_2.footbot_turret_torque.torque", kFullTorque, 0.1, "footbot_turret_torque"},
      {"west.footbot_turret_torque.forward traction", kFullTraction, 0.06, "footbot_turret_torque"},
      {"east.footbot_turret_torque.forward traction", -kFullTraction, 0.06, "footbot_turret_torque"},
      {"south.footbot_turret_torque.left traction", kFullTraction, 0.06, "footbot_turret_torque"},
      {"north.footbot_turret_torque.left traction", -kFullTraction, 0.06, "footbot_turret_torque"},
      {"south.footbot_turret_torque.forward traction", 0, 0.06, "footbot_turret_torque"},
      {"dragger.footbot_turret_torque.forward traction",
       kDragged,
       0.015,
       "footbot_turret_torque",
       {{"kinematics2d", 0}}},

      {"puller.footbot_gripper.aperture", 0, 1e-9, "footbot_gripper"},
      {"puller.footbot_gripper.gripping", 1, 0, "footbot_gripper"},
      {"dragged_prey.x", 4 - 0.3 * kPullSeconds, 0.04, "footbot_gripper"},
      {"dragged_box.x", 7 - 0.3 * kPullSeconds, 0.04, "footbot_gripper"},
      {"robot_dragger.footbot_gripper.gripping", 1, 0, "footbot_gripper", {{"kinematics2d", 0}}},
      {"near_reach.footbot_gripper.gripping", 1, 0, "footbot_gripper"},
      {"far_reach.footbot_gripper.gripping", 0, 0, "footbot_gripper"},

      {"turret.footbot_turret_encoder.angle", -0.5 * kSeconds, 0.01, "footbot_turret"},
      {"quick_turret.footbot_turret_encoder.angle", 6 * 0.5, 0.01, "footbot_turret"},
      {"loaded_turret.footbot_turret_encoder.angle",
       0.5 * (kPullSeconds - 0.1),
       0.03,
       "footbot_turret",
       {{"kinematics2d", 0}}},
      // The friction of the load on its way around the robot.
      {"loaded_turret.footbot_turret_torque.left traction", -kDragged, 0.06, "footbot_turret", {{"kinematics2d", 0}}},
      {"loaded_turret.footbot_turret_torque.torque", -0.35, 0.08, "footbot_turret", {{"kinematics2d", 0}}},

      {"arms.handbot_joints.head", -0.2 * kSeconds, 0.03, "handbot_arms"},
      {"arms.handbot_joints.left arm", 0.3 * kSeconds, 0.03, "handbot_arms"},
      {"arms.handbot_joints.right arm", 0.2 * kSeconds, 0.03, "handbot_arms"},
      {"arms.handbot_joints.left wrist", 0.2 * kSeconds, 0.03, "handbot_arms"},
      {"arms.handbot_joints.right wrist", 0.1 * kSeconds, 0.03, "handbot_arms"},
      {"wide_arms.handbot_joints.left arm", kPi / 3, 0.03, "handbot_arms"},
      {"wide_arms.handbot_joints.right arm", 0, 0.03, "handbot_arms"},
      {"wide_arms.handbot_joints.left wrist", kPi / 2, 0.001, "handbot_arms"},
      {"wide_arms.handbot_joints.right wrist", 0, 0.001, "handbot_arms"},
      {"arms.handbot_joints.left hand", 0, 1e-9, "handbot_hands"},
      {"arms.handbot_joints.right hand", kPi, 1e-4, "handbot_hands"},
      {"arms.handbot_joints.left hand holds", 0, 0, "handbot_hands"},
      {"lifter.handbot_joints.left hand holds", 1, 0, "handbot_hands"},
      {"lifter.handbot_joints.right hand holds", 1, 0, "handbot_hands"},
      {"lifted_box.z", 0.1 + 0.1 * kPullSeconds, 0.03, "handbot_hands"},

      {"climber.handbot_joints.rope attached", 1, 0, "handbot_rope"},
      {"climber.handbot_joints.rope length", kCeiling_m - 0.16 - 0.1 * kSeconds, 0.03, "handbot_rope"},
      {"climber.z", 0.1 * kSeconds, 0.03, "handbot_rope"},

      {"flyer.gyroscope.yaw", 0.25, 0.02, "eyebot_propellers"},
      {"flyer.x", 8.55, 0.2, "eyebot_propellers"},
      {"flyer.y", 9.32, 0.2, "eyebot_propellers"},
      {"flyer.z", 0.2 * kSeconds, 0.1, "eyebot_propellers", {{"kinematics2d", 0}, {"dynamics2d", 0}}},
      {"hanger.attached", 1, 0, "eyebot_attach"},
      {"hanger.x", 2, 0.01, "eyebot_attach", {{"kinematics2d", 2.26}, {"dynamics2d", 2.024}}},
      {"leaver.attached", 0, 0, "eyebot_attach"},
      {"leaver.x", 6 + 0.3 * 0.9, 0.15, "eyebot_attach"},
      {"epuck.y", 10 + 4 * kEpuckWheel_m * kSeconds, 0.02, "wheels"},
      {"carrier.joints.lift position", 0.15, 0.005, "joints"},
      {"carrier.joints.shoulder position", 1, 0.03, "joints"},
      {"carrier.joints.elbow position", -0.5, 0.01, "joints"},
      {"carrier.joints.lift velocity", 0, 0.01, "joints"}};
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
      if (GetRobot()->HasActuator(device.label))
      {
        const bool is_told = GetRobot()->GetTick() >= device.from && GetRobot()->GetTick() < device.until;
        const std::vector<double> rest(device.told.size(), 0.0);
        GetRobot()->GetActuator(device.label)->SetColumns(is_told ? device.told : rest);
      }
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

const std::string& ChannelOf(PluginKind kind, const Device& device)
{
  return PluginCatalogue::Instance().Find(kind, device.label, device.implementation)->channel;
}

struct Engine
{
  std::string label, of_ground, of_ceiling;  // its parameters
};

const std::vector<Engine>& Engines()
{
  static const std::vector<Engine> engines = {{"kinematics2d", "", "distance='2.42'"},
                                              {"dynamics2d", "", "distance='2.42'"},
                                              {"dynamics3d", "ceiling='true'", "ceiling='true'"}};
  return engines;
}

bool Serves(const std::string& engine, const std::string& channel)
{
  const PluginDescription& plugin = *PluginCatalogue::Instance().Find(PluginKind::kEngine, engine);
  return channel.empty() || std::ranges::find(plugin.channels, channel) != plugin.channels.end();
}

// Returns the values after the last tick in an engine. Devices of channels that it does not serve, and those of the
// channel `without`, are left out. `change` is called before each tick.
std::map<std::string, double> SeenIn(const Engine& engine, const std::string& without = "none",
                                     const std::function<void(CSimulator&)>& change = {})
{
  static const test::TemporaryFolder folder;
  static const std::string cart =
      folder.Write("cart.urdf", "<robot name='r'>\n" + test::LinksOfCartWithArm() + "</robot>");
  test::ExperimentText text{.framework = fmt::format("<maxclock>{}</maxclock><plugin_path>{}</plugin_path>",
                                                     kTicksOfScene, SWARMANOID_BUILD_FOLDER "/lib/swarmanoid"),
                            .kinds = "<epuck library='epuck'/><test_cart_with_arm urdf='" + cart + "'/>",
                            .size = fmt::format("12,12,{}", kCeiling_m),
                            .arena = kThings,
                            .engines = fmt::format("<{0} id='ground' {1}/><{0} id='ceiling' {2}/>", engine.label,
                                                   engine.of_ground, engine.of_ceiling)};
  std::string on_ground, at_ceiling;
  for (const CarryingRobot& robot : Robots())
  {
    const auto served = [&](PluginKind kind, const std::vector<Device>& devices)
    {
      std::vector<std::string> names;
      for (const Device& device : devices)
        if (const std::string& channel = ChannelOf(kind, device); Serves(engine.label, channel) && channel != without)
          names.push_back(device.implementation + " " + device.parameters);
      return names;
    };
    text.controllers += test::Controller({.tag = "same_readings_probe",
                                          .id = robot.id,
                                          .actuators = served(PluginKind::kActuator, robot.actuators),
                                          .sensors = served(PluginKind::kSensor, robot.sensors)});
    text.arena += fmt::format("<{} id='{}' position='{}' orientation='{}' controller='{}'/>", robot.tag, robot.id,
                              robot.position, robot.orientation, robot.id);
    (robot.at_ceiling ? at_ceiling : on_ground) += fmt::format("<entity id='{}'/>", robot.id);
  }
  text.physics = fmt::format(
      "<engine id='ground'>{}<all kind='cylindric_prey'/><all kind='block'/></engine><engine id='ceiling'>{}</engine>",
      on_ground, at_ceiling);
  const auto experiment = text.Load();
  Seen().clear();
  if (experiment == nullptr) return {};
  CSimulator simulator(*experiment, {});
  do {
    if (change) change(simulator);
  } while (simulator.Step());
  const CSwarmanoidSpace& space = simulator.GetSpace();
  for (std::uint32_t k = 0; k < space.Size(); ++k)
  {
    const CSwarmanoidSpaceEntity& entity = space.GetEntity(k);
    const Vector3& position = space.GetPose(k).position;
    Seen()[entity.GetId() + ".x"] = position.x();
    Seen()[entity.GetId() + ".y"] = position.y();
    Seen()[entity.GetId() + ".z"] = position.z();
    if (entity.GetKind() == EntityKind::kEyebot) Seen()[entity.GetId() + ".attached"] = entity.GetAttribute("attached");
  }
  simulator.Finish();
  return Seen();
}

// A reading that differs on purpose needs a row in the table of docs/engines.md, with another text for that engine.
TEST(SameReadings, EachDifferenceStandsInTheTable)
{
  for (const Reading& reading : Readings())
    for (const auto& [engine, value] : reading.others)
      EXPECT_TRUE(std::ranges::any_of(EngineDifferences(),
                                      [&](const EngineDifference& row)
                                      {
                                        const auto has = std::ranges::find(row.channels, reading.channel);
                                        const bool is_alike =
                                            row.kinematics2d == row.dynamics2d && row.dynamics2d == row.dynamics3d;
                                        return has != row.channels.end() && !is_alike && !row.In(engine).empty();
                                      }))
          << reading.name << " in " << engine;
}

TEST(SameReadings, TheTableOfDifferencesIsThatOfTheDocumentation)
{
  std::ifstream file(SWARMANOID_SOURCE_FOLDER "/docs/engines.md");
  const std::string page{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  std::string table;
  for (const EngineDifference& row : EngineDifferences())
    table += fmt::format("| {} | {} | {} | {} |\n", row.subject, row.kinematics2d, row.dynamics2d, row.dynamics3d);
  EXPECT_NE(page.find(table), std::string::npos) << "docs/engines.md needs this table:\n" << table;
}

double ExpectedIn(const Engine& engine, const Reading& reading)
{
  const auto other = reading.others.find(engine.label);
  return other == reading.others.end() ? reading.value : other->second;
}

TEST(SameReadings, DevicesOfEnginesAgreeInSignAndSizeInAllThree)
{
  RegisterEverything();
  for (const Engine& engine : Engines())
  {
    const std::map<std::string, double> seen = SeenIn(engine);
    for (const Reading& reading : Readings())
    {
      const auto found = seen.find(reading.name);
      if (found == seen.end())
        EXPECT_FALSE(Serves(engine.label, reading.channel)) << reading.name << " is not read in " << engine.label;
      else
        EXPECT_NEAR(found->second, ExpectedIn(engine, reading), reading.tolerance)
            << reading.name << " in " << engine.label;
    }
  }
}

// The scene above would not be a test of a device whose loss changes no reading.
TEST(SameReadings, AnEngineThatDropsADeviceReadsOtherwise)
{
  RegisterEverything();
  for (const Engine& engine : Engines())
    for (const std::string& channel : PluginCatalogue::Instance().Find(PluginKind::kEngine, engine.label)->channels)
    {
      const std::map<std::string, double> seen = SeenIn(engine, channel);
      const bool is_noticed = std::ranges::any_of(
          Readings(),
          [&](const Reading& reading)
          {
            if (reading.channel != channel) return false;
            const auto found = seen.find(reading.name);
            return found == seen.end() || std::abs(found->second - ExpectedIn(engine, reading)) > reading.tolerance;
          });
      EXPECT_TRUE(is_noticed) << "without " << channel << " all readings of the scene are the same in " << engine.label;
    }
}

TEST(SameReadings, ARobotThatIsMovedFromOutsideKeepsTheAnglesOfItsJoints)
{
  RegisterEverything();
  for (const Engine& engine : Engines())
  {
    const auto move = [](CSimulator& simulator)
    {
      if (simulator.GetSpace().GetTick() != kTicksOfScene / 2) return;
      simulator.GetEditor().MoveEntity("arms", {{8, 4.5, 0}, QuaternionFromYaw(1)});
      simulator.GetEditor().MoveEntity("turret", {{8, 2.5, 0}, QuaternionFromYaw(1)});
    };
    const std::map<std::string, double> seen = SeenIn(engine, "none", move);
    for (const Reading& reading : Readings())
    {
      if (!reading.name.starts_with("arms.") && !reading.name.starts_with("turret.")) continue;
      EXPECT_NEAR(seen.at(reading.name), reading.value, reading.tolerance) << reading.name << " in " << engine.label;
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

TEST(SameReadings, EnginesOfPlanesRefuseRobotsThatStandOnLinks)
{
  RegisterEverything();
  for (const Engine& engine : Engines())
  {
    const test::ExperimentText text{.kinds = "<hexapod urdf='" SWARMANOID_SOURCE_FOLDER "/configs/urdf/hexapod.urdf'/>",
                                    .arena = "<hexapod id='h' position='1,1,0'/>",
                                    .engines = "<" + engine.label + " id='e'/>"};
    const LoadedExperiment loaded = LoadExperimentText(text.Text(), "test.xml", "/nowhere", {});
    const std::string expected = "the hexapod 'h' stands on links that joints move, which the engine 'e' (" +
                                 engine.label + ") cannot move; use dynamics3d";
    const bool is_refused = std::ranges::any_of(
        loaded.errors, [&](const Diagnostic& error) { return error.message.find(expected) != std::string::npos; });
    EXPECT_EQ(is_refused, engine.label != "dynamics3d") << engine.label;
  }
}

}  // namespace
}  // namespace swarmanoid

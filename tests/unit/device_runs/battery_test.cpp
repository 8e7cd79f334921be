// Batteries that the parts of robots draw from, and charging stations (docs/batteries.md): closed forms, edges, and the
// same hash from a checkpoint.
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <map>

#include "common/checkpoint/checkpoint.h"
#include "common/control_interface/ci_battery_sensor.h"
#include "common/control_interface/ci_controller.h"
#include "common/control_interface/ci_led_ring_actuator.h"
#include "common/control_interface/ci_radio.h"
#include "common/control_interface/ci_range_and_bearing.h"
#include "common/control_interface/ci_wheels_actuator.h"
#include "common/control_interface/footbot/ci_footbot_gripper_actuator.h"
#include "common/space/battery_slots.h"
#include "common/space/drawn_shapes.h"
#include "common/space/space.h"
#include "controller_host/device.h"
#include "controller_host/devices/noise.h"
#include "controller_host/powered_device.h"
#include "simulation/register_all.h"
#include "simulation/simulator.h"
#include "space_server/experiment_functions.h"
#include "tests/world/experiment_text.h"

namespace swarmanoid
{
namespace
{

using testing::HasSubstr;

// Uses the devices that its robot has, in the same way at each step.
class CEnergyUser : public CCI_Controller
{
public:
  static inline std::map<std::string, int> steps;
  static inline std::vector<double> charges, times_left;  // as the robot a reads them
  static inline double speed_m_s = 0.1;

  int Init(const TConfigurationTree) override { return RETURN_OK; }
  void ControlStep() override
  {
    CCI_Robot& robot = *GetRobot();
    ++steps[robot.GetId()];
    if (robot.GetId() == "a")
    {
      const auto& battery = robot.Sensor<CCI_BatterySensor>("battery");
      charges.push_back(battery.GetCharge());
      times_left.push_back(battery.GetTimeLeft());
    }
    if (robot.HasActuator("wheels"))
      robot.Actuator<CCI_WheelsActuator>("wheels").SetLinearVelocity(speed_m_s, speed_m_s);
    if (robot.HasActuator("footbot_leds")) robot.Actuator<CCI_LedRingActuator>("footbot_leds").SetAllColours(0xff0000);
    if (robot.HasActuator("radio"))
      robot.Actuator<CCI_RadioActuator>("radio").Send(std::array<std::uint8_t, 7>{1, 2, 3, 4, 5, 6, 7});
    if (robot.HasActuator("range_and_bearing"))
      robot.Actuator<CCI_RangeAndBearingActuator>("range_and_bearing").SetMessage({1});
    if (robot.HasActuator("footbot_gripper")) robot.Actuator<CCI_FootBotGripperActuator>("footbot_gripper").Grip();
  }
  bool HasState() const override { return true; }
  void SaveState(std::ostream&) const override {}
  void LoadState(std::istream&) override {}
};
REGISTER_CONTROLLER(CEnergyUser, "battery_test")

// An actuator of one's own that draws 2 W.
class Heater : public ActuatorBatch, public PoweredDevice
{
public:
  void Init(const DeviceSetup& setup) override { devices_.resize(setup.robots.size()); }
  CCI_Actuator* Actuator(std::size_t k) override { return &devices_[k]; }
  void Commit(const ChannelView&, AttributeChanges&) override {}
  void Expose(std::size_t k, ExposedValues& values) override
  {
    if (is_exposed) values.Add(setting_[k]);
  }
  double Power(std::size_t) const override { return 2; }

  static inline bool is_exposed = true;

private:
  std::vector<CCI_Actuator> devices_;
  std::array<double, 8> setting_{};
};
REGISTER_ACTUATOR(Heater, {.label = "battery_test_heater", .implementation = "plain_battery_test_heater"})

struct EnergyScene
{
  std::string battery = "capacity='1000' idle='2' wheels='30' led='0.5' gripper='4' sent='0.01' received='0.003'";
  std::vector<std::string> actuators{};
  std::vector<std::string> sensors{};
  std::string arena = "<footbot id='a' position='1,1,0' controller='c'/>";
  std::string faults{};
  std::string framework = "<maxclock>60</maxclock><canonical_period>10</canonical_period>";

  std::string Controllers() const
  {
    std::vector<std::string> all = sensors;
    all.push_back("energy_battery " + battery);
    return test::Controller({.tag = "battery_test", .actuators = actuators, .sensors = all});
  }
  test::ExperimentText Text() const
  {
    RegisterBuiltins();
    return {.framework = framework, .controllers = Controllers(), .size = "8,4,1", .arena = arena, .faults = faults};
  }
  std::unique_ptr<Experiment> Load() const { return Text().Load(); }
  // Returns the first mistake in the text, or an empty text.
  std::string Mistake() const
  {
    const LoadedExperiment loaded = LoadExperimentText(Text().Text(), "test.xml", ".", {});
    return loaded.errors.empty() ? "" : loaded.errors.front().Text();
  }
};

// Runs a scene and adds up what the battery of robot a gives.
class EnergyRun
{
public:
  explicit EnergyRun(const EnergyScene& scene) : EnergyRun(scene, SimulatorOptions()) {}
  EnergyRun(const EnergyScene& scene, const SimulatorOptions& options)
      : experiment_(scene.Load()), simulator_(*experiment_, options)
  {
    CEnergyUser::steps.clear();
    CEnergyUser::charges.clear();
    CEnergyUser::times_left.clear();
  }
  void Ticks(int count)
  {
    for (int tick = 0; tick < count; ++tick)
    {
      simulator_.Step();
      used_j += Battery("a").Power_W() * 0.1;
    }
  }
  BatteryView Battery(const std::string& id) const
  {
    return *BatteryView::Of(simulator_.GetSpace(), simulator_.GetSpace().FindEntity(id)->GetIndex());
  }
  double Charge(const std::string& id = "a") const { return Battery(id).Charge_J(); }
  double Power(const std::string& id = "a") const { return Battery(id).Power_W(); }
  double X(const std::string& id = "a") const { return simulator_.GetSpace().FindEntity(id)->GetPosition().x(); }
  CSimulator& operator*() { return simulator_; }
  SpaceEditor& Editor() { return simulator_.GetEditor(); }

  double used_j = 0;

private:
  std::unique_ptr<Experiment> experiment_;
  CSimulator simulator_;
};

constexpr double kRounding = 1e-9;

TEST(EnergyBattery, OfARobotThatStandsGivesIdlePowerTimesTime)
{
  EnergyRun run({});
  EXPECT_EQ(run.Charge(), 1000);
  EXPECT_EQ(run.Power(), 0) << "nothing has been drawn before the first tick";
  run.Ticks(50);
  EXPECT_EQ(run.Power(), 2);
  EXPECT_NEAR(run.Charge(), 1000 - 2 * 5.0, kRounding);
  EXPECT_EQ(CEnergyUser::charges[0], 1);
  EXPECT_TRUE(std::isinf(CEnergyUser::times_left[0]));
  EXPECT_NEAR(CEnergyUser::charges[49], (1000 - 2 * 4.9) / 1000, kRounding);
  EXPECT_NEAR(CEnergyUser::times_left[49], (1000 - 2 * 4.9) / 2, 1e-6);
}

TEST(EnergyBattery, IsReadWithNoiseWithinItsRange)
{
  EnergyRun run({.battery = "capacity='1000' noise_kind='uniform' noise_range='0.2'"});
  run.Ticks(50);
  double least = 1;
  for (const double charge : CEnergyUser::charges)
  {
    EXPECT_LE(charge, 1);
    least = std::min(least, charge);
  }
  EXPECT_LT(least, 0.9);
  EXPECT_GT(least, 0.75);
  EXPECT_NEAR(run.Charge(), 1000 - 3 * 5.0, 1e-9) << "the battery itself has none";
}

TEST(EnergyBattery, OfARobotThatDrivesStraightGivesIdleAndWayTimesWheels)
{
  for (const double speed : {0.1, -0.2})
  {
    CEnergyUser::speed_m_s = speed;
    EnergyRun run({.actuators = {"generic_wheels"}, .arena = "<footbot id='a' position='4,1,0' controller='c'/>"});
    run.Ticks(50);
    const double way = std::fabs(run.X() - 4);
    EXPECT_NEAR(way, std::fabs(speed) * 5, 1e-6);
    EXPECT_NEAR(1000 - run.Charge(), 2 * 5.0 + 30 * std::fabs(speed) * 5, kRounding) << speed;
    EXPECT_NEAR(run.used_j, 1000 - run.Charge(), kRounding);
  }
  CEnergyUser::speed_m_s = 0.1;
}

TEST(EnergyBattery, GivesPowerToEachLitLed)
{
  EnergyRun run({.actuators = {"generic_footbot_leds"}});
  run.Ticks(1);
  EXPECT_EQ(run.Power(), 2 + 12 * 0.5);
  EnergyRun beacon({});
  beacon.Editor().SetAttribute("a", "beacon", 0x10);
  beacon.Ticks(1);
  EXPECT_EQ(beacon.Power(), 2.5) << "a dim light is lit, too";
}

TEST(EnergyBattery, GivesEnergyForBytesSentAndReceived)
{
  EnergyScene scene{
      .actuators = {"generic_radio"},
      .sensors = {"generic_radio"},
      .arena =
          "<footbot id='a' position='1,1,0' controller='c'/><footbot id='b' position='2,1,0' controller='c'/>"
          "<footbot id='far' position='7.5,3.5,0' controller='c'/>"};
  scene.sensors = {"generic_radio range='3'"};
  EnergyRun run(scene);
  run.Ticks(1);
  EXPECT_NEAR(run.Power(), 2 + 7 * 0.01 / 0.1, kRounding) << "nothing has arrived yet";
  run.Ticks(1);
  EXPECT_NEAR(run.Power(), 2 + 7 * (0.01 + 0.003) / 0.1, kRounding);
  EXPECT_NEAR(run.Power("far"), 2 + 7 * 0.01 / 0.1, kRounding) << "it hears no robot";

  scene.actuators = {"generic_range_and_bearing"};
  scene.sensors = {"generic_range_and_bearing"};
  EnergyRun bearing(scene);
  bearing.Ticks(2);
  EXPECT_NEAR(bearing.Power(), 2 + 10 * (0.01 + 0.003) / 0.1, kRounding);
}

TEST(EnergyBattery, GivesPowerToAGripperThatHolds)
{
  EnergyRun empty({.actuators = {"dummy_footbot_gripper"}});
  empty.Ticks(20);
  EXPECT_EQ(empty.Power(), 2) << "it is closed, and holds nothing";
  EnergyRun run({.actuators = {"dummy_footbot_gripper"},
                 .arena = "<footbot id='a' position='1,1,0' controller='c'/>"
                          "<cylindric_prey id='p' position='1.16,1,0' radius='0.06' height='0.1' mass='0.1'/>"});
  run.Ticks(20);
  ASSERT_NE((*run).GetSpace().FindEntity("a")->GetAttribute("gripped"), 0);
  EXPECT_EQ(run.Power(), 6);
}

TEST(EnergyBattery, GivesPowerToDevicesOfOnesOwn)
{
  EnergyRun run({.actuators = {"plain_battery_test_heater"}});
  run.Ticks(1);
  EXPECT_EQ(run.Power(), 4);
}

TEST(EnergyBattery, ThatIsEmptySwitchesTheRobotOff)
{
  EnergyScene scene{.battery = "capacity='3.3' idle='2' wheels='30' led='0.5'",
                    .actuators = {"generic_wheels", "generic_footbot_leds"}};
  EnergyRun run(scene);
  // 2 + 3 + 6 W empty it in the third tick.
  run.Ticks(3);
  EXPECT_NEAR(run.Charge(), 0, kRounding);
  run.Ticks(1);
  EXPECT_EQ(run.Charge(), 0);
  EXPECT_TRUE(run.Battery("a").IsOff());
  EXPECT_NEAR(run.used_j, 3.3, kRounding) << "what it gave is what it had";
  const int steps = CEnergyUser::steps["a"];
  run.Ticks(1);
  const double stopped_at = run.X();
  run.Ticks(10);
  EXPECT_EQ(run.X(), stopped_at);
  EXPECT_EQ(run.Power(), 0);
  EXPECT_EQ((*run).GetSpace().FindEntity("a")->GetAttribute("led"), 0) << "it is dark";
  EXPECT_EQ(CEnergyUser::steps["a"], steps) << "its controller is not called";

  scene.battery += " empty='ignore'";
  EnergyRun on(scene);
  on.Ticks(14);
  EXPECT_EQ(on.Charge(), 0);
  EXPECT_FALSE(on.Battery("a").IsOff());
  EXPECT_NEAR(on.X(), 1 + 14 * 0.01, 1e-6) << "it drives on";
  EXPECT_NEAR(on.used_j, 3.3, kRounding);
}

TEST(EnergyBattery, ThatIsEmptyAtTheStartIsChargedAtAStation)
{
  EnergyScene scene{.battery = "capacity='100' start='0' idle='2' restart='0.1'", .actuators = {"generic_wheels"}};
  EnergyRun alone(scene);
  alone.Ticks(10);
  EXPECT_EQ(alone.X(), 1);
  EXPECT_EQ(CEnergyUser::steps["a"], 0);

  scene.arena += "<charging_station id='s' position='1,1,0' radius='0.2' charging_power='20'/>";
  EnergyRun run(scene);
  run.Ticks(4);
  EXPECT_NEAR(run.Charge(), 8, kRounding);
  EXPECT_TRUE(run.Battery("a").IsOff());
  run.Ticks(1);
  EXPECT_NEAR(run.Charge(), 10, kRounding);
  EXPECT_FALSE(run.Battery("a").IsOff()) << "a tenth of the capacity";
  EXPECT_EQ(CEnergyUser::steps["a"], 0);
  run.Ticks(1);
  EXPECT_EQ(CEnergyUser::steps["a"], 1);
  EXPECT_GT(run.X(), 1);
}

TEST(ChargingStation, FillsUpToTheCapacityAndFeedsTheRobot)
{
  EnergyRun run({.battery = "capacity='100' start='0.95' idle='2'",
                 .arena = "<footbot id='a' position='1,1,0' controller='c'/>"
                          "<charging_station id='s' position='1,1.19,0' radius='0.2' charging_power='20'/>"
                          "<charging_station id='nobody' position='5,1,0' size='1,1' charging_power='20'/>"});
  run.Ticks(1);
  EXPECT_NEAR(run.Charge(), 95 + 1.8, kRounding);
  run.Ticks(20);
  EXPECT_EQ(run.Charge(), 100);
  EXPECT_EQ(run.Power(), 2) << "the robot draws while it stands there";
}

TEST(ChargingStation, SharesItsLimitAmongTheRobotsOnIt)
{
  const std::string two =
      "<footbot id='a' position='1,1,0' controller='c'/><footbot id='b' position='1,1.3,0' controller='c'/>"
      "<footbot id='beside' position='2,1,0' controller='c'/>";
  const std::string station =
      "<charging_station id='s' position='1,1.15,0' orientation='0,0,90' size='0.4,0.1' charging_power='20' ";
  const EnergyScene each{.battery = "capacity='100' start='0.5' idle='0'", .arena = two + station + "/>"};
  EnergyRun run(each);
  run.Ticks(10);
  EXPECT_NEAR(run.Charge("a"), 70, kRounding);
  EXPECT_NEAR(run.Charge("b"), 70, kRounding) << "the rectangle is turned";
  EXPECT_EQ(run.Charge("beside"), 50);
  EnergyRun shared({.battery = each.battery, .arena = two + station + "charging_limit='30'/>"});
  shared.Ticks(10);
  EXPECT_NEAR(shared.Charge("a"), 65, kRounding);
  EXPECT_NEAR(shared.Charge("b"), 65, kRounding);
  shared.Editor().MoveEntity("b", {{5, 3, 0}, Quaternion::Identity()});
  shared.Ticks(10);
  EXPECT_NEAR(shared.Charge("a"), 85, kRounding) << "alone it gets 20 W";
}

TEST(ChargingStation, IsChangedAndRemovedByFunctions)
{
  EnergyRun run({.battery = "capacity='100' start='0.5' idle='0'",
                 .arena =
                     "<footbot id='a' position='1,1,0' controller='c'/>"
                     "<reserve quantity='1'><charging_station id='s' radius='0.2' charging_power='20'/></reserve>"});
  run.Ticks(10);
  EXPECT_EQ(run.Charge(), 50) << "it is not in the arena";
  const std::string id = run.Editor().AddEntity("s", {{1, 1, 0}, Quaternion::Identity()});
  run.Ticks(10);
  EXPECT_NEAR(run.Charge(), 70, kRounding);
  run.Editor().SetAttribute(id, "charging_power", 5);
  run.Ticks(10);
  EXPECT_NEAR(run.Charge(), 75, kRounding);
  run.Editor().RemoveEntity(id);
  run.Ticks(10);
  EXPECT_NEAR(run.Charge(), 75, kRounding);
}

TEST(EnergyBattery, OfARobotThatIsSwitchedOffOrAwayGivesNothing)
{
  EnergyRun off({.actuators = {"generic_wheels"}, .faults = "<fault id='f' kind='off' from='10' to='20'/>"});
  off.Ticks(30);
  EXPECT_NEAR(1000 - off.Charge(), 20 * (2 + 3) * 0.1, kRounding);
  EnergyRun away({});
  away.Ticks(10);
  away.Editor().RemoveEntity("a");
  away.Ticks(10);
  EXPECT_NEAR(1000 - away.Charge(), 2, kRounding);
  away.Editor().AddEntity("a", {{2, 2, 0}, Quaternion::Identity()});
  away.Ticks(10);
  EXPECT_NEAR(1000 - away.Charge(), 4, kRounding);
}

TEST(EnergyBattery, IsChargedByFunctionsWithinItsCapacity)
{
  EnergyRun run(
      {.battery = "capacity='100' start='0' idle='2'",
       .arena =
           "<footbot id='a' position='1,1,0' controller='c'/><block id='x' position='3,3,0.1' size='0.2,0.2,0.2'/>"});
  const std::uint64_t before = (*run).GetSpace().Hash();
  run.Editor().SetCharge("a", 50);
  EXPECT_NE((*run).GetSpace().Hash(), before) << "the charge is in the state";
  run.Ticks(2);
  EXPECT_FALSE(run.Battery("a").IsOff());
  EXPECT_THROW(run.Editor().SetCharge("a", 101), std::invalid_argument);
  EXPECT_THROW(run.Editor().SetCharge("a", -1), std::invalid_argument);
  EXPECT_THROW(run.Editor().SetCharge("a", std::nan("")), std::invalid_argument);
  EXPECT_THROW(run.Editor().SetCharge("x", 1), std::invalid_argument);
  EXPECT_THROW(run.Editor().SetCharge("nobody", 1), std::invalid_argument);
}

TEST(EnergyBattery, HasTheSameEnergiesIfCommandsActLate)
{
  EnergyScene scene{.actuators = {"generic_wheels", "generic_footbot_leds", "generic_radio"},
                    .sensors = {"generic_radio"}};
  EnergyRun now(scene);
  now.Ticks(20);
  scene.framework += "<ahead>1</ahead>";
  EnergyRun late(scene);
  late.Ticks(20);
  EXPECT_NEAR(now.used_j - late.used_j, (3 + 6 + 0.7) * 0.1, kRounding) << "the commands of one tick are missing";
}

TEST(EnergyBattery, GoesOnFromACheckpointAndIsFullWhenTheRunBeginsAgain)
{
  const std::string folder = testing::TempDir() + "batteries";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  // Robot a is empty between the two checkpoints. Robot b is charged on its way, and is empty later.
  const EnergyScene scene{
      .battery = "capacity='20' idle='5' restart='0.2'",
      .actuators = {"generic_wheels", "generic_radio"},
      .sensors = {"generic_radio"},
      .arena =
          "<footbot id='a' position='1,1,0' controller='c'/><footbot id='b' position='1,3,0' controller='c'/>"
          "<charging_station id='s' position='1.2,3,0' radius='0.2' charging_power='3'/>"};
  SimulatorOptions options;
  options.output_folder = folder;
  options.checkpoint_every = 20;
  const auto experiment = scene.Load();
  CSimulator whole(*experiment, options);
  while (whole.Step())
  {
  }
  const CSwarmanoidSpace& space = whole.GetSpace();
  EXPECT_TRUE(BatteryView::Of(space, 0)->IsOff());
  const std::uint64_t hash = whole.Finish().hash;
  options.checkpoint_every = 0;
  for (const std::uint64_t tick : {20, 40})
  {
    options.restore_file = folder + "/" + CheckpointName(tick);
    CSimulator restored(*experiment, options);
    while (restored.Step())
    {
    }
    EXPECT_EQ(restored.Finish().hash, hash) << tick;
  }
  std::filesystem::remove_all(folder);
  EnergyRun again(scene);
  again.Ticks(45);
  EXPECT_EQ(again.Charge(), 0);
  again.Editor().BeginAgain((*again).GetSpace().GetTick(), 0);
  EXPECT_EQ(again.Charge(), 20);
  EXPECT_FALSE(again.Battery("a").IsOff());
}

TEST(EnergyBattery, RefusesWhatItCannotDo)
{
  EXPECT_THAT(EnergyScene{.battery = "capacity='0'"}.Mistake(), HasSubstr("capacity"));
  EXPECT_THAT(EnergyScene{.battery = "start='1.5'"}.Mistake(), HasSubstr("start"));
  EXPECT_THAT(EnergyScene{.battery = "idle='-1'"}.Mistake(), HasSubstr("idle"));
  EXPECT_THAT(EnergyScene{.battery = "empty='die'"}.Mistake(), HasSubstr("stop, ignore"));
  EXPECT_EQ(EnergyScene{}.Mistake(), "");
  Heater::is_exposed = false;
  try
  {
    EnergyRun run({.actuators = {"plain_battery_test_heater"}});
    ADD_FAILURE() << "a device that cannot be switched off was accepted";
  }
  catch (const ConfigurationError& error)
  {
    EXPECT_THAT(error.what(), HasSubstr("empty=\"ignore\""));
  }
  EnergyRun ignores({.battery = "empty='ignore'", .actuators = {"plain_battery_test_heater"}});
  ignores.Ticks(1);
  Heater::is_exposed = true;
}

// The bar of a robot is as wide as the robot. Its first part is the charge.
TEST(EnergyBattery, IsDrawnAsABarOverTheRobotAndItsStationWithABolt)
{
  EnergyRun run({.battery = "capacity='100' start='0.6' idle='10'",
                 .arena = "<footbot id='a' position='1,1,0' orientation='0,0,90' controller='c'/>"
                          "<charging_station id='s' position='4,2,0' radius='0.5' charging_power='20'/>"
                          "<charging_station id='dead' position='6,2,0' radius='0.5' charging_power='0'/>"});
  const CSwarmanoidSpace& space = (*run).GetSpace();
  const DrawnState state(space);
  EXPECT_TRUE(state.Changes());
  const auto drawn = [&]
  {
    std::vector<std::pair<double, std::uint32_t>> parts;  // widths and colours
    double bolts = 0, first_x = 1e9, last_x = 0;
    ForEachDrawnShape(state,
                      [&](const DrawnShape& shape, std::span<const float> numbers, std::string_view, const Pose& frame)
                      {
                        if (shape.kind == DrawnShape::Kind::kPolygon)
                        {
                          bolts += 1;
                          EXPECT_EQ(frame.position.x(), 4) << "the other station has no power";
                          return;
                        }
                        parts.emplace_back(numbers[3] - numbers[0], shape.colour >> 8U);
                        EXPECT_EQ(numbers[1], 1);
                        first_x = std::min<double>(first_x, numbers[0]);
                        last_x = std::max<double>(last_x, numbers[3]);
                      });
    EXPECT_EQ(bolts, 2);
    EXPECT_NEAR((first_x + last_x) / 2, 1, 1e-6);
    EXPECT_NEAR(last_x - first_x, 2 * 0.085, 1e-3);
    return parts;
  };
  auto parts = drawn();
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_NEAR(parts[0].first / (parts[0].first + parts[1].first), 0.6, 1e-6);
  const std::uint32_t full = parts[0].second;
  run.Ticks(20);
  EXPECT_NE(drawn()[0].second, full) << "40 % are left";
  run.Ticks(40);
  parts = drawn();
  ASSERT_EQ(parts.size(), 1U) << "it is empty";
  EXPECT_NEAR(parts[0].first, 2 * 0.085, 1e-3);
}

}  // namespace
}  // namespace swarmanoid

// Faults of devices (docs/faults.md): each kind against its closed form, in one host and in several, and after the
// state of the host was saved.
#include <gmock/gmock.h>

#include <cmath>
#include <map>

#include "common/control_interface/ci_colour_blob_sensor.h"
#include "common/control_interface/ci_controller.h"
#include "common/control_interface/ci_led_ring_actuator.h"
#include "common/control_interface/ci_positioning_sensor.h"
#include "common/control_interface/ci_range_and_bearing.h"
#include "common/control_interface/ci_wheels_actuator.h"
#include "common/control_interface/footbot/ci_footbot_proximity_sensor.h"
#include "common/plugins/noise_parameters.h"
#include "common/space/attributes.h"
#include "common/space/space.h"
#include "controller_host/controller_host.h"
#include "tests/world/message_of.h"
#include "tests/world/small_experiment.h"

namespace swarmanoid
{
namespace
{

using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;
using enum DeviceFaultKind;

// The readings of a robot in a control step.
struct SeenReadings
{
  std::uint64_t tick = 0;
  double x = 0, heading = 0;
  std::size_t packets = 0, blobs = 0;
  double nearest = 0;  // the largest reading of its proximity sensors

  bool operator==(const SeenReadings&) const = default;
};

// Drives and shines, sends, and notes what it reads. The wheels have the speed of the number of its step.
class Reporter : public CCI_Controller
{
public:
  static inline std::map<std::string, std::vector<SeenReadings>> seen;

  int Init(const TConfigurationTree) override { return RETURN_OK; }
  void ControlStep() override
  {
    ++steps_;
    CCI_Robot& robot = *GetRobot();
    SeenReadings now{.tick = robot.GetTick()};
    const auto& place = robot.Sensor<CCI_PositioningSensor>("positioning");
    now.x = place.GetPosition().x();
    now.heading = place.GetHeading();
    now.packets = robot.Sensor<CCI_RangeAndBearingSensor>("range_and_bearing").GetAllPackets().size();
    now.blobs = robot.Sensor<CCI_ColourBlobSensor>("footbot_omnidirectional_camera").GetAllBlobs().size();
    for (const double reading : robot.Sensor<CCI_FootBotProximitySensor>("footbot_proximity").GetAllSensorReadings())
      now.nearest = std::max(now.nearest, reading);
    seen[robot.GetId()].push_back(now);
    robot.Actuator<CCI_WheelsActuator>("wheels").SetAngularVelocity(steps_, -2.0 * steps_);
    robot.Actuator<CCI_LedRingActuator>("led_ring").SetAllColours(0xff0000);
    robot.Actuator<CCI_RangeAndBearingActuator>("range_and_bearing").SetMessage({1, 2, 3});
  }
  bool HasState() const override { return true; }
  void SaveState(std::ostream& state) const override { state << steps_; }
  void LoadState(std::istream& state) override { state >> steps_; }

private:
  int steps_ = 0;
};

REGISTER_CONTROLLER(Reporter, "device_faults_test")

struct FaultText
{
  DeviceFaultKind kind;
  double value = 0;
  std::string device{};
  std::uint64_t from = 0, to = 0;
  std::vector<std::uint32_t> entities{0};
  std::string id = "f";
};

FaultConfiguration Made(const FaultText& text)
{
  FaultConfiguration fault;
  fault.id = text.id;
  fault.kind = text.kind;
  fault.kind_name = "test";
  fault.value = text.value;
  fault.device = text.device;
  fault.from = text.from;
  fault.to = text.to;
  fault.entities = text.entities;
  return fault;
}

Experiment Robots(const std::vector<std::string>& ids, const std::vector<FaultText>& faults)
{
  RegisterBuiltinDevices();
  Experiment experiment =
      test::RobotsOf("device_faults_test", ids, {"generic_wheels", "generic_led_ring", "generic_range_and_bearing"},
                     {"generic_positioning", "generic_range_and_bearing", "generic_footbot_omnidirectional_camera",
                      "generic_footbot_proximity"});
  // They touch each other, so that they sense each other.
  for (std::size_t k = 0; k < experiment.entities.size(); ++k)
    experiment.entities[k].pose.position.x() = 1 + 0.18 * static_cast<double>(k);
  for (const FaultText& fault : faults) experiment.faults.push_back(Made(fault));
  return experiment;
}

// The hosts of an experiment and the space that they see, without engines: robot k is at x = tick + 0.18 k.
class Hosted
{
public:
  explicit Hosted(Experiment experiment, unsigned hosts = 1)
      : experiment_(std::move(experiment)), assignment_(MakeAssignment(experiment_, hosts)), space_(experiment_)
  {
    for (std::size_t h = 0; h < hosts; ++h) hosts_.push_back(std::make_unique<ControllerHost>(space_, assignment_, h));
  }
  explicit Hosted(const std::vector<FaultText>& faults) : Hosted(Robots({"a", "b"}, faults)) {}

  void Tick(std::uint64_t tick)
  {
    space_.SetTick(tick);
    for (std::uint32_t k = 0; k < space_.Size(); ++k)
    {
      Pose pose = space_.GetPose(k);
      pose.position.x() = X(tick, k);
      space_.SetPose(k, pose);
    }
    AttributeChanges changes;
    wheels.assign(2 * space_.Size(), 0);
    for (const auto& host : hosts_)
    {
      const ControlCommands& commands = host->Tick({});
      for (const ChannelBlock& block : host->Layout().commands)
        for (std::size_t i = 0; i < block.entities.size(); ++i)
          std::copy_n(&commands.values[block.offset + 2 * i], 2, &wheels[2 * block.entities[i]]);
      for (std::size_t i = 0; i < commands.attributes.slots.size(); ++i)
        changes.Add(commands.attributes.slots[i], commands.attributes.values[i]);
    }
    for (std::size_t i = 0; i < changes.slots.size(); ++i) space_.SetAttribute(changes.slots[i], changes.values[i]);
  }
  void Ticks(std::uint64_t from, std::uint64_t to)
  {
    for (std::uint64_t tick = from; tick < to; ++tick) Tick(tick);
  }
  static double X(std::uint64_t tick, std::size_t robot)
  {
    return static_cast<double>(tick) + 0.18 * static_cast<double>(robot);
  }
  double Led(std::size_t robot) const { return space_.Attributes()[space_.GetEntity(robot).SlotOf("led")]; }
  std::vector<double> Attributes() const
  {
    std::vector<double> all;
    for (std::size_t k = 0; k < space_.Size(); ++k)
      for (int led = 0; led < 12; ++led) all.push_back(space_.Attributes()[space_.GetEntity(k).SlotOf("led", led)]);
    return all;
  }
  ControllerHost& Host(std::size_t number = 0) { return *hosts_[number]; }
  CSwarmanoidSpace& Space() { return space_; }

  std::vector<double> wheels;  // of robot after robot

private:
  const Experiment experiment_;
  const Assignment assignment_;
  CSwarmanoidSpace space_;
  std::vector<std::unique_ptr<ControllerHost>> hosts_;
};

class DeviceFaultsTest : public testing::Test
{
protected:
  DeviceFaultsTest() { Reporter::seen.clear(); }
  static std::vector<double> X(const std::string& id)
  {
    std::vector<double> all;
    for (const SeenReadings& seen : Reporter::seen[id]) all.push_back(seen.x);
    return all;
  }
};

TEST_F(DeviceFaultsTest, WithoutRobotsNothingHappens)
{
  Hosted none(Robots({}, {{kDead, 0, "", 0, 0, {}}}));
  none.Ticks(0, 3);
  EXPECT_THAT(none.wheels, SizeIs(0));
  Hosted one(Robots({"a"}, {{kDead, 0, "", 0, 0, {}}}));
  one.Tick(0);
  EXPECT_THAT(one.wheels, ElementsAre(1, -2));
}

TEST_F(DeviceFaultsTest, ScaleAndBiasAreExactAndConcernTheirTicksAndRobotsOnly)
{
  Hosted run({{kScale, 3, "positioning", 1, 3}, {kBias, -0.5, "positioning", 2, 4, {0}, "g"}});
  run.Ticks(0, 5);
  EXPECT_THAT(X("a"), ElementsAre(0, 3, 5.5, 2.5, 4));
  EXPECT_THAT(X("b"), ElementsAre(0.18, 1.18, 2.18, 3.18, 4.18));
  for (const SeenReadings& seen : Reporter::seen["a"]) EXPECT_EQ(seen.heading, 0) << "an orientation is no quantity";
}

TEST_F(DeviceFaultsTest, ReadingsStayWithinTheirRange)
{
  Hosted run({{kScale, 1000, "footbot_proximity", 1, 2}, {kBias, -5, "footbot_proximity", 2, 3}});
  run.Ticks(0, 4);
  const auto& seen = Reporter::seen["a"];
  EXPECT_GT(seen[0].nearest, 0);
  EXPECT_LT(seen[0].nearest, 1);
  EXPECT_EQ(seen[1].nearest, 1);
  EXPECT_EQ(seen[2].nearest, 0);
  EXPECT_NEAR(seen[3].nearest, seen[0].nearest, 1e-9);
}

TEST_F(DeviceFaultsTest, AStuckSensorKeepsItsFirstReading)
{
  Hosted run({{kStuck, 0, "positioning", 2, 5}});
  run.Ticks(0, 7);
  EXPECT_THAT(X("a"), ElementsAre(0, 1, 2, 2, 2, 5, 6));
}

TEST_F(DeviceFaultsTest, ADelayIsExact)
{
  Hosted run({{kDelay, 3, "positioning", 2, 9}});
  run.Ticks(0, 11);
  EXPECT_THAT(X("a"), ElementsAre(0, 1, 2, 2, 2, 2, 3, 4, 5, 9, 10));
}

TEST_F(DeviceFaultsTest, DroppedReadingsFollowABinomialDistributionAndTheLastOneStays)
{
  constexpr double kProbability = 0.3;
  constexpr std::uint64_t kTicks = 4000, kFrom = 5;
  Hosted run({{kDrop, kProbability, "positioning", kFrom}});
  run.Ticks(0, kFrom + kTicks);
  double last = kFrom - 1, lost = 0;
  for (const SeenReadings& seen : Reporter::seen["a"])
  {
    const auto now = static_cast<double>(seen.tick);
    if (seen.tick < kFrom)
    {
      EXPECT_EQ(seen.x, now);
      continue;
    }
    if (seen.x == now)
      last = now;
    else
      ++lost;
    ASSERT_EQ(seen.x, last);
  }
  EXPECT_NEAR(lost / kTicks, kProbability, 4 * std::sqrt(kProbability * (1 - kProbability) / kTicks));
}

TEST_F(DeviceFaultsTest, NoiseIsNormalAndNamedByRobotAndFault)
{
  constexpr double kDeviation = 0.2;
  constexpr std::uint64_t kTicks = 4000;
  Hosted(Robots({"a"}, {{kNoise, kDeviation, "positioning"}})).Ticks(0, kTicks);
  const std::vector<double> alone = X("a");
  double sum = 0, squares = 0;
  for (std::uint64_t tick = 0; tick < kTicks; ++tick)
  {
    const double noise = alone[tick] - static_cast<double>(tick);
    sum += noise;
    squares += noise * noise;
  }
  EXPECT_NEAR(sum / kTicks, 0, 4 * kDeviation / std::sqrt(kTicks));
  EXPECT_NEAR(squares / kTicks, kDeviation * kDeviation, 4 * kDeviation * kDeviation * std::sqrt(2.0 / kTicks));

  Reporter::seen.clear();
  Hosted(
      Robots({"z", "a"}, {{kDead, 0, "led_ring", 0, 0, {0}, "g"}, {kNoise, kDeviation, "positioning", 0, 0, {0, 1}}}))
      .Ticks(0, 10);
  for (std::uint64_t tick = 0; tick < 10; ++tick)
  {
    EXPECT_NEAR(X("a")[tick] - 0.18, alone[tick], 1e-12) << "another robot changes no number";
    EXPECT_NE(X("z")[tick], alone[tick]);
  }
}

TEST_F(DeviceFaultsTest, DeadDevicesReadNothingAndDoNothing)
{
  Hosted run({{kDead, 0, "", 2, 4}});
  run.Ticks(0, 2);
  EXPECT_EQ(run.Led(0), 0xff0000);
  run.Ticks(2, 4);
  EXPECT_THAT(run.wheels, ElementsAre(0, 0, 4, -8));
  EXPECT_EQ(run.Led(0), 0);
  EXPECT_EQ(run.Led(1), 0xff0000);
  run.Ticks(4, 6);
  EXPECT_THAT(run.wheels, ElementsAre(6, run.wheels[3], 6, run.wheels[3]));
  EXPECT_EQ(run.Led(0), 0xff0000);
  const auto& seen = Reporter::seen["a"];
  for (const std::size_t tick : {1U, 5U})
  {
    EXPECT_EQ(seen[tick].packets, 1U) << tick;
    EXPECT_GT(seen[tick].blobs, 0U) << tick;
    EXPECT_GT(seen[tick].nearest, 0) << tick;
  }
  for (const std::size_t tick : {2U, 3U}) EXPECT_EQ(seen[tick], SeenReadings{.tick = tick});
  // Its messages stop, too: the other robot hears them a tick later.
  const auto& other = Reporter::seen["b"];
  std::vector<std::size_t> packets;
  for (const SeenReadings& step : other) packets.push_back(step.packets);
  EXPECT_THAT(packets, ElementsAre(0, 1, 1, 0, 0, 1));
}

TEST_F(DeviceFaultsTest, ActuatorsGetChangedSettingsAndKeepTheirOwn)
{
  Hosted run({{kScale, 0.5, "wheels", 1, 2},
              {kBias, 0.25, "wheels", 2, 3},
              {kStuck, 0, "wheels", 3, 5},
              {kDelay, 1, "wheels", 6, 8},
              {kScale, 1e6, "wheels", 8, 9}});
  std::vector<double> left;
  for (std::uint64_t tick = 0; tick < 8; ++tick)
  {
    run.Tick(tick);
    left.push_back(run.wheels[0]);
    EXPECT_EQ(run.wheels[2], static_cast<double>(tick) + 1);
  }
  EXPECT_THAT(left, ElementsAre(1, 1, 3.25, 4, 4, 6, 7, 7));
  run.Tick(8);
  EXPECT_LT(run.wheels[0], 100) << "the limit of the wheels holds";
  EXPECT_GT(run.wheels[0], 9);
}

TEST_F(DeviceFaultsTest, EntriesOfListsAreDroppedOneByOne)
{
  constexpr std::uint64_t kTicks = 1000;
  Experiment experiment = Robots({"a", "b", "c", "d", "e"}, {{kDrop, 0.25, "range_and_bearing", 1}});
  // No robot hides another one.
  const double y[] = {0, 0.6, 0.7, 0.6, 0};
  for (std::size_t k = 0; k < 5; ++k) experiment.entities[k].pose.position.y() += y[k];
  Hosted run(std::move(experiment));
  run.Ticks(0, kTicks + 1);
  double heard = 0;
  for (const SeenReadings& seen : Reporter::seen["a"]) heard += static_cast<double>(seen.packets);
  const double sent = 4.0 * kTicks;
  EXPECT_NEAR(heard / sent, 0.75, 4 * std::sqrt(0.25 * 0.75 / sent));
  for (std::size_t tick = 1; tick <= kTicks; ++tick) ASSERT_GE(Reporter::seen["b"][tick].packets, 3U);
}

TEST_F(DeviceFaultsTest, ARobotIsSwitchedOffAndOn)
{
  Hosted run({{kOff, 0, "", 2, 4}});
  run.Ticks(0, 3);
  EXPECT_THAT(run.wheels, ElementsAre(0, 0, 3, -6));
  EXPECT_EQ(run.Led(0), 0);
  RobotStatus status;
  ASSERT_TRUE(run.Host().Describe(0, status));
  EXPECT_EQ(status.state, "off");
  EXPECT_EQ(status.text, "the fault 'f' switched it off");
  run.Ticks(3, 5);
  EXPECT_THAT(run.wheels, ElementsAre(3, -6, 5, -10)) << "the controller goes on with its third step";
  EXPECT_EQ(run.Led(0), 0xff0000);
  std::vector<std::uint64_t> ticks;
  for (const SeenReadings& seen : Reporter::seen["a"]) ticks.push_back(seen.tick);
  EXPECT_THAT(ticks, ElementsAre(0, 1, 4));
}

const std::vector<FaultText> kAll{{kDrop, 0.4, "", 3, 40, {0, 1, 2}, "drop"},
                                  {kStuck, 0, "wheels", 6, 12, {1}, "stuck"},
                                  {kDelay, 4, "positioning", 5, 30, {0, 2}, "delay"},
                                  {kNoise, 0.1, "positioning", 2, 35, {0, 1, 2, 3}, "noise"},
                                  {kOff, 0, "", 8, 14, {3}, "off"}};

TEST_F(DeviceFaultsTest, AreTheSameInSeveralHosts)
{
  const std::vector<std::string> ids{"a", "b", "c", "d"};
  Hosted one(Robots(ids, kAll)), two(Robots(ids, kAll), 2), four(Robots(ids, kAll), 4);
  for (std::uint64_t tick = 0; tick < 45; ++tick)
  {
    one.Tick(tick);
    two.Tick(tick);
    four.Tick(tick);
    EXPECT_EQ(one.wheels, two.wheels) << tick;
    EXPECT_EQ(one.wheels, four.wheels) << tick;
    EXPECT_EQ(one.Attributes(), four.Attributes()) << tick;
  }
}

TEST_F(DeviceFaultsTest, WhatTheyRememberIsSaved)
{
  const std::vector<std::string> ids{"a", "b", "c", "d"};
  for (const std::uint64_t saved_at : {3U, 7U, 10U, 25U})
  {
    Hosted whole(Robots(ids, kAll));
    whole.Ticks(0, saved_at);
    ByteWriter saved;
    whole.Host().SaveState(saved);
    Hosted restored(Robots(ids, kAll));
    restored.Space().SetTick(saved_at);
    for (std::size_t k = 0; k < ids.size(); ++k)
      for (const AttributeSpec& spec : AttributesOf(EntityKind::kFootbot))
        for (int element = 0; element < spec.count; ++element)
        {
          const std::uint32_t slot = whole.Space().GetEntity(k).SlotOf(spec.name, element);
          restored.Space().SetAttribute(slot, whole.Space().Attributes()[slot]);
        }
    ByteReader read(saved.Bytes());
    restored.Host().LoadState(read);
    for (std::uint64_t tick = saved_at; tick < 45; ++tick)
    {
      Reporter::seen.clear();
      whole.Tick(tick);
      const auto expected = Reporter::seen;
      Reporter::seen.clear();
      restored.Tick(tick);
      EXPECT_EQ(Reporter::seen, expected) << saved_at << ", " << tick;
      EXPECT_EQ(restored.wheels, whole.wheels) << saved_at << ", " << tick;
      EXPECT_EQ(restored.Attributes(), whole.Attributes()) << saved_at << ", " << tick;
    }
  }
}

TEST_F(DeviceFaultsTest, ThatADeviceCannotHaveAreRefused)
{
  const auto message = [](const FaultText& fault)
  { return test::MessageOf<ConfigurationError>([&] { Hosted run({fault}); }); };
  EXPECT_THAT(message({kStuck, 0, "footbot_omnidirectional_camera"}),
              HasSubstr("the fault 'f' cannot change the sensor <footbot_omnidirectional_camera> "
                        "(generic_footbot_omnidirectional_camera): it has a list, for which there is no 'test'; choose "
                        "dead or drop"));
  EXPECT_THAT(message({kScale, 2, "led_ring"}), HasSubstr("it has no numbers for 'test'; choose dead, stuck"));
  EXPECT_THAT(message({kScale, 2, ""}), HasSubstr("; name the devices of the fault one by one"));
}

// It overrides nothing for faults.
class Closed : public SensorBatch
{
public:
  class Device : public CCI_PositioningSensor
  {
    Vector3 GetPosition() const override { return Vector3::Zero(); }
    Quaternion GetOrientation() const override { return Quaternion::Identity(); }
  };
  void Init(const DeviceSetup& setup) override { devices_.resize(setup.robots.size()); }
  Device* Sensor(std::size_t k) override { return &devices_[k]; }
  void Update(const ChannelView&) override {}

private:
  std::vector<Device> devices_;
};

PluginDescription ClosedDescription()
{
  PluginDescription description;
  description.label = "closed";
  description.implementation = "faults_closed";
  return description;
}

REGISTER_SENSOR(Closed, ClosedDescription())

TEST_F(DeviceFaultsTest, NeedADeviceThatShowsItsValues)
{
  Experiment experiment = test::RobotsOf("device_faults_test", {"a"}, {}, {"faults_closed"});
  experiment.faults.push_back(Made({kDead}));
  EXPECT_THAT(test::MessageOf<ConfigurationError>([&] { Hosted run(std::move(experiment)); }),
              HasSubstr("<closed> (faults_closed): it does not show its values; its class must override Expose"));
}

}  // namespace
}  // namespace swarmanoid

// Noise as the experiment file asks for it: mean, deviation and range of what single devices read and do.
#include <functional>

#include "common/control_interface/ci_colour_blob_sensor.h"
#include "common/control_interface/ci_pie_camera_sensor.h"
#include "common/control_interface/ci_range_and_bearing.h"
#include "common/control_interface/eyebot/ci_eyebot_altitude_sensor.h"
#include "common/control_interface/eyebot/ci_eyebot_attachment_actuator.h"
#include "common/control_interface/eyebot/ci_eyebot_laser_actuator.h"
#include "common/control_interface/eyebot/ci_eyebot_propellers_actuator.h"
#include "common/control_interface/footbot/ci_footbot_accelerometer_sensor.h"
#include "common/control_interface/footbot/ci_footbot_beacon_actuator.h"
#include "common/control_interface/footbot/ci_footbot_encoders_sensor.h"
#include "common/control_interface/footbot/ci_footbot_gripper_actuator.h"
#include "common/control_interface/footbot/ci_footbot_gripper_sensor.h"
#include "common/control_interface/footbot/ci_footbot_ground_sensor.h"
#include "common/control_interface/footbot/ci_footbot_light_sensor.h"
#include "common/control_interface/footbot/ci_footbot_turret_actuator.h"
#include "common/control_interface/footbot/ci_footbot_turret_encoder_sensor.h"
#include "common/control_interface/footbot/ci_footbot_turret_torque_sensor.h"
#include "common/control_interface/handbot/ci_handbot_arms_actuator.h"
#include "common/control_interface/handbot/ci_handbot_hands_actuator.h"
#include "common/control_interface/handbot/ci_handbot_head_actuator.h"
#include "common/control_interface/handbot/ci_handbot_joints_sensor.h"
#include "common/control_interface/handbot/ci_handbot_rope_actuator.h"
#include "tests/unit/devices/test_world.h"

namespace swarmanoid
{
namespace
{

constexpr std::uint32_t kFootbot = 0, kHandbot = 1, kEyebot = 2, kOther = 3;
constexpr int kTicks = 3000;

// Each robot sees the other footbot, and all readings are far from their limits.
class World : public TestWorld
{
public:
  World()
  {
    AddFootbot(5, 5);
    Add(EntityKind::kHandbot, {4.2, 5.4, 0}, 0, {0.22, 0.17, 0.16});
    AddEyebot(5.4, 5.3, 2);
    AddFootbot(5.4, 5);
    Add(EntityKind::kLightBulb, {5, 6.5, 0.5}, 0, {0, 0, 0}, false);
    const auto patch = Add(EntityKind::kGroundPatch, {5, 5, 0}, 0, {1, 1, 0}, false, -1);
    Configuration().entities[patch].colour = 0x808080;
    for (int led = 0; led < 12; ++led) Space().GetEntity(kOther).SetAttribute("led", CCI_Colour::RED, led);
    Space().GetEntity(kOther).SetAttribute("message", 1);
    Space().GetEntity(kFootbot).SetAttribute("gripper_aperture", 0.8);
  }
};

// The readings of a device that are tested.
struct Case
{
  const char* type;
  const char* implementation;
  const char* prefix;  // prefix of the noise parameters
  std::uint32_t robot;
  double scale;  // scale of the noise, in its unit
};

template <class Interface, class Value>
auto Reads(Value value)
{
  return [value](const CCI_Sensor& sensor) { return value(dynamic_cast<const Interface&>(sensor)); };
}

struct SensorCase : Case
{
  std::function<double(const CCI_Sensor&)> value;
};

struct ActuatorCase : Case
{
  std::function<void(CCI_Actuator&)> use;
  std::size_t place;  // index of the tested channel value
};

struct Moments
{
  double mean, deviation, least, most;
};

template <class Sample>
Moments MomentsOf(World& world, Sample sample)
{
  double sum = 0, squares = 0;
  Moments moments{0, 0, 1e300, -1e300};
  for (int tick = 1; tick <= kTicks; ++tick)
  {
    world.Space().SetTick(static_cast<std::uint64_t>(tick));
    const double value = sample();
    sum += value;
    squares += value * value;
    moments.least = std::min(moments.least, value);
    moments.most = std::max(moments.most, value);
  }
  moments.mean = sum / kTicks;
  moments.deviation = std::sqrt(squares / kTicks - moments.mean * moments.mean);
  return moments;
}

// `sample(parameters)`: moments of one value with that noise.
template <class Sample>
void CheckMoments(const Case& device, double exact, Sample sample)
{
  const std::string prefix = device.prefix;
  const double s = device.scale;
  const double error = 4 * s / std::sqrt(kTicks);  // four standard errors
  const Moments gaussian = sample(TestParameters{{prefix + "noise_kind", "gaussian"},
                                                 {prefix + "noise_mean", std::to_string(0.5 * s)},
                                                 {prefix + "noise_deviation", std::to_string(s)}});
  EXPECT_NEAR(gaussian.mean, exact + 0.5 * s, error);
  EXPECT_NEAR(gaussian.deviation, s, error);
  const Moments uniform =
      sample(TestParameters{{prefix + "noise_kind", "uniform"}, {prefix + "noise_range", std::to_string(s)}});
  EXPECT_NEAR(uniform.mean, exact, error);
  EXPECT_NEAR(uniform.deviation, s / std::sqrt(3), error);
  EXPECT_GE(uniform.least, exact - s - 1e-12);
  EXPECT_LE(uniform.most, exact + s + 1e-12);
}

TEST(NoiseMoments, OfSensors)
{
  const auto nearest = [](const auto& sensor)
  {
    const CCI_ColourBlob* blob = sensor.GetNearestBlob(CCI_Colour::RED);
    EXPECT_NE(blob, nullptr);
    return blob == nullptr ? CCI_ColourBlob() : *blob;
  };
  const auto distance = Reads<CCI_ColourBlobSensor>([=](const auto& s) { return nearest(s).distance_m; });
  const auto angle = Reads<CCI_ColourBlobSensor>([=](const auto& s) { return nearest(s).angle_rad; });
  const SensorCase kCases[] = {
      {{"footbot_encoders", "engine_footbot_encoders", "", kFootbot, 0.2},
       Reads<CCI_FootBotEncodersSensor>([](const auto& s) { return s.GetRightVelocity(); })},
      {{"footbot_accelerometer", "engine_footbot_accelerometer", "", kFootbot, 0.3},
       Reads<CCI_FootBotAccelerometerSensor>([](const auto& s) { return s.GetAllSensorReadings()[1]; })},
      {{"footbot_turret_torque", "engine_footbot_turret_torque", "", kFootbot, 0.05},
       Reads<CCI_FootBotTurretTorqueSensor>([](const auto& s) { return s.GetTorque(); })},
      {{"footbot_turret_encoder", "generic_footbot_turret_encoder", "", kFootbot, 0.1},
       Reads<CCI_FootBotTurretEncoderSensor>([](const auto& s) { return s.GetTurretAngle(); })},
      {{"footbot_gripper", "generic_footbot_gripper", "", kFootbot, 0.05},
       Reads<CCI_FootBotGripperSensor>([](const auto& s) { return s.GetAperture(); })},
      {{"footbot_light", "generic_footbot_light", "", kFootbot, 0.02},
       Reads<CCI_FootBotLightSensor>([](const auto& s) { return s.GetLightSensorReading(5); })},
      {{"footbot_ground", "generic_footbot_ground", "", kFootbot, 0.05},
       Reads<CCI_FootBotGroundSensor>([](const auto& s) { return s.GetAllSensorReadings()[3]; })},
      {{"footbot_omnidirectional_camera", "generic_footbot_omnidirectional_camera", "angle_", kFootbot, 0.1}, angle},
      {{"eyebot_camera", "generic_eyebot_camera", "distance_", kEyebot, 0.02}, distance},
      {{"eyebot_camera", "generic_eyebot_camera", "angle_", kEyebot, 0.1}, angle},
      {{"handbot_camera", "generic_handbot_camera", "distance_", kHandbot, 0.02}, distance},
      {{"handbot_camera", "generic_handbot_camera", "angle_", kHandbot, 0.1}, angle},
      {{"handbot_camera", "generic_handbot_camera", "elevation_", kHandbot, 0.05},
       Reads<CCI_ColourBlobSensor>([=](const auto& s) { return nearest(s).elevation_rad; })},
      {{"pie_camera", "generic_pie_camera", "", kFootbot, 0.03},
       Reads<CCI_PieCameraSensor>([](const auto& s) { return s.GetSlice(CCI_Colour::RED, 0).distance_m; })},
      {{"range_and_bearing", "generic_range_and_bearing", "range_", kFootbot, 0.03},
       Reads<CCI_RangeAndBearingSensor>([](const auto& s) { return s.GetAllPackets()[0].range_m; })},
      {{"range_and_bearing", "generic_range_and_bearing", "bearing_", kFootbot, 0.1},
       Reads<CCI_RangeAndBearingSensor>([](const auto& s) { return s.GetAllPackets()[0].bearing_rad; })},
      {{"range_and_bearing", "generic_range_and_bearing", "vertical_bearing_", kFootbot, 0.1},
       Reads<CCI_RangeAndBearingSensor>([](const auto& s) { return s.GetAllPackets()[0].vertical_bearing_rad; })},
      {{"eyebot_altitude", "generic_eyebot_altitude", "", kEyebot, 0.1},
       Reads<CCI_EyeBotAltitudeSensor>([](const auto& s) { return s.GetAltitude(); })},
      {{"handbot_joints", "generic_handbot_joints", "", kHandbot, 0.1},
       Reads<CCI_HandBotJointsSensor>([](const auto& s) { return s.GetReading(CCI_HandBotJointsSensor::HEAD); })},
      {{"handbot_joints", "generic_handbot_joints", "", kHandbot, 0.1},
       Reads<CCI_HandBotJointsSensor>([](const auto& s) { return s.GetReading(CCI_HandBotJointsSensor::HAND_RIGHT); })},
  };
  for (const SensorCase& device : kCases)
  {
    SCOPED_TRACE(std::string(device.implementation) + " " + device.prefix);
    World world;
    const auto sample = [&](const TestParameters& parameters)
    {
      TestSensor sensor(world, device.type, device.implementation, {device.robot}, parameters);
      std::fill(sensor.values.begin(), sensor.values.end(), 0.1);
      return MomentsOf(world,
                       [&]
                       {
                         sensor.Update();
                         return device.value(*sensor.batch->Sensor(0));
                       });
    };
    CheckMoments(device, sample({}).mean, sample);
  }
}

template <class Interface, class Call>
auto Uses(Call call)
{
  return [call](CCI_Actuator& actuator) { call(dynamic_cast<Interface&>(actuator)); };
}

TEST(NoiseMoments, OfActuators)
{
  const auto fly = Uses<CCI_EyeBotPropellersActuator>([](auto& a) { a.SetVelocity(0.1, 0.2, 0.3, 0.4); });
  const auto grip = Uses<CCI_FootBotGripperActuator>([](auto& a) { a.SetGripper(0.6); });
  const auto turn = Uses<CCI_FootBotTurretActuator>([](auto& a) { a.SetTurretAngularVelocity(-1); });
  const auto move = Uses<CCI_HandBotArmsActuator>([](auto& a) { a.SetAllActuatorOutputs({1, -1, 0.5, 2}); });
  const auto nod = Uses<CCI_HandBotHeadActuator>([](auto& a) { a.SetHeadAngularVelocity(1); });
  const auto wind = Uses<CCI_HandBotRopeActuator>([](auto& a) { a.SetWinchVelocity(0.08); });
  const ActuatorCase kCases[] = {
      {{"footbot_gripper", "dummy_footbot_gripper", "", kFootbot, 0.05}, grip, 0},
      {{"footbot_turret", "dummy_footbot_turret", "", kFootbot, 0.1}, turn, 0},
      {{"eyebot_propellers", "dummy_eyebot_propellers", "", kEyebot, 0.05}, fly, 2},
      {{"eyebot_propellers", "position_eyebot_propellers", "", kEyebot, 0.05}, fly, 3},
      {{"handbot_arms", "dummy_handbot_arms", "", kHandbot, 0.1}, move, 4},
      {{"handbot_head", "dummy_handbot_head", "", kHandbot, 0.1}, nod, 0},
      {{"handbot_rope", "dummy_handbot_rope", "", kHandbot, 0.01}, wind, 1},
  };
  for (const ActuatorCase& device : kCases)
  {
    SCOPED_TRACE(device.implementation);
    World world;
    const auto sample = [&](const TestParameters& parameters)
    {
      TestActuator actuator(world, device.type, device.implementation, {device.robot}, parameters);
      device.use(*actuator.batch->Actuator(0));
      return MomentsOf(world,
                       [&]
                       {
                         actuator.Commit();
                         return actuator.values[device.place];
                       });
    };
    CheckMoments(device, sample({}).mean, sample);
  }
}

// Switches hold above half of their strength: normal noise of 0.5 with the mean -0.5 holds them half of the time.
TEST(NoiseMoments, NoiseOpensSwitchesForItsShareOfTheTime)
{
  World world;
  const TestParameters noise{{"noise_kind", "gaussian"}, {"noise_mean", "-0.5"}, {"noise_deviation", "0.5"}};
  TestActuator hands(world, "handbot_hands", "dummy_handbot_hands", {kHandbot}, noise);
  hands.Of<CCI_HandBotHandsActuator>(0).SetAllActuatorOutputs({false, true});
  TestActuator magnet(world, "eyebot_attachment", "dummy_eyebot_attachment", {kEyebot}, noise);
  magnet.Of<CCI_EyeBotAttachmentActuator>(0).Attach();
  int holds = 0, hangs = 0;
  for (std::uint64_t tick = 1; tick <= kTicks; ++tick)
  {
    world.Space().SetTick(tick);
    hands.Commit();
    magnet.Commit();
    ASSERT_EQ(hands.values[0], 0) << "told to open";
    for (const double value : {hands.values[1], magnet.values[0]}) ASSERT_TRUE(value >= 0 && value <= 1) << value;
    holds += hands.values[1] > 0.5;
    hangs += magnet.values[0] > 0.5;
  }
  EXPECT_NEAR(holds, kTicks / 2, 4 * std::sqrt(kTicks / 4));
  EXPECT_NEAR(hangs, kTicks / 2, 4 * std::sqrt(kTicks / 4));
}

TEST(NoiseMoments, OfTheLaser)
{
  World world;
  CSwarmanoidSpace& space = world.Space();
  TestActuator laser(world, "eyebot_laser", "generic_eyebot_laser", {kEyebot},
                     {{"noise_kind", "gaussian"}, {"noise_deviation", "0.02"}});
  laser.Of<CCI_EyeBotLaserActuator>(0).SetDirection(-0.5, 0.6);
  for (const auto& [attribute, exact] : {std::pair("laser_pan", -0.5), std::pair("laser_tilt", 0.6)})
  {
    const Moments moments = MomentsOf(world,
                                      [&]
                                      {
                                        laser.Commit();
                                        space.SetAttributes(laser.changes);
                                        return space.GetEntity(kEyebot).GetAttribute(attribute);
                                      });
    EXPECT_NEAR(moments.mean, exact, 4 * 0.02 / std::sqrt(kTicks)) << attribute;
    EXPECT_NEAR(moments.deviation, 0.02, 4 * 0.02 / std::sqrt(2 * kTicks)) << attribute;
  }
}

TEST(NoiseMoments, OfColours)
{
  World world;
  CSwarmanoidSpace& space = world.Space();
  TestActuator beacon(world, "footbot_beacon", "generic_footbot_beacon", {kFootbot},
                      {{"noise_kind", "gaussian"}, {"noise_mean", "4"}, {"noise_deviation", "3"}});
  beacon.Of<CCI_FootBotBeaconActuator>(0).SetColour(0x804020);
  for (const int shift : {16, 8})
  {
    const Moments moments =
        MomentsOf(world,
                  [&]
                  {
                    beacon.Commit();
                    space.SetAttributes(beacon.changes);
                    const auto colour = static_cast<std::uint32_t>(space.GetEntity(kFootbot).GetAttribute("beacon"));
                    return static_cast<double>(colour >> shift & 0xff);
                  });
    EXPECT_NEAR(moments.mean, (0x804020 >> shift & 0xff) + 4, 4 * 3 / std::sqrt(kTicks));
    EXPECT_NEAR(moments.deviation, std::sqrt(9 + 1.0 / 12), 4 * 3 / std::sqrt(2 * kTicks));  // whole numbers
  }
}

// Without noise, and with it, readings keep to what they can be.
TEST(NoiseMoments, ReadingsAreCutToTheirLimits)
{
  World world;
  const TestParameters noise{{"noise_kind", "uniform"}, {"noise_range", "5"}};
  TestSensor aperture(world, "footbot_gripper", "generic_footbot_gripper", {kFootbot}, noise);
  TestSensor torque(world, "footbot_turret_torque", "engine_footbot_turret_torque", {kFootbot}, noise);
  TestSensor altitude(world, "eyebot_altitude", "generic_eyebot_altitude", {kEyebot}, noise);
  bool cut_below = false, cut_above = false;
  for (std::uint64_t tick = 1; tick <= 100; ++tick)
  {
    world.Space().SetTick(tick);
    for (TestSensor* sensor : {&aperture, &torque, &altitude}) sensor->Update();
    const double open = aperture.Of<CCI_FootBotGripperSensor>(0).GetAperture();
    ASSERT_TRUE(open >= 0 && open <= CCI_FootBotGripperSensor::OPEN_APERTURE) << open;
    for (const double reading : torque.Of<CCI_FootBotTurretTorqueSensor>(0).GetAllSensorReadings())
      ASSERT_TRUE(reading >= -1 && reading <= 1) << reading;
    ASSERT_GE(altitude.Of<CCI_EyeBotAltitudeSensor>(0).GetAltitude(), 0);
    cut_below |= open == 0;
    cut_above |= open == CCI_FootBotGripperSensor::OPEN_APERTURE;
  }
  EXPECT_TRUE(cut_below && cut_above);
}

}  // namespace
}  // namespace swarmanoid

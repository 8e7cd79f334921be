// All devices, whatever they are: each has noise on what it reads or does, with the parameters that the documentation
// promises, from streams named by seed, robot, device and tick.
#include "common/control_interface/ci_battery_sensor.h"
#include "common/control_interface/ci_colour_blob_sensor.h"
#include "common/control_interface/ci_contact_sensor.h"
#include "common/control_interface/ci_depth_camera_sensor.h"
#include "common/control_interface/ci_distance_scanner_sensor.h"
#include "common/control_interface/ci_floor_field.h"
#include "common/control_interface/ci_functions_channel.h"
#include "common/control_interface/ci_ground_sensor.h"
#include "common/control_interface/ci_gyroscope_sensor.h"
#include "common/control_interface/ci_joints_actuator.h"
#include "common/control_interface/ci_joints_sensor.h"
#include "common/control_interface/ci_led_ring_actuator.h"
#include "common/control_interface/ci_light_sensor.h"
#include "common/control_interface/ci_microphone_sensor.h"
#include "common/control_interface/ci_pie_camera_sensor.h"
#include "common/control_interface/ci_positioning_sensor.h"
#include "common/control_interface/ci_proximity_sensor.h"
#include "common/control_interface/ci_radio.h"
#include "common/control_interface/ci_range_and_bearing.h"
#include "common/control_interface/ci_range_scanner_sensor.h"
#include "common/control_interface/ci_tag_reader_sensor.h"
#include "common/control_interface/ci_wheels_actuator.h"
#include "common/control_interface/eyebot/ci_eyebot_altitude_sensor.h"
#include "common/control_interface/eyebot/ci_eyebot_attachment_actuator.h"
#include "common/control_interface/eyebot/ci_eyebot_laser_actuator.h"
#include "common/control_interface/eyebot/ci_eyebot_leds_actuator.h"
#include "common/control_interface/eyebot/ci_eyebot_light_sensor.h"
#include "common/control_interface/eyebot/ci_eyebot_propellers_actuator.h"
#include "common/control_interface/footbot/ci_footbot_accelerometer_sensor.h"
#include "common/control_interface/footbot/ci_footbot_base_ground_sensor.h"
#include "common/control_interface/footbot/ci_footbot_beacon_actuator.h"
#include "common/control_interface/footbot/ci_footbot_encoders_sensor.h"
#include "common/control_interface/footbot/ci_footbot_gripper_actuator.h"
#include "common/control_interface/footbot/ci_footbot_gripper_sensor.h"
#include "common/control_interface/footbot/ci_footbot_ground_sensor.h"
#include "common/control_interface/footbot/ci_footbot_leds_actuator.h"
#include "common/control_interface/footbot/ci_footbot_light_sensor.h"
#include "common/control_interface/footbot/ci_footbot_motor_ground_sensor.h"
#include "common/control_interface/footbot/ci_footbot_preferential_direction_actuator.h"
#include "common/control_interface/footbot/ci_footbot_proximity_sensor.h"
#include "common/control_interface/footbot/ci_footbot_turning_scanner_sensor.h"
#include "common/control_interface/footbot/ci_footbot_turret_actuator.h"
#include "common/control_interface/footbot/ci_footbot_turret_encoder_sensor.h"
#include "common/control_interface/footbot/ci_footbot_turret_torque_sensor.h"
#include "common/control_interface/footbot/ci_footbot_wheels_actuator.h"
#include "common/control_interface/handbot/ci_handbot_arms_actuator.h"
#include "common/control_interface/handbot/ci_handbot_beacon_actuator.h"
#include "common/control_interface/handbot/ci_handbot_hands_actuator.h"
#include "common/control_interface/handbot/ci_handbot_head_actuator.h"
#include "common/control_interface/handbot/ci_handbot_joints_sensor.h"
#include "common/control_interface/handbot/ci_handbot_leds_actuator.h"
#include "common/control_interface/handbot/ci_handbot_proximity_sensor.h"
#include "common/control_interface/handbot/ci_handbot_rope_actuator.h"
#include "tests/unit/devices/test_world.h"
#include "tests/unit/engines/jointed_robots.h"

namespace swarmanoid
{
namespace
{

constexpr std::uint32_t kColour = 0x804020;
constexpr std::uint32_t kFootbotPlace = 0, kHandbotPlace = 2, kEyebotPlace = 3, kCartPlace = 11;

// Something for every sensor to see: robots that are lit and send, a light, a prey, a patch, an eyebot above. With
// `others_first` two entities stand before them in the file, out of sight.
class FullWorld : public TestWorld
{
public:
  explicit FullWorld(std::uint64_t seed, int tick, bool others_first = false)
  {
    const std::uint32_t others = others_first ? 2 : 0;
    if (others_first)
    {
      AddBlock({9.8, 0.2, 0.1}, {0.1, 0.1, 0.1});
      AddFootbot(9.5, 9.5);
    }
    Configuration().seed = seed;
    Configuration().arena_size = {10, 10, 3};
    FloorFieldConfiguration field;
    field.id = "trail";
    field.cell_m = 0.5;
    field.columns = field.rows = 20;
    Configuration().floor_fields = {field};
    AddFootbot(5, 5);
    AddFootbot(5.2, 5);
    Add(EntityKind::kHandbot, {4.6, 5.1, 0}, 0, {0.22, 0.17, 0.16});
    AddEyebot(5, 5.5, 2);
    Add(EntityKind::kLightBulb, {4.9, 4, 0.5}, 0, {0, 0, 0}, false);
    AddPrey(4.95, 5.35, 0.05, 0.1);
    // The patch has a grey that is almost white.
    const auto floor = Add(EntityKind::kGroundPatch, {5, 5, 0}, 0, {2, 2, 0}, false, -1);
    Configuration().entities[floor].colour = 0x808080;
    AddPrey(4.8727, 4.9537, 0.05, 0.1);  // touches the first footbot
    AddBlock({7, 5.5, 2.1}, {0.2, 1, 0.4});
    Add(EntityKind::kSoundSource, {6, 6, 0.3}, 0, {0, 0, 0}, false, -1);
    AddBlock({4.83, 5.12, 0.1}, {0.06, 0.01, 0.02});  // beside the claws of the handbot's left hand
    Add(test::CartWithArm(), {9, 1, 0}, 0, DescriptionOf(test::CartWithArm()).size);
    for (std::uint32_t e = 0; e < Configuration().entities.size(); ++e)
      Configuration().entities[e].id = e < others ? "other" + std::to_string(e) : "e" + std::to_string(e - others);
    for (const std::uint32_t robot : {kFootbotPlace, 1U, kHandbotPlace, kEyebotPlace})
    {
      CSwarmanoidSpaceEntity& entity = Space().GetEntity(robot + others);
      for (int led = 0; led < 12; ++led) entity.SetAttribute("led", kColour, led);
      entity.SetAttribute("message", 1);
      entity.SetAttribute("radio", 1);
    }
    Space().GetEntity(1 + others).SetAttribute("beacon", kColour);  // high enough for the camera that looks ahead
    Space().GetEntity(4 + others).SetAttribute("intensity", 1);
    Space().GetEntity(kFootbotPlace + others).SetAttribute("gripper_aperture", 0.8);
    Space().SetTick(static_cast<std::uint64_t>(tick));
  }
};

std::vector<double> Copied(std::span<const double> values) { return {values.begin(), values.end()}; }

template <class Interface>
const Interface* As(const CCI_Sensor& sensor)
{
  return dynamic_cast<const Interface*>(&sensor);
}

std::vector<double> ReadingsOf(const CCI_Sensor& sensor)
{
  std::vector<double> all;
  if (const auto* s = As<CCI_FootBotProximitySensor>(sensor)) return Copied(s->GetAllSensorReadings());
  if (const auto* s = As<CCI_FootBotLightSensor>(sensor)) return Copied(s->GetAllSensorReadings());
  if (const auto* s = As<CCI_FootBotGroundSensor>(sensor)) return Copied(s->GetAllSensorReadings());
  if (const auto* s = As<CCI_FootBotBaseGroundSensor>(sensor)) return Copied(s->GetAllSensorReadings());
  if (const auto* s = As<CCI_FootBotMotorGroundSensor>(sensor)) return Copied(s->GetAllSensorReadings());
  if (const auto* s = As<CCI_EyeBotLightSensor>(sensor)) return Copied(s->GetAllSensorReadings());
  if (const auto* s = As<CCI_LightSensor>(sensor)) return Copied(s->GetAllSensorReadings());
  if (const auto* s = As<CCI_ProximitySensor>(sensor)) return Copied(s->GetAllSensorReadings());
  if (const auto* s = As<CCI_GroundSensor>(sensor)) return Copied(s->GetAllSensorReadings());
  if (const auto* s = As<CCI_FootBotTurretTorqueSensor>(sensor)) return Copied(s->GetAllSensorReadings());
  if (const auto* s = As<CCI_FootBotEncodersSensor>(sensor)) return Copied(s->GetAllSensorReadings());
  if (const auto* s = As<CCI_FootBotAccelerometerSensor>(sensor)) return Copied(s->GetAllSensorReadings());
  if (const auto* s = As<CCI_HandBotJointsSensor>(sensor)) return Copied(s->GetAllSensorReadings());
  if (const auto* s = As<CCI_JointsSensor>(sensor)) return Copied(s->GetAllSensorReadings());
  if (const auto* s = As<CCI_HandBotProximitySensor>(sensor)) return Copied(s->GetAllSensorReadings());
  if (const auto* s = As<CCI_FootBotGripperSensor>(sensor)) return {s->GetAperture()};
  if (const auto* s = As<CCI_FootBotTurretEncoderSensor>(sensor)) return {s->GetTurretAngle()};
  if (const auto* s = As<CCI_EyeBotAltitudeSensor>(sensor)) return {s->GetAltitude()};
  if (const auto* s = As<CCI_InstructionSensor>(sensor)) return {s->IsNew() ? 1.0 : 0.0};
  if (const auto* s = As<CCI_GyroscopeSensor>(sensor)) return Copied(s->GetAllSensorReadings());
  if (const auto* s = As<CCI_BatterySensor>(sensor)) return {s->GetCharge()};
  if (const auto* s = As<CCI_ContactSensor>(sensor)) return Copied(s->GetAllContacts());
  if (const auto* s = As<CCI_PositioningSensor>(sensor))
  {
    const Vector3 place = s->GetPosition();
    return {place.x(), place.y(), place.z(), s->GetHeading()};
  }
  if (const auto* s = As<CCI_MicrophoneSensor>(sensor))
  {
    all.push_back(s->GetLoudness());
    for (const auto& sound : s->GetAllSounds())
      for (const double value : {sound.loudness, sound.bearing_rad, sound.elevation_rad}) all.push_back(value);
    return all;
  }
  if (const auto* s = As<CCI_DistanceScannerSensor>(sensor))
  {
    for (const auto& reading : s->GetAllReadings()) all.push_back(reading.distance_m);
    return all;
  }
  if (const auto* s = As<CCI_DepthCameraSensor>(sensor))
  {
    for (const auto& pixel : s->GetAllPixels())
    {
      all.push_back(std::min(pixel.depth_m, 99.0));
      all.push_back(pixel.colour);
    }
    return all;
  }
  if (const auto* s = As<CCI_RangeScannerSensor>(sensor))
  {
    for (const double distance : s->GetAllDistances()) all.push_back(std::min(distance, 99.0));
    return all;
  }
  if (const auto* s = As<CCI_TagReaderSensor>(sensor))
  {
    for (const auto& tag : s->GetAllTags()) all.push_back(tag.distance_m);
    return all;
  }
  if (const auto* s = As<CCI_RadioSensor>(sensor))
  {
    for (const auto& packet : s->GetAllPackets()) all.push_back(packet.signal_db);
    return all;
  }
  if (const auto* s = As<CCI_ColourBlobSensor>(sensor))
  {
    for (const CCI_ColourBlob& blob : s->GetAllBlobs())
      for (const double value : {blob.distance_m, blob.angle_rad, blob.elevation_rad}) all.push_back(value);
    return all;
  }
  if (const auto* s = As<CCI_PieCameraSensor>(sensor))
  {
    for (const std::uint32_t colour : {CCI_Colour::RED, CCI_Colour::YELLOW})
      for (const auto& slice : s->GetAllSlices(colour)) all.push_back(std::min(slice.distance_m, 99.0));
    return all;
  }
  if (const auto* s = As<CCI_RangeAndBearingSensor>(sensor))
  {
    for (const auto& packet : s->GetAllPackets())
      for (const double value : {packet.range_m, packet.bearing_rad, packet.vertical_bearing_rad}) all.push_back(value);
    return all;
  }
  if (const auto* s = As<CCI_FloorFieldSensor>(sensor))
  {
    for (const auto& reading : s->GetReadings())
      for (const double value : {reading.value, reading.gradient_x, reading.gradient_y}) all.push_back(value);
    return all;
  }
  ADD_FAILURE() << "a sensor that this test does not know";
  return all;
}

template <class Interface>
Interface* As(CCI_Actuator& actuator)
{
  return dynamic_cast<Interface*>(&actuator);
}

// Gives an actuator a command that is not 0.
void Use(CCI_Actuator& actuator)
{
  if (auto* a = As<CCI_FootBotWheelsActuator>(actuator)) return a->SetFootBotWheelsLinearVelocity(0.1, 0.2);
  if (auto* a = As<CCI_WheelsActuator>(actuator)) return a->SetLinearVelocity(0.1, 0.2);
  if (auto* a = As<CCI_JointsActuator>(actuator)) return a->SetPosition(0, 0.1);
  if (auto* a = As<CCI_FootBotGripperActuator>(actuator)) return a->SetGripper(1);
  if (auto* a = As<CCI_FootBotTurretActuator>(actuator)) return a->SetTurretAngularVelocity(1);
  if (auto* a = As<CCI_FootBotLedsActuator>(actuator)) return a->SetAllColours(0x205040);
  if (auto* a = As<CCI_FootBotBeaconActuator>(actuator)) return a->SetColour(kColour);
  if (auto* a = As<CCI_FootBotPreferentialDirectionActuator>(actuator)) return a->SetDirection(1, 0x205040);
  if (auto* a = As<CCI_EyeBotPropellersActuator>(actuator)) return a->SetVelocity(0.1, 0.2, 0.3, 0.4);
  if (auto* a = As<CCI_EyeBotAttachmentActuator>(actuator)) return a->Attach();
  if (auto* a = As<CCI_EyeBotLedsActuator>(actuator)) return a->SetAllColours(0x205040);
  if (auto* a = As<CCI_EyeBotLaserActuator>(actuator)) return a->SetDirection(0.5, 0.6);
  if (auto* a = As<CCI_HandBotHeadActuator>(actuator)) return a->SetHeadAngularVelocity(1);
  if (auto* a = As<CCI_HandBotArmsActuator>(actuator)) return a->SetArmVelocities(1, 2);
  if (auto* a = As<CCI_HandBotHandsActuator>(actuator)) return a->Close(CCI_HandBotHandsActuator::LEFT);
  if (auto* a = As<CCI_HandBotRopeActuator>(actuator)) return a->SetWinchVelocity(0.1);
  if (auto* a = As<CCI_HandBotLedsActuator>(actuator)) return a->SetAllColours(0x205040);
  if (auto* a = As<CCI_HandBotBeaconActuator>(actuator)) return a->SetColour(kColour);
  if (auto* a = As<CCI_RangeAndBearingActuator>(actuator)) return a->SetMessage({9, 99, 199, 1, 2, 3, 4, 5, 6, 70});
  if (auto* a = As<CCI_ReportActuator>(actuator)) return a->Report(12.5);
  if (auto* a = As<CCI_RadioActuator>(actuator))
  {
    a->Send(std::array<std::uint8_t, 3>{9, 99, 199});
    return;
  }
  if (auto* a = As<CCI_LedRingActuator>(actuator)) return a->SetAllColours(0x205040);
  ADD_FAILURE() << "an actuator that this test does not know";
}

std::uint32_t RobotFor(const PluginDescription& device)
{
  if (device.robots.empty()) return kFootbotPlace;
  const std::string& robot = device.robots.front();
  if (robot == "kinds with joints") return kCartPlace;
  return robot == "footbot" ? kFootbotPlace : robot == "eyebot" ? kEyebotPlace : kHandbotPlace;
}

struct Run
{
  std::uint64_t seed = 7;
  int tick = 1;
  bool others_first = false;
};

std::vector<double> OutcomeOf(const SensorBatch&, const PluginDescription& device, const TestParameters& parameters,
                              const Run& run)
{
  FullWorld world(run.seed, run.tick, run.others_first);
  TestSensor sensor(world, device.label, device.implementation, {RobotFor(device) + (run.others_first ? 2 : 0)},
                    parameters);
  std::fill(sensor.values.begin(), sensor.values.end(), 0.1);
  // The scanner is off until the first command.
  if (auto* scanner = dynamic_cast<CCI_FootBotTurningScannerSensor*>(sensor.batch->Sensor(0))) scanner->Look(0);
  sensor.Update();
  return ReadingsOf(*sensor.batch->Sensor(0));
}

std::vector<double> OutcomeOf(const ActuatorBatch&, const PluginDescription& device, const TestParameters& parameters,
                              const Run& run)
{
  FullWorld world(run.seed, run.tick, run.others_first);
  TestActuator actuator(world, device.label, device.implementation, {RobotFor(device) + (run.others_first ? 2 : 0)},
                        parameters);
  Use(*actuator.batch->Actuator(0));
  actuator.Commit();
  std::vector<double> outcome = actuator.values;
  const std::uint32_t robot = RobotFor(device) + (run.others_first ? 2 : 0);
  const std::uint32_t first_slot = world.Space().GetEntity(robot).FirstSlot();
  for (std::size_t i = 0; i < actuator.changes.slots.size(); ++i)
  {
    outcome.push_back(actuator.changes.slots[i] - first_slot);
    outcome.push_back(actuator.changes.values[i]);
  }
  return outcome;
}

// Returns a noise that makes a clear difference in a unit.
double LargeIn(const std::string& unit)
{
  return unit == "1/255" ? 20 : unit == "pixels" ? 5 : unit == "rad" ? 0.5 : 0.05;
}

bool AreNear(const std::vector<double>& a, const std::vector<double>& b)
{
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](double x, double y) { return std::abs(x - y) < 1e-6; });
}

template <class Interface>
void CheckNoiseOfAll()
{
  for (const auto& [name, entry] : PluginRegistry<Interface>::Instance().Entries())
  {
    const PluginDescription& device = entry.description;
    // Other tests of this program register these.
    if (device.label.starts_with("commands_test") || device.implementation == "faults_closed") continue;
    // Its rates have places only for robots whose controllers deposit: floor_field_simulator_test.cpp has its noise.
    if (std::is_same_v<Interface, ActuatorBatch> && device.label == "floor_field") continue;
    // The charge has a place only for robots whose controllers have the sensor: battery_test.cpp has its noise.
    if (device.implementation == "energy_battery") continue;
    SCOPED_TRACE(device.label + " / " + device.implementation);
    EXPECT_FALSE(device.brief.empty());
    const auto batch = entry.create();
    const auto outcome = [&](TestParameters parameters, const Run& run = {})
    {
      // It would see the others as well.
      if (device.label == "range_scanner") parameters.emplace_back("range", "2");
      // In few slots all packets would collide.
      if (device.implementation.starts_with("shared_")) parameters.emplace_back("slots", "1000000");
      return OutcomeOf(*batch, device, parameters, run);
    };
    const std::vector<double> exact = outcome({});
    EXPECT_FALSE(exact.empty());
    EXPECT_EQ(outcome({}, {8, 2}), exact);  // without noise nothing is random

    int kinds = 0;
    for (const ParameterSpec& parameter : device.parameters)
    {
      constexpr std::string_view kSuffix = "noise_kind";
      if (!parameter.name.ends_with(kSuffix)) continue;
      ++kinds;
      const std::string prefix = parameter.name.substr(0, parameter.name.size() - kSuffix.size());
      SCOPED_TRACE(prefix);
      const auto range = std::find_if(device.parameters.begin(), device.parameters.end(),
                                      [&](const ParameterSpec& p) { return p.name == prefix + "noise_range"; });
      ASSERT_NE(range, device.parameters.end());
      const std::string large = std::to_string(LargeIn(range->unit));

      const TestParameters uniform{{prefix + "noise_kind", "uniform"}, {prefix + "noise_range", large}};
      const std::vector<double> noisy = outcome(uniform);
      // Where values are at the border of what they may be, half of the noise is cut off.
      const auto differs = [&](const TestParameters& parameters)
      {
        bool found = false;
        for (int tick = 1; tick < 9; ++tick) found |= outcome(parameters, {7, tick}) != exact;
        return found;
      };
      EXPECT_TRUE(differs(uniform));
      EXPECT_EQ(noisy, outcome(uniform)) << "the same seed and tick";
      bool differs_by_seed = false, differs_by_tick = false;
      for (int n = 1; n < 9; ++n)
      {
        differs_by_seed |= outcome(uniform, {7 + static_cast<std::uint64_t>(n), 1}) != noisy;
        differs_by_tick |= outcome(uniform, {7, 1 + n}) != noisy;
      }
      EXPECT_EQ(noisy, outcome(uniform, {.others_first = true})) << "entities before it in the file";
      EXPECT_TRUE(differs_by_seed);
      EXPECT_TRUE(differs_by_tick);

      const TestParameters gaussian{{prefix + "noise_kind", "gaussian"}, {prefix + "noise_deviation", large}};
      EXPECT_TRUE(differs(gaussian));
      TestParameters cut = gaussian;
      cut.emplace_back(prefix + "noise_range", "1e-9");
      EXPECT_TRUE(AreNear(outcome(cut), exact)) << "Gaussian noise cut to almost nothing";

      const TestParameters shift{{prefix + "noise_kind", "uniform"}, {prefix + "noise_mean", "-" + large}};
      EXPECT_NE(outcome(shift), exact);
      EXPECT_EQ(outcome(shift), outcome(shift, {8, 2})) << "a mean alone is not random";
    }
    // Talk with the experiment functions is not of this world.
    const bool is_talk = device.label == "report" || device.label == "instruction";
    EXPECT_EQ(kinds == 0, is_talk) << "a device without noise";
  }
}

TEST(NoiseSweep, AllSensorsHaveNoise)
{
  RegisterBuiltinDevices();
  CheckNoiseOfAll<SensorBatch>();
}

TEST(NoiseSweep, AllActuatorsHaveNoise)
{
  RegisterBuiltinDevices();
  CheckNoiseOfAll<ActuatorBatch>();
}

// A gripper's sensor and actuator have one name. The draws of one of them reveal nothing about the other's.
TEST(NoiseSweep, SensorAndActuatorOfOneNameDrawDifferentNumbers)
{
  const TestParameters noise{{"noise_kind", "uniform"}, {"noise_range", "0.05"}, {"noise_mean", "-0.1"}};
  FullWorld world(7, 1);
  TestActuator actuator(world, "footbot_gripper", "dummy_footbot_gripper", {kFootbotPlace}, noise);
  actuator.Of<CCI_FootBotGripperActuator>(0).SetGripper(1);
  actuator.Commit();
  TestSensor sensor(world, "footbot_gripper", "generic_footbot_gripper", {kFootbotPlace}, noise);
  sensor.Update();
  const double drawn = actuator.values[0] - 1;
  EXPECT_GT(std::abs(drawn - sensor.Of<CCI_FootBotGripperSensor>(0).GetAperture()), 1e-6);
}

}  // namespace
}  // namespace swarmanoid

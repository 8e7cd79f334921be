// The plain devices: what controllers set reaches the channel or the attributes, what engines report reaches
// controllers.
#include "common/control_interface/ci_robot.h"
#include "common/control_interface/eyebot/ci_eyebot_attachment_actuator.h"
#include "common/control_interface/eyebot/ci_eyebot_laser_actuator.h"
#include "common/control_interface/eyebot/ci_eyebot_leds_actuator.h"
#include "common/control_interface/eyebot/ci_eyebot_propellers_actuator.h"
#include "common/control_interface/footbot/ci_footbot_accelerometer_sensor.h"
#include "common/control_interface/footbot/ci_footbot_beacon_actuator.h"
#include "common/control_interface/footbot/ci_footbot_encoders_sensor.h"
#include "common/control_interface/footbot/ci_footbot_gripper_actuator.h"
#include "common/control_interface/footbot/ci_footbot_gripper_sensor.h"
#include "common/control_interface/footbot/ci_footbot_leds_actuator.h"
#include "common/control_interface/footbot/ci_footbot_preferential_direction_actuator.h"
#include "common/control_interface/footbot/ci_footbot_turret_actuator.h"
#include "common/control_interface/footbot/ci_footbot_turret_encoder_sensor.h"
#include "common/control_interface/footbot/ci_footbot_turret_torque_sensor.h"
#include "common/control_interface/handbot/ci_handbot_arms_actuator.h"
#include "common/control_interface/handbot/ci_handbot_hands_actuator.h"
#include "common/control_interface/handbot/ci_handbot_head_actuator.h"
#include "common/control_interface/handbot/ci_handbot_joints_sensor.h"
#include "common/control_interface/handbot/ci_handbot_leds_actuator.h"
#include "common/control_interface/handbot/ci_handbot_rope_actuator.h"
#include "tests/unit/devices/test_world.h"

namespace swarmanoid
{
namespace
{

std::uint32_t AddHandbot(TestWorld& world) { return world.Add(EntityKind::kHandbot, {3, 3, 0}, 0, {0.18, 0.17, 0.16}); }

TEST(ValueDevices, GripperSendsHowFarItIsClosedAndReportsWhatItHolds)
{
  TestWorld world;
  world.AddFootbot(1, 1);
  world.AddFootbot(2, 1);
  const auto prey = world.AddPrey(3, 1, 0.1, 0.1);
  TestActuator actuator(world, "footbot_gripper", "dummy_footbot_gripper", {0, 1});
  actuator.Of<CCI_FootBotGripperActuator>(1).Grip();
  actuator.Commit();
  EXPECT_EQ(actuator.values, (std::vector<double>{0, 1}));
  actuator.Of<CCI_FootBotGripperActuator>(1).SetGripper(-3);
  actuator.Commit();
  EXPECT_EQ(actuator.values[1], 0);

  TestSensor sensor(world, "footbot_gripper", "generic_footbot_gripper", {0, 1});
  world.Space().GetEntity(1).SetAttribute("gripped", prey + 1);
  world.Space().GetEntity(1).SetAttribute("gripper_aperture", 0.25);
  sensor.Update();
  EXPECT_FALSE(sensor.Of<CCI_FootBotGripperSensor>(0).IsGripping());
  EXPECT_TRUE(sensor.Of<CCI_FootBotGripperSensor>(1).IsGripping());
  EXPECT_EQ(sensor.Of<CCI_FootBotGripperSensor>(1).GetAperture(), 0.25);
  EXPECT_EQ(sensor.Of<CCI_FootBotGripperSensor>(0).GetHeldId(), "");
  EXPECT_EQ(sensor.Of<CCI_FootBotGripperSensor>(1).GetHeldId(), world.Space().GetEntity(prey).GetId());
}

TEST(ValueDevices, TurretTurnsAtClampedSpeedAndKnowsAngleAndTorque)
{
  TestWorld world;
  world.AddFootbot(1, 1);
  TestActuator motor(world, "footbot_turret", "dummy_footbot_turret", {0}, {{"max_speed", "2"}});
  motor.Of<CCI_FootBotTurretActuator>(0).SetTurretAngularVelocity(-7);
  motor.Commit();
  EXPECT_EQ(motor.values[0], -2);

  TestSensor encoder(world, "footbot_turret_encoder", "generic_footbot_turret_encoder", {0});
  world.Space().GetEntity(0).SetAttribute("turret_angle", 4);
  encoder.Update();
  EXPECT_NEAR(encoder.Of<CCI_FootBotTurretEncoderSensor>(0).GetTurretAngle(), 4 - 2 * kPi, 1e-12);

  TestSensor torque(world, "footbot_turret_torque", "engine_footbot_turret_torque", {0});
  torque.values = {0.5, -1, 0.25};
  torque.Update();
  const auto& readings = torque.Of<CCI_FootBotTurretTorqueSensor>(0);
  EXPECT_EQ(readings.GetForwardTraction(), 0.5);
  EXPECT_EQ(readings.GetLeftTraction(), -1);
  EXPECT_EQ(readings.GetTorque(), 0.25);
}

TEST(ValueDevices, EncodersAndAccelerometerPassOnTheEngineWithNoise)
{
  TestWorld world;
  world.AddFootbot(1, 1);
  world.AddFootbot(2, 1);
  TestSensor encoders(world, "footbot_encoders", "engine_footbot_encoders", {0, 1});
  encoders.values = {0.01, 0.02, 0.03, 0.04};  // m in a tick of 0.1 s
  encoders.Update();
  EXPECT_NEAR(encoders.Of<CCI_FootBotEncodersSensor>(1).GetLeftVelocity() * 0.029112741, 0.3, 1e-15);
  EXPECT_NEAR(encoders.Of<CCI_FootBotEncodersSensor>(0).GetRightDistance(0.1), 0.02, 1e-15);

  TestSensor accelerometer(world, "footbot_accelerometer", "engine_footbot_accelerometer", {0},
                           {{"noise_kind", "gaussian"}, {"noise_mean", "1"}, {"noise_deviation", "0.5"}});
  accelerometer.values = {0, 0, 9.81};
  double sum = 0, squares = 0;
  constexpr int kTicks = 20000;
  for (int tick = 0; tick < kTicks; ++tick)
  {
    world.Space().SetTick(static_cast<std::uint64_t>(tick));
    accelerometer.Update();
    const double error = accelerometer.Of<CCI_FootBotAccelerometerSensor>(0).GetAllSensorReadings()[2] - 9.81;
    sum += error;
    squares += error * error;
  }
  const double mean = sum / kTicks;
  EXPECT_NEAR(mean, 1, 4 * 0.5 / std::sqrt(kTicks));
  EXPECT_NEAR(std::sqrt(squares / kTicks - mean * mean), 0.5, 4 * 0.5 / std::sqrt(2.0 * kTicks));
}

TEST(ValueDevices, LedsChangeOnlyTheSlotsThatDiffer)
{
  TestWorld world;
  world.AddFootbot(1, 1);
  world.AddFootbot(2, 1);
  TestActuator leds(world, "footbot_leds", "generic_footbot_leds", {0, 1});
  auto& ring = leds.Of<CCI_FootBotLedsActuator>(1);
  ring.SetAllColours(CCI_Colour::RED);
  ring.SetColour(3, 0);
  EXPECT_THROW(ring.SetColour(12, 0), std::out_of_range);
  leds.Commit();
  EXPECT_EQ(leds.changes.slots.size(), 11U);
  EXPECT_TRUE(std::is_sorted(leds.changes.slots.begin(), leds.changes.slots.end()));
  world.Space().SetAttributes(leds.changes);
  EXPECT_EQ(world.Space().GetEntity(1).GetAttribute("led", 0), 0xff0000);
  EXPECT_EQ(world.Space().GetEntity(1).GetAttribute("led", 3), 0);
  EXPECT_EQ(world.Space().GetEntity(0).GetAttribute("led", 0), 0);
  leds.Commit();
  EXPECT_TRUE(leds.changes.slots.empty());

  TestActuator beacon(world, "footbot_beacon", "generic_footbot_beacon", {0});
  beacon.Of<CCI_FootBotBeaconActuator>(0).SetColour(0x123456);
  beacon.Commit();
  world.Space().SetAttributes(beacon.changes);
  EXPECT_EQ(world.Space().GetEntity(0).GetAttribute("beacon"), 0x123456);
}

TEST(ValueDevices, RingsOfTheOtherRobotsHaveTheirOwnSizes)
{
  TestWorld world;
  world.AddEyebot(1, 1, 1);
  AddHandbot(world);
  TestActuator eyebot(world, "eyebot_leds", "generic_eyebot_leds", {0});
  TestActuator handbot(world, "handbot_leds", "generic_handbot_leds", {1});
  EXPECT_EQ(eyebot.Of<CCI_LedRingActuator>(0).GetNumLeds(), 16U);
  eyebot.Of<CCI_EyeBotLedsActuator>(0).SetColour(15, CCI_Colour::GREEN);
  handbot.Of<CCI_HandBotLedsActuator>(0).SetAllColours(CCI_Colour::BLUE);
  eyebot.Commit();
  handbot.Commit();
  EXPECT_EQ(eyebot.changes.slots, std::vector<std::uint32_t>{world.Space().GetEntity(0).SlotOf("led", 15)});
  EXPECT_EQ(handbot.changes.slots.size(), 12U);
}

// Noise leaves the LEDs of one colour together, so that cameras see them as one blob.
TEST(ValueDevices, NoiseGivesLedsOfOneColourOneColour)
{
  TestWorld world;
  world.AddFootbot(1, 1);
  world.AddFootbot(2, 1);
  TestActuator leds(world, "footbot_leds", "generic_footbot_leds", {0, 1},
                    {{"noise_kind", "uniform"}, {"noise_range", "30"}});
  for (std::size_t k = 0; k < 2; ++k)
  {
    auto& ring = leds.Of<CCI_FootBotLedsActuator>(k);
    ring.SetAllColours(0x804040);
    ring.SetColour(3, 0x408040);
    ring.SetColour(7, 0);
    ring.SetColour(9, 0x408040);
  }
  leds.Commit();
  world.Space().SetAttributes(leds.changes);
  const auto shown = [&](std::uint32_t robot, int led)
  { return world.Space().GetEntity(robot).GetAttribute("led", led); };
  for (const int led : {1, 2, 4, 5, 6, 8, 10, 11}) EXPECT_EQ(shown(0, led), shown(0, 0));
  EXPECT_EQ(shown(0, 9), shown(0, 3));
  EXPECT_EQ(shown(0, 7), 0);
  EXPECT_NE(shown(0, 0), 0x804040);
  EXPECT_NE(shown(0, 3), 0x408040);
  EXPECT_NE(shown(0, 0), shown(1, 0)) << "another robot draws other numbers";
}

TEST(ValueDevices, PreferentialDirectionLightsTheLedsThatPointThereWhateverTheTurret)
{
  TestWorld world;
  world.AddFootbot(1, 1);
  TestActuator device(world, "footbot_preferential_direction", "led_ring_preferential_direction", {0});
  auto& direction = device.Of<CCI_FootBotPreferentialDirectionActuator>(0);
  const auto lit = [&]
  {
    device.Commit();
    world.Space().SetAttributes(device.changes);
    std::vector<int> leds;
    for (int led = 0; led < 12; ++led)
      if (world.Space().GetEntity(0).GetAttribute("led", led) != 0) leds.push_back(led);
    return leds;
  };
  direction.SetDirection(kPi / 2, CCI_Colour::YELLOW);  // LED 2 is at 75 degrees, LED 3 at 105
  EXPECT_EQ(lit(), (std::vector<int>{2, 3}));
  world.Space().GetEntity(0).SetAttribute("turret_angle", kPi / 2);
  EXPECT_EQ(lit(), (std::vector<int>{0, 11}));
  EXPECT_THROW(direction.SetDirection(__builtin_nan(""), CCI_Colour::RED), CCI_DeviceError);
  direction.HideDirection();
  EXPECT_TRUE(lit().empty());
}

TEST(ValueDevices, PropellersFlyByVelocityWithinTheirLimits)
{
  TestWorld world;
  world.AddEyebot(1, 1, 1);
  TestActuator device(world, "eyebot_propellers", "dummy_eyebot_propellers", {0}, {{"max_speed", "0.5"}});
  auto& propellers = device.Of<CCI_EyeBotPropellersActuator>(0);
  propellers.SetVelocity(0.1, -2, 3, 1);
  device.Commit();
  EXPECT_EQ(device.values, (std::vector<double>{0.1, -0.5, 0.5, 1}));
  EXPECT_THROW(propellers.SetPosition({0, 0, 0}, 0), CCI_DeviceError);
}

TEST(ValueDevices, PositionControlReachesItsTarget)
{
  TestWorld world;
  world.AddEyebot(1, 1, 1, 2.0);
  TestActuator device(world, "eyebot_propellers", "position_eyebot_propellers", {0});
  const Vector3 target(4, 3, 2);
  device.Of<CCI_EyeBotPropellersActuator>(0).SetPosition(target, -2.5);
  CSwarmanoidSpace& space = world.Space();
  for (int tick = 0; tick < 300; ++tick)
  {
    device.Commit();
    for (const double v : {device.values[0], device.values[1], device.values[2]}) ASSERT_LE(std::abs(v), 1);
    ASSERT_TRUE(tick > 0 || device.values[3] > 0) << "not the short way round";
    // An engine that follows the velocities exactly.
    Pose pose = space.GetPose(0);
    const double yaw = YawOf(pose.orientation);
    const Vector3 body(device.values[0], device.values[1], device.values[2]);
    pose.position += 0.1 * (QuaternionFromYaw(yaw) * body);
    pose.orientation = QuaternionFromYaw(yaw + 0.1 * device.values[3]);
    space.SetPose(0, pose);
  }
  EXPECT_LT((space.GetPose(0).position - target).norm(), 1e-6);
  EXPECT_NEAR(YawOf(space.GetPose(0).orientation), -2.5, 1e-6);
}

TEST(ValueDevices, LaserAndMagnetOfTheEyebot)
{
  TestWorld world;
  world.AddEyebot(1, 1, 1);
  TestActuator device(world, "eyebot_laser", "generic_eyebot_laser", {0});
  auto& laser = device.Of<CCI_EyeBotLaserActuator>(0);
  laser.SwitchOn();
  laser.SetDirection(3 * kPi, 5);
  laser.SetColour(CCI_Colour::GREEN);
  device.Commit();
  world.Space().SetAttributes(device.changes);
  const auto& eyebot = dynamic_cast<const CEyeBotEntity&>(world.Space().GetEntity(0));
  EXPECT_TRUE(eyebot.IsLaserOn());
  EXPECT_EQ(eyebot.GetLaserColour(), CCI_Colour::GREEN);
  EXPECT_NEAR(std::abs(eyebot.GetAttribute("laser_pan")), kPi, 1e-12);
  EXPECT_EQ(eyebot.GetAttribute("laser_tilt"), CCI_EyeBotLaserActuator::MAX_TILT);

  TestActuator magnet(world, "eyebot_attachment", "dummy_eyebot_attachment", {0});
  magnet.Of<CCI_EyeBotAttachmentActuator>(0).Attach();
  magnet.Commit();
  EXPECT_EQ(magnet.values[0], 1);
}

TEST(ValueDevices, HandbotJointsShareOneChannelAndReportTheirState)
{
  TestWorld world;
  AddHandbot(world);
  const auto prey = world.AddPrey(1, 1, 0.1, 0.1);
  TestActuator head(world, "handbot_head", "dummy_handbot_head", {0});
  TestActuator arms(world, "handbot_arms", "dummy_handbot_arms", {0});
  head.Of<CCI_HandBotHeadActuator>(0).SetHeadAngularVelocity(0.5);
  arms.Of<CCI_HandBotArmsActuator>(0).SetArmVelocities(1, -1);
  arms.Of<CCI_HandBotArmsActuator>(0).SetWristVelocities(0.25, 99);
  head.Commit();
  arms.Commit();
  EXPECT_EQ(head.values, (std::vector<double>{0.5, 0, 0, 0, 0}));
  EXPECT_EQ(arms.values, (std::vector<double>{0, 1, -1, 0.25, 3}));

  TestActuator hands(world, "handbot_hands", "dummy_handbot_hands", {0});
  hands.Of<CCI_HandBotHandsActuator>(0).Close(CCI_HandBotHandsActuator::RIGHT);
  hands.Commit();
  EXPECT_EQ(hands.values, (std::vector<double>{0, 1}));

  TestActuator rope(world, "handbot_rope", "dummy_handbot_rope", {0});
  rope.Of<CCI_HandBotRopeActuator>(0).Launch();
  rope.Of<CCI_HandBotRopeActuator>(0).SetWinchVelocity(-1);
  rope.Commit();
  EXPECT_EQ(rope.values, (std::vector<double>{1, -0.15}));

  auto& entity = world.Space().GetEntity(0);
  entity.SetAttribute("head_angle", 0.1);
  entity.SetAttribute("wrist", 0.4, 1);
  entity.SetAttribute("gripped", 1 + prey, 0);
  entity.SetAttribute("rope_length", 2.5);
  TestSensor joints(world, "handbot_joints", "generic_handbot_joints", {0});
  joints.Update();
  const auto& sensor = joints.Of<CCI_HandBotJointsSensor>(0);
  EXPECT_EQ(sensor.GetReading(CCI_HandBotJointsSensor::HEAD), 0.1);
  EXPECT_EQ(sensor.GetReading(CCI_HandBotJointsSensor::WRIST_RIGHT), 0.4);
  EXPECT_EQ(sensor.GetReading(CCI_HandBotJointsSensor::HOLDS_LEFT), 1);
  EXPECT_EQ(sensor.GetReading(CCI_HandBotJointsSensor::HOLDS_RIGHT), 0);
  EXPECT_EQ(sensor.GetReading(CCI_HandBotJointsSensor::ROPE_LENGTH), 2.5);
  EXPECT_EQ(sensor.GetHeldId(CCI_HandBotHandsActuator::LEFT), world.Space().GetEntity(prey).GetId());
  EXPECT_EQ(sensor.GetHeldId(CCI_HandBotHandsActuator::RIGHT), "");
}

TEST(ValueDevices, WhatControllersSetSurvivesSaveAndRestore)
{
  TestWorld world;
  world.AddFootbot(1, 1);
  TestActuator before(world, "footbot_leds", "generic_footbot_leds", {0});
  before.Of<CCI_FootBotLedsActuator>(0).SetColour(5, CCI_Colour::CYAN);
  ByteWriter saved;
  before.batch->SaveState(0, saved);
  TestActuator after(world, "footbot_leds", "generic_footbot_leds", {0});
  ByteReader reader(saved.Bytes());
  after.batch->LoadState(0, reader);
  before.Commit();
  after.Commit();
  EXPECT_EQ(before.changes.slots, after.changes.slots);
  EXPECT_EQ(before.changes.values, after.changes.values);
}

TEST(ValueDevices, NoiseLeavesResultsOfOtherRobotsAndTicksAlone)
{
  TestWorld world;
  for (int i = 0; i < 3; ++i) world.AddFootbot(i, 1);
  const TestParameters noise{{"noise_kind", "gaussian"}, {"noise_deviation", "0.1"}};
  TestActuator all(world, "footbot_turret", "dummy_footbot_turret", {0, 1, 2}, noise);
  TestActuator one(world, "footbot_turret", "dummy_footbot_turret", {1}, noise);
  for (std::size_t k = 0; k < 2; ++k) all.Of<CCI_FootBotTurretActuator>(k).SetTurretAngularVelocity(1);
  one.Of<CCI_FootBotTurretActuator>(0).SetTurretAngularVelocity(1);
  world.Space().SetTick(9);
  all.Commit();
  one.Commit();
  EXPECT_EQ(all.values[1], one.values[0]);
  EXPECT_NE(all.values[0], all.values[1]);
  EXPECT_EQ(all.values[2], 0);  // its command is to stand still
  const double first = one.values[0];
  world.Space().SetTick(10);
  one.Commit();
  EXPECT_NE(one.values[0], first);
}

}  // namespace
}  // namespace swarmanoid

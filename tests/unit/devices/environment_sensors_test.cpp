// Tests light, ground and altitude against geometry worked out by hand.
#include "common/control_interface/eyebot/ci_eyebot_altitude_sensor.h"
#include "common/control_interface/eyebot/ci_eyebot_light_sensor.h"
#include "common/control_interface/footbot/ci_footbot_base_ground_sensor.h"
#include "common/control_interface/footbot/ci_footbot_ground_sensor.h"
#include "common/control_interface/footbot/ci_footbot_light_sensor.h"
#include "common/control_interface/footbot/ci_footbot_motor_ground_sensor.h"
#include "tests/unit/devices/test_world.h"

namespace swarmanoid
{
namespace
{

TEST(FootbotLight, FallsWithTheSquareOfTheDistanceAndTheAngle)
{
  TestWorld world;
  world.AddFootbot(5, 5);
  const auto bulb = world.Add(EntityKind::kLightBulb, {8, 5, 0.06}, 0, {0, 0, 0}, false, -1);
  world.Configuration().entities[bulb].intensity = 2;
  TestSensor sensor(world, "footbot_light", "generic_footbot_light", {0});
  sensor.Update();
  const auto readings = sensor.Of<CCI_FootBotLightSensor>(0).GetAllSensorReadings();
  const double brightness = 4.0 / 9;
  for (unsigned i = 0; i < 24; ++i)
  {
    const double off = std::abs(std::remainder(7.5 + 15.0 * i, 360.0));
    EXPECT_NEAR(readings[i], brightness * std::max(1 - off / 90, 0.0), 1e-12) << i;
  }
}

TEST(FootbotLight, TheRingTurnsAndLeansWithTheRobot)
{
  TestWorld world;
  world.AddFootbot(5, 5);
  world.Add(EntityKind::kLightBulb, {5, 7, 1.06}, 0, {0, 0, 0}, false, -1);
  TestSensor sensor(world, "footbot_light", "generic_footbot_light", {0});
  for (const Quaternion& turned : {QuaternionFromYaw(kPi / 3), QuaternionFromEuler({0.3, 0.2, kPi / 3})})
  {
    const Pose pose{{5, 5, 0}, turned};
    world.Space().SetPose(0, pose);
    sensor.Update();
    const Vector3 light = pose.Inverse().Apply({5, 7, 1.06}) - Vector3(0, 0, 0.06);
    const double angle = std::atan2(light.y(), light.x()) * 180 / kPi;
    const auto readings = sensor.Of<CCI_FootBotLightSensor>(0).GetAllSensorReadings();
    for (unsigned i = 0; i < 24; ++i)
    {
      const double off = std::abs(std::remainder(7.5 + 15.0 * i - angle, 360.0));
      EXPECT_NEAR(readings[i], std::max(1 - off / 90, 0.0) / light.squaredNorm(), 1e-9) << i;
    }
  }
}

TEST(FootbotLight, ShadowsAddUpAndCutOff)
{
  TestWorld world;
  world.AddFootbot(5, 5);
  world.AddFootbot(5, 4);
  world.AddFootbot(5.5, 5.03);  // blocks the light of the first bulb
  world.Add(EntityKind::kLightBulb, {8, 5, 0.06}, 0, {0, 0, 0}, false, -1);
  world.Add(EntityKind::kLightBulb, {5, 7, 0.06}, 0, {0, 0, 0}, false, -1);
  TestSensor sensor(world, "footbot_light", "generic_footbot_light", {0, 1});
  sensor.Update();
  const auto readings = sensor.Of<CCI_FootBotLightSensor>(0).GetAllSensorReadings();
  EXPECT_EQ(readings[0] > 0, true);  // 82.5 degrees off the second bulb
  EXPECT_NEAR(readings[0], 0.25 * (1 - 82.5 / 90), 1e-12);
  EXPECT_NEAR(readings[5], 0.25 * (1 - 7.5 / 90), 1e-12);
  EXPECT_EQ(readings[23], 0);
  // The second robot sees the first bulb; the first robot blocks the second bulb.
  const auto other = sensor.Of<CCI_FootBotLightSensor>(1).GetAllSensorReadings();
  const double angle = std::atan2(1, 3) * 180 / kPi;
  EXPECT_NEAR(other[1], 0.1 * (1 - std::abs(22.5 - angle) / 90), 1e-12);

  // Very near: cut to 1.
  world.Space().SetPose(0, {{5, 6.9, 0}, Quaternion::Identity()});
  sensor.Update();
  EXPECT_EQ(sensor.Of<CCI_FootBotLightSensor>(0).GetLightSensorReading(5), 1);
}

// The reading is exp(-2 d / I) up to d / I = 2.5, with d from the middle of the base: these are the figures of ARGoS3.
TEST(Argos3Light, FallsExponentiallyAndEndsAtTwoAndAHalfIntensities)
{
  for (const double distance : {0.3, 1.0, 4.9, 5.1})
  {
    TestWorld world;
    world.AddEngine("sky");
    world.AddFootbot(2, 5, 0.3);
    const auto eyebot = world.AddEyebot(2, 2, 0, -0.2, 1);
    const double x = 2 + std::sqrt(distance * distance - 0.04);
    for (const double y : {5.0, 2.0})
    {
      const auto bulb = world.Add(EntityKind::kLightBulb, {x, y, 0.2}, 0, {0, 0, 0}, false, -1);
      world.Configuration().entities[bulb].intensity = 2;
    }
    TestSensor footbots(world, "footbot_light", "argos3_footbot_light", {0});
    TestSensor eyebots(world, "eyebot_light", "argos3_eyebot_light", {eyebot});
    footbots.Update();
    eyebots.Update();
    const auto check = [&](std::span<const double, 24> readings, double x0, double y0, double yaw)
    {
      for (unsigned i = 0; i < 24; ++i)
      {
        double expected = 0;
        for (const double y : {5.0, 2.0})
        {
          const double d = std::hypot(x - x0, y - y0, 0.2);
          const double off =
              std::abs(std::remainder((7.5 + 15.0 * i) * kPi / 180 + yaw - std::atan2(y - y0, x - x0), 2 * kPi));
          if (d <= 5 && off < kPi / 2) expected += std::exp(-2 * d / 2) * (1 - 2 * off / kPi);
        }
        EXPECT_NEAR(readings[i], expected, 1e-12) << distance << " m, sensor " << i;
      }
    };
    check(footbots.Of<CCI_FootBotLightSensor>(0).GetAllSensorReadings(), 2, 5, 0.3);
    check(eyebots.Of<CCI_EyeBotLightSensor>(0).GetAllSensorReadings(), 2, 2, -0.2);
  }
}

TEST(FootbotBaseAndMotorGround, LookWhereArgos3HasThemAndTellBlackFromWhiteOrGreys)
{
  const double base[8][2] = {{0.08, 0},  {0.042, 0.065},   {0, 0.08},  {-0.042, 0.065},
                             {-0.08, 0}, {-0.042, -0.065}, {0, -0.08}, {0.042, -0.065}};
  const double motor[4][2] = {{0.063, 0.0116}, {-0.063, 0.0116}, {-0.063, -0.0116}, {0.063, -0.0116}};
  const auto is_dark_only_under = [&](double x, double y, std::uint32_t grey, double in_base, double in_motor)
  {
    TestWorld world;
    const Pose pose{{5, 5, 0}, QuaternionFromYaw(0.7)};
    world.AddFootbot(5, 5, 0.7);
    const auto spot = world.Add(EntityKind::kGroundPatch, pose.Apply({x, y, 0}), 0, {0.004, 0, 0}, false, -1);
    world.Configuration().entities[spot].colour = grey;
    TestSensor around(world, "footbot_base_ground", "generic_footbot_base_ground", {0});
    TestSensor between(world, "footbot_motor_ground", "generic_footbot_motor_ground", {0});
    around.Update();
    between.Update();
    for (unsigned i = 0; i < 8; ++i)
      EXPECT_EQ(around.Of<CCI_FootBotBaseGroundSensor>(0).GetAllSensorReadings()[i],
                base[i][0] == x && base[i][1] == y ? in_base : 1)
          << i;
    for (unsigned i = 0; i < 4; ++i)
      EXPECT_NEAR(between.Of<CCI_FootBotMotorGroundSensor>(0).GetAllSensorReadings()[i],
                  motor[i][0] == x && motor[i][1] == y ? in_motor : 1, 1e-12)
          << i;
  };
  for (const auto& place : base)
  {
    is_dark_only_under(place[0], place[1], 0x7f7f7f, 0, 1);
    is_dark_only_under(place[0], place[1], 0x808080, 1, 1);
  }
  for (const auto& place : motor) is_dark_only_under(place[0], place[1], 0x404040, 1, 0x40 / 255.0);
}

TEST(FootbotGround, SeesPatchesHolesAndTheirOrder)
{
  TestWorld world;
  world.AddFootbot(5, 5);
  const auto nest = world.Add(EntityKind::kGroundPatch, {5, 6, 0}, 0, {2, 2, 0}, false, -1);  // y from 5 to 7
  world.Configuration().entities[nest].colour = 0x00ff00;
  const auto disc = world.Add(EntityKind::kGroundPatch, {5, 5.1, 0}, 0, {0.05, 0, 0}, false, -1);
  world.Configuration().entities[disc].colour = 0x808080;
  TestSensor sensor(world, "footbot_ground", "generic_footbot_ground", {0});
  sensor.Update();
  const auto& ground = sensor.Of<CCI_FootBotGroundSensor>(0);
  const auto readings = ground.GetAllSensorReadings();
  EXPECT_EQ(ground.GetFloorColour(), 0x00ff00U);
  EXPECT_NEAR(readings[1], 0.587, 1e-12);         // left front: nest
  EXPECT_NEAR(readings[2], 0x80 / 255.0, 1e-12);  // left, (0, 0.08): disc on the nest
  EXPECT_NEAR(readings[6], 1, 1e-12);             // right: bare floor

  world.Space().GetEntity(nest).SetAttribute("colour", 0xffff00);  // an experiment changes the floor
  sensor.Update();
  EXPECT_EQ(ground.GetFloorColour(), 0xffff00U);

  world.Space().SetPose(0, {{1, 1, 0}, Quaternion::Identity()});
  sensor.Update();
  EXPECT_EQ(ground.GetFloorColour(), 0xffffffU);
}

TEST(FootbotGround, HolesAreBlackAndTurnedPatchesAreTurned)
{
  TestWorld world;
  world.AddFootbot(5, 5);
  world.Add(EntityKind::kHole, {5.08, 5, 0}, 0, {0.02, 0, 0}, false, -1);
  const auto diamond = world.Add(EntityKind::kGroundPatch, {4.9, 5, 0}, kPi / 4, {0.06, 0.06, 0}, false, -1);
  world.Configuration().entities[diamond].colour = 0xff0000;
  TestSensor sensor(world, "footbot_ground", "generic_footbot_ground", {0}, {{"floor_colour", "#000000"}});
  sensor.Update();
  const auto readings = sensor.Of<CCI_FootBotGroundSensor>(0).GetAllSensorReadings();
  EXPECT_EQ(readings[0], 0);
  EXPECT_NEAR(readings[4], 0.299, 1e-12);  // the corner of the diamond reaches (4.942, 5)
  EXPECT_EQ(readings[3], 0);
}

// Many patches of both forms, turned and one on another, some of which are moved on the way.
TEST(FootbotGround, SeesManyPatchesAsBruteForceDoes)
{
  TestWorld world;
  RandomStream random(3, 1, 1, 1);
  const auto at = [&] { return random.Uniform(-1, 11); };
  for (int n = 0; n < 200; ++n) world.AddFootbot(at(), at(), random.Uniform(-kPi, kPi));
  for (int n = 0; n < 60; ++n)
  {
    const bool is_disc = n % 2 == 0;
    const Vector3 size(random.Uniform(0.02, 2), is_disc ? 0 : random.Uniform(0.02, 2), 0);
    const auto patch = world.Add(EntityKind::kGroundPatch, {at(), at(), 0}, random.Uniform(-3, 3), size, false, -1);
    world.Configuration().entities[patch].colour = static_cast<std::uint32_t>(0x010101 * n);
  }
  TestSensor sensor(world, "footbot_ground", "generic_footbot_ground", world.RobotsOf(EntityKind::kFootbot));
  CSwarmanoidSpace& space = world.Space();
  int covered = 0;
  for (int tick = 0; tick < 4; ++tick)
  {
    for (std::uint32_t e = tick % 2 == 0 ? 0 : 200; e < 260; e += 3)
      space.SetPose(e, {{at(), at(), 0}, QuaternionFromYaw(at())});
    sensor.Update();
    for (std::uint32_t robot = 0; robot < 200; ++robot)
    {
      const auto readings = sensor.Of<CCI_FootBotGroundSensor>(robot).GetAllSensorReadings();
      for (std::size_t i = 0; i < readings.size(); ++i)
      {
        const auto [x, y] = CCI_FootBotBaseGroundSensor::PLACES_M[i];
        const Vector3 point = space.GetPose(robot).Apply({x, y, 0});
        double expected = 1;  // white
        for (std::uint32_t e = 200; e < 260; ++e)
        {
          const Vector3 local = space.GetPose(e).Inverse().Apply(point);
          const Vector3& size = space.GetEntity(e).GetSize();
          const bool covers = size.y() == 0
                                  ? local.norm() <= size.x()
                                  : std::abs(local.x()) <= size.x() / 2 && std::abs(local.y()) <= size.y() / 2;
          if (!covers) continue;
          ++covered;
          expected = (e - 200) / 255.0;
        }
        ASSERT_NEAR(readings[i], expected, 1e-12) << "tick " << tick << " robot " << robot;
      }
    }
  }
  EXPECT_GT(covered, 1000);
}

TEST(EyebotAltitude, MeasuresDownToFloorOrBlock)
{
  TestWorld world;
  world.AddEngine("sky");
  const auto eyebot = world.AddEyebot(5, 5, 2);
  world.AddFootbot(5, 5, 0, 0, 1);  // in another engine
  world.AddBlock({7, 3, 0.3}, {1, 1, 0.6});
  TestSensor sensor(world, "eyebot_altitude", "generic_eyebot_altitude", {eyebot});
  sensor.Update();
  EXPECT_EQ(sensor.Of<CCI_EyeBotAltitudeSensor>(0).GetAltitude(), 2);
  world.Space().SetPose(eyebot, {{7.2, 2.8, 1.5}, Quaternion::Identity()});
  sensor.Update();
  EXPECT_NEAR(sensor.Of<CCI_EyeBotAltitudeSensor>(0).GetAltitude(), 0.9, 1e-12);
}

}  // namespace
}  // namespace swarmanoid

// Microphones, contact, distance scanners and tags against closed forms and brute force.
#include <gmock/gmock.h>

#include "common/control_interface/ci_contact_sensor.h"
#include "common/control_interface/ci_distance_scanner_sensor.h"
#include "common/control_interface/ci_microphone_sensor.h"
#include "common/control_interface/ci_tag_reader_sensor.h"
#include "common/control_interface/footbot/ci_footbot_turning_scanner_sensor.h"
#include "tests/unit/devices/test_world.h"

namespace swarmanoid
{
namespace
{

using testing::IsEmpty;
using testing::UnorderedElementsAre;

constexpr double kFootbotRadius = 0.085036758;

std::uint32_t AddSound(TestWorld& world, const Vector3& place, double intensity)
{
  const auto sound = world.Add(EntityKind::kSoundSource, place, 0, {0, 0, 0}, false, -1);
  world.Configuration().entities[sound].intensity = intensity;
  return sound;
}

TEST(Microphone, PressureFallsWithTheDistanceAndSquaresAddUp)
{
  TestWorld world;
  const auto robot = world.AddFootbot(5, 5, 0.5);
  AddSound(world, {8, 5, 0.1}, 1.5);
  AddSound(world, {5, 7, 1.1}, 4);
  AddSound(world, {5.5, 5, 0.1}, 1e-5);  // below the threshold
  TestSensor array(world, "microphone", "generic_microphone", {robot});
  TestSensor capsule(world, "microphone", "capsule_microphone", {robot});
  array.Update();
  capsule.Update();
  const auto& microphone = array.Of<CCI_MicrophoneSensor>(0);
  ASSERT_EQ(microphone.GetAllSounds().size(), 2U);
  const auto& ahead = microphone.GetAllSounds()[0];
  const auto& above = microphone.GetAllSounds()[1];
  EXPECT_NEAR(ahead.loudness, 0.5, 1e-12);
  EXPECT_NEAR(ahead.bearing_rad, -0.5, 1e-12);
  EXPECT_NEAR(ahead.elevation_rad, 0, 1e-12);
  EXPECT_NEAR(above.loudness, 4 / std::sqrt(5.0), 1e-12);
  EXPECT_NEAR(above.bearing_rad, kPi / 2 - 0.5, 1e-12);
  EXPECT_NEAR(above.elevation_rad, std::atan(0.5), 1e-12);
  EXPECT_NEAR(microphone.GetLoudness(), std::sqrt(0.25 + 16 / 5.0), 1e-12);
  EXPECT_EQ(capsule.Of<CCI_MicrophoneSensor>(0).GetLoudness(), microphone.GetLoudness());
  EXPECT_THAT(capsule.Of<CCI_MicrophoneSensor>(0).GetAllSounds(), IsEmpty());
}

TEST(Microphone, BodiesBetweenMuffleInTheShadowedModelAlone)
{
  TestWorld world;
  const auto robot = world.AddFootbot(5, 5);
  AddSound(world, {8, 5, 0.1}, 3);
  world.AddBlock({6.5, 5, 0.5}, {0.1, 1, 1});
  const auto loudness = [&](const char* model, const TestParameters& parameters)
  {
    TestSensor sensor(world, "microphone", model, {robot}, parameters);
    sensor.Update();
    return sensor.Of<CCI_MicrophoneSensor>(0).GetLoudness();
  };
  EXPECT_NEAR(loudness("generic_microphone", {}), 1, 1e-12);
  EXPECT_NEAR(loudness("shadowed_microphone", {}), 0.25, 1e-12);
  EXPECT_EQ(loudness("shadowed_microphone", {{"shadow", "0.1"}, {"threshold", "0.2"}}), 0);
}

TEST(Microphone, HearsNearSourcesAsFromACentimetreAndAbsentOnesNotAtAll)
{
  TestWorld world;
  const auto robot = world.AddFootbot(5, 5);
  const auto near = AddSound(world, {5, 5.002, 0.1}, 1);
  AddSound(world, {5, 5.25, 0.1}, 0.5);
  TestSensor sensor(world, "microphone", "generic_microphone", {robot}, {{"threshold", "2"}});
  sensor.Update();
  const auto& microphone = sensor.Of<CCI_MicrophoneSensor>(0);
  ASSERT_EQ(microphone.GetAllSounds().size(), 2U) << "a source at the threshold is heard";
  EXPECT_NEAR(microphone.GetAllSounds()[0].loudness, 100, 1e-9);
  EXPECT_NEAR(microphone.GetAllSounds()[1].loudness, 2, 1e-12);
  world.Space().SetAttribute(world.Space().PresenceSlot(near), 0);
  sensor.Update();
  ASSERT_EQ(microphone.GetAllSounds().size(), 1U);
  EXPECT_NEAR(microphone.GetLoudness(), 2, 1e-12);
}

TEST(Contact, ReachesAsFarUpAndDownAsAside)
{
  // A block above the robot, or below it.
  for (const auto& [gap, touches] : {std::pair{0.0019, true}, {0.0021, false}, {-0.01, true}})
    for (const bool is_above : {true, false})
    {
      TestWorld world;
      const auto robot = world.AddFootbot(5, 5, 0, 1);
      const double height = DescriptionOf(EntityKind::kFootbot).size.z();
      world.AddBlock({5, 5, is_above ? 1 + height + gap + 0.05 : 1 - gap - 0.05}, {0.1, 0.1, 0.1});
      TestSensor sensor(world, "contact", "generic_contact", {robot});
      sensor.Update();
      EXPECT_EQ(sensor.Of<CCI_ContactSensor>(0).IsTouched(), touches) << gap << is_above;
    }
  TestWorld world;
  const auto robot = world.AddFootbot(5, 5);
  const auto other = world.AddFootbot(5 + 2 * kFootbotRadius + 0.0019, 5);
  TestSensor sensor(world, "contact", "generic_contact", {robot});
  sensor.Update();
  EXPECT_TRUE(sensor.Of<CCI_ContactSensor>(0).IsTouched());
  world.Space().SetPose(other, {{5 + 2 * kFootbotRadius + 0.0021, 5, 0}, Quaternion::Identity()});
  sensor.Update();
  EXPECT_FALSE(sensor.Of<CCI_ContactSensor>(0).IsTouched());
}

TEST(Contact, TellsWhereBodiesTouch)
{
  TestWorld world;
  world.AddEngine("other");
  const auto robot = world.AddFootbot(5, 5, 1);
  const double apart = 2 * kFootbotRadius;
  world.AddFootbot(5, 5 + apart + 0.001);          // touches, at 90 degrees in the space
  world.AddFootbot(5 - apart - 0.0041, 5);         // 4.1 mm away
  world.AddFootbot(5, 5 - apart - 0.001, 0, 0.2);  // above
  world.AddFootbot(5 - 0.5 * apart, 5, 0, 0, 1);   // in another engine
  world.AddBlock({5 + kFootbotRadius + 0.1, 5, 0.05}, {0.2, 3, 0.1});
  TestSensor sensor(world, "contact", "generic_contact", {robot});
  sensor.Update();
  std::vector<double> angles;
  for (const double angle : sensor.Of<CCI_ContactSensor>(0).GetAllContacts()) angles.push_back(angle);
  EXPECT_THAT(angles, UnorderedElementsAre(testing::DoubleNear(kPi / 2 - 1, 1e-9), testing::DoubleNear(-1, 1e-9)));
  TestSensor longer(world, "contact", "generic_contact", {robot}, {{"reach", "0.005"}});
  longer.Update();
  EXPECT_EQ(longer.Of<CCI_ContactSensor>(0).GetAllContacts().size(), 3U);
}

// Tests whether two turned rectangles or discs touch, against points spread densely over the outline of one of them.
TEST(Contact, AgreesWithPointsOfTheOutlines)
{
  RandomStream random(11, 0, 0, 0);
  constexpr double kReach = 0.02;
  int touching = 0, apart = 0;
  for (int trial = 0; trial < 300; ++trial)
  {
    TestWorld world;
    const bool is_handbot = random.Uniform() < 0.5;
    const double yaw = random.Uniform(-3, 3);
    const auto robot =
        is_handbot ? world.Add(EntityKind::kHandbot, {5, 5, 0}, yaw, {0.22, 0.17, 0.16}) : world.AddFootbot(5, 5, yaw);
    const Vector3 size(random.Uniform(0.05, 0.3), random.Uniform(0.05, 0.3), 0.2);
    const Pose pose{{5 + random.Uniform(-0.35, 0.35), 5 + random.Uniform(-0.35, 0.35), 0.1},
                    QuaternionFromYaw(random.Uniform(-3, 3))};
    world.AddBlock(pose.position, size, YawOf(pose.orientation));
    // The distance from a dense set of points of the block's outline to the body of the robot.
    double least = 1;
    const Pose to_robot = Pose{{5, 5, 0}, QuaternionFromYaw(yaw)}.Inverse().Compose(pose);
    for (int i = 0; i <= 4000; ++i)
    {
      const double t = i / 1000.0 - std::floor(i / 1000.0);
      const int side = std::min(i / 1000, 3);
      const Vector2 corners[] = {{1, 1}, {-1, 1}, {-1, -1}, {1, -1}, {1, 1}};
      const Vector2 place = (1 - t) * corners[side] + t * corners[side + 1];
      const Vector3 point = to_robot.Apply({place.x() * size.x() / 2, place.y() * size.y() / 2, 0});
      const double gap =
          is_handbot ? std::hypot(std::max(std::abs(point.x()) - 0.11, 0.0), std::max(std::abs(point.y()) - 0.085, 0.0))
                     : std::max(std::hypot(point.x(), point.y()) - kFootbotRadius, 0.0);
      least = std::min(least, gap);
    }
    if (std::abs(least - kReach) < 1e-3) continue;  // nearer than the points are spread
    TestSensor sensor(world, "contact", "generic_contact", {robot}, {{"reach", std::to_string(kReach)}});
    sensor.Update();
    EXPECT_EQ(sensor.Of<CCI_ContactSensor>(0).IsTouched(), least < kReach) << trial << ": " << least;
    ++(least < kReach ? touching : apart);
  }
  EXPECT_GT(touching, 50);
  EXPECT_GT(apart, 50);
}

TEST(DistanceScanner, MeasuresFromTheSurfaceWithinTheRangeOfEachBeam)
{
  using Echo = CCI_DistanceScannerSensor::Echo;
  TestWorld world;
  const auto robot = world.AddFootbot(5, 5);
  world.AddBlock({5.5, 5, 0.5}, {0.4, 1, 1});    // ahead, its face at 5.3
  world.AddBlock({5, 6.5, 0.5}, {0.1, 1, 1});    // left, its face at 6
  world.AddBlock({5, 4.7, 0.5}, {0.1, 0.2, 1});  // right, its face at 4.8
  TestSensor sensor(world, "footbot_distance_scanner", "generic_footbot_distance_scanner", {robot});
  sensor.Update();
  const auto readings = sensor.Of<CCI_DistanceScannerSensor>(0).GetAllReadings();
  ASSERT_EQ(readings.size(), 4U);
  EXPECT_EQ(readings[0].echo, Echo::kMeasured);
  EXPECT_NEAR(readings[0].distance_m, 0.3 - kFootbotRadius, 1e-12);
  EXPECT_EQ(readings[1].echo, Echo::kNothing) << "back";
  EXPECT_EQ(readings[1].distance_m, 0.26);
  EXPECT_NEAR(readings[2].angle_rad, kPi / 2, 1e-12);
  EXPECT_NEAR(readings[2].distance_m, 1 - kFootbotRadius, 1e-12);
  EXPECT_EQ(readings[3].echo, Echo::kTooNear) << "0.115 m from the surface";
}

// A head that turns looks where it was since the last tick, six times evenly.
TEST(DistanceScanner, TurnsWithItsSpeed)
{
  TestWorld world;
  const auto robot = world.AddFootbot(5, 5);
  TestSensor sensor(world, "footbot_distance_scanner", "generic_footbot_distance_scanner", {robot},
                    {{"rotation_speed", "3"}});
  world.Space().SetTick(7);
  sensor.Update();
  const auto readings = sensor.Of<CCI_DistanceScannerSensor>(0).GetAllReadings();
  ASSERT_EQ(readings.size(), 24U);
  const double beams[] = {0, kPi, kPi / 2, -kPi / 2};
  for (std::size_t i = 0; i < 24; ++i)
    EXPECT_NEAR(
        std::remainder(readings[i].angle_rad - beams[i / 6] - 3 * 0.1 * (6 + static_cast<double>(i % 6) / 6), 2 * kPi),
        0, 1e-12);
}

// The scanner is off until the first command. Then the readings continue from the direction of the head.
TEST(DistanceScanner, ObeysItsController)
{
  TestWorld world;
  const auto robot = world.AddFootbot(5, 5);
  world.AddBlock({5.5, 5, 0.5}, {0.4, 1, 1});  // ahead, its face at 5.3
  TestSensor sensor(world, "footbot_distance_scanner", "argos3_footbot_distance_scanner", {robot});
  auto& scanner = sensor.Of<CCI_FootBotTurningScannerSensor>(0);
  sensor.Update();
  EXPECT_THAT(scanner.GetAllReadings(), IsEmpty());

  scanner.Look(kPi / 2);
  sensor.Update();
  ASSERT_EQ(scanner.GetAllReadings().size(), 4U);
  EXPECT_NEAR(scanner.GetAllReadings()[0].angle_rad, kPi / 2, 1e-12);
  EXPECT_NEAR(scanner.GetAllReadings()[3].angle_rad, 0, 1e-12) << "the long beam to the right of the head";
  EXPECT_NEAR(scanner.GetAllReadings()[3].distance_m, 0.3 - kFootbotRadius, 1e-12);

  scanner.Turn(-3);
  for (int tick = 0; tick < 2; ++tick)
  {
    sensor.Update();
    ASSERT_EQ(scanner.GetAllReadings().size(), 24U);
    for (std::size_t i = 0; i < 6; ++i)
      EXPECT_NEAR(scanner.GetAllReadings()[i].angle_rad, kPi / 2 - 0.3 * (tick + static_cast<double>(i) / 6), 1e-12);
  }
  EXPECT_THROW(scanner.Turn(std::numeric_limits<double>::quiet_NaN()), std::invalid_argument);
  EXPECT_THROW(scanner.Look(std::numeric_limits<double>::infinity()), std::invalid_argument);
  scanner.SwitchOff();
  sensor.Update();
  EXPECT_THAT(scanner.GetAllReadings(), IsEmpty());
}

TEST(DistanceScanner, OfTheEyebotLooksAllAround)
{
  TestWorld world;
  const auto eyebot = world.AddEyebot(5, 5, 1, 0.3);
  world.AddBlock({7, 5, 1}, {0.5, 9, 2});
  TestSensor sensor(world, "eyebot_distance_scanner", "generic_eyebot_distance_scanner", {eyebot});
  sensor.Update();
  const auto readings = sensor.Of<CCI_DistanceScannerSensor>(0).GetAllReadings();
  ASSERT_EQ(readings.size(), 32U);
  for (std::size_t i = 0; i < 32; ++i)
  {
    const double angle = 2 * kPi / 32 * static_cast<double>(i) + 0.3;
    const double hit = 1.75 / std::cos(angle);
    const bool sees = std::cos(angle) > 0 && std::abs(hit * std::sin(angle)) < 4.5;
    EXPECT_NEAR(readings[i].distance_m, sees ? hit : 15, 1e-9) << i;
  }
}

TEST(TagReader, ReadsTaggedEntitiesWithinRange)
{
  TestWorld world;
  const auto robot = world.AddFootbot(5, 5);
  const auto id = [&](std::uint32_t entity, const char* name) { world.Configuration().entities[entity].id = name; };
  id(world.AddPrey(5.1, 5, 0.01, 0.1), "prey_1");
  id(world.AddPrey(5, 5.16, 0.01, 0.1), "prey_2");
  id(world.AddPrey(5, 4.9, 0.01, 0.1), "stone");
  id(world.Add(EntityKind::kGroundPatch, {4.95, 5, 0}, 0, {0.1, 0, 0}, false, -1), "nest");
  const auto ids = [&](const TestParameters& parameters)
  {
    TestSensor sensor(world, "tag_reader", "generic_tag_reader", {robot}, parameters);
    sensor.Update();
    std::vector<std::string> all;
    for (const auto& tag : sensor.Of<CCI_TagReaderSensor>(0).GetAllTags())
    {
      all.emplace_back(tag.id);
      const Vector3 place = world.Space().FindEntity(tag.id)->GetPose().position;
      EXPECT_NEAR(tag.distance_m, (place - Vector3(5, 5, 0)).norm(), 1e-12);
    }
    return all;
  };
  EXPECT_THAT(ids({{"tagged", "prey_*, nest"}}), UnorderedElementsAre("prey_1", "nest"));
  EXPECT_THAT(ids({}), UnorderedElementsAre("prey_1", "nest", "stone"));
  EXPECT_THAT(ids({{"range", "0.2"}, {"tagged", "prey_?"}}), UnorderedElementsAre("prey_1", "prey_2"));
  EXPECT_THAT(ids({{"miss_probability", "1"}}), IsEmpty());
  EXPECT_THROW(ids({{"tagged", "pray_*"}}), ConfigurationError);
}

TEST(TagReader, HasItsAntennaAtItsHeightAndMissesItsShare)
{
  TestWorld world;
  const auto robot = world.AddFootbot(5, 5);
  world.Configuration().entities[world.AddPrey(5, 5.05, 0.01, 0.1)].id = "prey";
  const auto tags = [&](TestSensor& sensor)
  {
    sensor.Update();
    return sensor.Of<CCI_TagReaderSensor>(0).GetAllTags();
  };
  TestSensor high(world, "tag_reader", "generic_tag_reader", {robot}, {{"height", "0.12"}});
  ASSERT_EQ(tags(high).size(), 1U);
  EXPECT_NEAR(tags(high)[0].distance_m, 0.13, 1e-12);
  EXPECT_NEAR(high.batch->Reach(), 0.12 + 0.15, 1e-12);
  TestSensor higher(world, "tag_reader", "generic_tag_reader", {robot}, {{"height", "0.15"}});
  EXPECT_THAT(tags(higher), IsEmpty());
  TestSensor misses(world, "tag_reader", "generic_tag_reader", {robot}, {{"miss_probability", "0.3"}});
  int read = 0;
  constexpr int kTicks = 2000;
  for (std::uint64_t tick = 0; tick < kTicks; ++tick)
  {
    world.Space().SetTick(tick);
    read += static_cast<int>(tags(misses).size());
  }
  EXPECT_NEAR(read, 0.7 * kTicks, 5 * std::sqrt(0.3 * 0.7 * kTicks));
}

}  // namespace
}  // namespace swarmanoid

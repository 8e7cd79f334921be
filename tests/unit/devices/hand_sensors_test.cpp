// The proximity sensors in the handbot's hands and the eyebot's camera that turns, against models of their own.
#include <Eigen/Geometry>

#include "common/control_interface/ci_colour_blob_sensor.h"
#include "common/control_interface/ci_proximity_sensor.h"
#include "common/control_interface/handbot/ci_handbot_proximity_sensor.h"
#include "tests/unit/devices/test_world.h"

namespace swarmanoid
{
namespace
{

using Turn = Eigen::AngleAxisd;

const Vector3 kHandbot(0.22, 0.17, 0.16);

TEST(HandbotProximity, OpenHandsFeelAWallAtItsDistance)
{
  TestWorld world;
  const auto robot = world.Add(EntityKind::kHandbot, {5, 5, 0}, 0, kHandbot);
  // Palms at 0.06 + 0.138 m; the wall is 0.02 m beyond.
  world.AddBlock({5 + 0.198 + 0.02 + 0.5, 5, 0.5}, {1, 3, 1});
  for (int hand = 0; hand < 2; ++hand) world.Space().GetEntity(robot).SetAttribute("hand_aperture", kPi, hand);
  TestSensor sensor(world, "handbot_proximity", "generic_handbot_proximity", {robot});
  sensor.Update();
  for (const double reading : sensor.Of<CCI_HandBotProximitySensor>(0).GetAllSensorReadings())
    EXPECT_NEAR(reading, 1 - 0.02 / 0.05, 1e-9);
  TestSensor longer(world, "handbot_proximity", "generic_handbot_proximity", {robot}, {{"range", "0.2"}});
  longer.Update();
  EXPECT_NEAR(longer.Of<CCI_HandBotProximitySensor>(0).GetAllSensorReadings()[0], 0.9, 1e-9);
}

TEST(HandbotProximity, ClawsFeelWhatIsBetweenThem)
{
  TestWorld world;
  const auto robot = world.Add(EntityKind::kHandbot, {5, 5, 0}, 0, kHandbot);
  // A pole is before the left hand, as high as its claws, on the axis of the arm, 0.041 m from the palm.
  world.AddBlock({5.198 + 0.041, 5.05, 0.1}, {0.012, 0.012, 0.03});
  for (int hand = 0; hand < 2; ++hand) world.Space().GetEntity(robot).SetAttribute("hand_aperture", kPi / 2, hand);
  TestSensor sensor(world, "handbot_proximity", "generic_handbot_proximity", {robot});
  sensor.Update();
  const auto readings = sensor.Of<CCI_HandBotProximitySensor>(0).GetAllSensorReadings();
  for (const std::size_t same : {0U, 1U, 2U}) EXPECT_NEAR(readings[same], readings[11 - same], 1e-9);
  // A claw is at 45 degrees: from 0.029 m along it, its ray falls by as much as it goes ahead.
  EXPECT_NEAR(readings[1], 1 - (0.029 * std::sqrt(0.5) - 0.006) * std::sqrt(2) / 0.05, 1e-9);
  EXPECT_EQ(readings[0], 0);
  EXPECT_EQ(readings[2], 0);
  EXPECT_EQ(readings[4], 0) << "what is above the claws looks past it";
  EXPECT_EQ(readings[7], 0);
  for (std::size_t i = 12; i < 24; ++i) EXPECT_EQ(readings[i], 0) << "the right hand is empty";
}

// Each sensor by a chain of turns, and points along its ray, one every 25 micrometres.
TEST(HandbotProximity, AgreesWithPointsAlongTheRaysOfTurnedJoints)
{
  RandomStream random(5, 0, 0, 0);
  int seen = 0;
  for (int trial = 0; trial < 60; ++trial)
  {
    TestWorld world;
    const double yaw = random.Uniform(-3, 3);
    const auto robot = world.Add(EntityKind::kHandbot, {5, 5, 0}, yaw, kHandbot);
    const double head = random.Uniform(-3, 3);
    double arm[2], wrist[2], aperture[2];
    for (int hand = 0; hand < 2; ++hand)
    {
      arm[hand] = random.Uniform(0, kPi / 3);
      wrist[hand] = random.Uniform(0, kPi / 2);
      aperture[hand] = random.Uniform(0, kPi);
    }
    const Eigen::Isometry3d to_shoulders = Eigen::Translation3d(5, 5, 0) * Turn(yaw, Vector3::UnitZ()) *
                                           Eigen::Translation3d(0.06, 0, 0.1) * Turn(head, Vector3::UnitX());
    const auto palm = [&](int hand)
    {
      const double side = hand == 0 ? 1 : -1;
      return Eigen::Isometry3d(to_shoulders * Eigen::Translation3d(0, side * 0.05, 0) *
                               Turn(side * arm[hand], Vector3::UnitZ()) * Eigen::Translation3d(0.138, 0, 0) *
                               Turn(side * wrist[hand], Vector3::UnitX()));
    };
    const Vector3 size(0.06, 0.08, 0.05);
    const Vector3 before = palm(trial % 2) * Vector3(random.Uniform(0.02, 0.08), random.Uniform(-0.03, 0.03), 0);
    const Pose block{before, QuaternionFromYaw(random.Uniform(-3, 3))};
    world.AddBlock(block.position, size, YawOf(block.orientation));
    CSwarmanoidSpaceEntity& entity = world.Space().GetEntity(robot);
    entity.SetAttribute("head_angle", head);
    for (int hand = 0; hand < 2; ++hand)
    {
      entity.SetAttribute("arm", arm[hand], hand);
      entity.SetAttribute("wrist", wrist[hand], hand);
      entity.SetAttribute("hand_aperture", aperture[hand], hand);
    }
    TestSensor sensor(world, "handbot_proximity", "generic_handbot_proximity", {robot});
    sensor.Update();
    const auto readings = sensor.Of<CCI_HandBotProximitySensor>(0).GetAllSensorReadings();
    for (int i = 0; i < 24; ++i)
    {
      const int hand = i / 12, of_hand = i % 12;
      Eigen::Isometry3d place = palm(hand);
      if (of_hand < 3)
        place = place * Turn(aperture[hand] / 2, Vector3::UnitZ()) *
                Eigen::Translation3d(0.058 * (5 - 2 * of_hand) / 6, 0, 0) * Turn(-kPi / 2, Vector3::UnitZ());
      else if (of_hand > 8)
        place = place * Turn(-aperture[hand] / 2, Vector3::UnitZ()) *
                Eigen::Translation3d(0.058 * (2 * of_hand - 17) / 6, 0, 0) * Turn(kPi / 2, Vector3::UnitZ());
      else
        place = place * Eigen::Translation3d(0, 0.019 * (1 - of_hand % 3), of_hand < 6 ? 0.038 : -0.038);
      double met = 0.05;
      for (int step = 0; step <= 2000 && met == 0.05; ++step)
      {
        const Vector3 point = block.Inverse().Apply(place * Vector3(step * 25e-6, 0, 0));
        if ((point.cwiseAbs() - size / 2).maxCoeff() <= 0) met = step * 25e-6;
      }
      EXPECT_NEAR(readings[static_cast<std::size_t>(i)], 1 - met / 0.05, 26e-6 / 0.05) << trial << " sensor " << i;
      seen += met < 0.05;
    }
  }
  EXPECT_GT(seen, 200);
}

TEST(EyebotProximity, IsTheRingOfTheKind)
{
  TestWorld world;
  const auto robot = world.AddEyebot(5, 5, 1, 7.5 * kPi / 180);
  // The last sensor looks straight ahead then, and the ring is 0.1635 m above the base.
  world.AddBlock({5 + 0.255 + 1.2 + 0.5, 5, 1.1635}, {1, 0.01, 0.01});
  TestSensor sensor(world, "proximity", "generic_proximity", {robot});
  sensor.Update();
  const auto& ring = sensor.Of<CCI_ProximitySensor>(0);
  ASSERT_EQ(ring.GetAllSensorReadings().size(), 24U);
  for (std::size_t i = 0; i < 23; ++i) EXPECT_EQ(ring.GetAllSensorReadings()[i], 0) << i;
  EXPECT_NEAR(ring.GetAllSensorReadings()[23], 1 - 1.2 / 3, 1e-9);
}

// One lit beacon at a time: in view if its direction is within the aperture of the axis, and near enough.
TEST(PanTiltCamera, SeesTheConeWhereTheLaserPoints)
{
  RandomStream random(3, 0, 0, 0);
  int seen = 0;
  constexpr int kTrials = 400;
  for (int trial = 0; trial < kTrials; ++trial)
  {
    TestWorld world;
    const bool tilted = trial % 2 == 1;
    const Vector3 place(5, 5, 1.5);
    const auto robot = world.AddEyebot(5, 5, 1.5);
    const auto other = world.AddFootbot(5 + random.Uniform(-1.5, 1.5), 5 + random.Uniform(-1.5, 1.5));
    const Eigen::Quaterniond body =
        Turn(random.Uniform(-3, 3), Vector3::UnitZ()) * Turn(tilted ? 0.2 : 0, Vector3::UnitY());
    world.Space().SetPose(robot, {place, body});
    world.Space().GetEntity(other).SetAttribute("beacon", CCI_Colour::RED);
    const double pan = random.Uniform(-3, 3), tilt = random.Uniform(0, 1.2);
    world.Space().GetEntity(robot).SetAttribute("laser_pan", pan);
    world.Space().GetEntity(robot).SetAttribute("laser_tilt", tilt);
    TestSensor camera(world, "eyebot_pan_tilt_camera", "generic_eyebot_pan_tilt_camera", {robot});
    TestSensor pixels(world, "eyebot_pan_tilt_camera", "pixel_noise_eyebot_pan_tilt_camera", {robot},
                      {{"image_radius", "1000000"}});
    TestSensor coarse(world, "eyebot_pan_tilt_camera", "pixel_noise_eyebot_pan_tilt_camera", {robot},
                      {{"image_radius", "10"}});
    camera.Update();
    pixels.Update();
    coarse.Update();

    const Vector3 beacon = world.Space().GetEntity(other).GetPosition() +
                           Vector3(0, 0, *DescriptionOf(EntityKind::kFootbot).beacon_height_m);
    const Vector3 offset = body.inverse() * (beacon - place);
    const Vector3 axis = Turn(pan, Vector3::UnitZ()) * (Turn(-tilt, Vector3::UnitY()) * Vector3(0, 0, -1));
    const bool in_view = offset.norm() <= 2 && std::acos(axis.dot(offset.normalized())) <= kPi / 6;
    const auto blobs = camera.Of<CCI_ColourBlobSensor>(0).GetAllBlobs();
    ASSERT_EQ(blobs.size(), in_view ? 1U : 0U) << trial;
    if (!in_view) continue;
    ++seen;
    EXPECT_NEAR(blobs[0].distance_m, offset.norm(), 1e-9);
    EXPECT_NEAR(blobs[0].angle_rad, std::atan2(offset.y(), offset.x()), 1e-9);
    EXPECT_NEAR(blobs[0].elevation_rad, std::asin(offset.z() / offset.norm()), 1e-9);
    const auto rounded = pixels.Of<CCI_ColourBlobSensor>(0).GetAllBlobs();
    ASSERT_EQ(rounded.size(), 1U);
    EXPECT_NEAR(rounded[0].distance_m, blobs[0].distance_m, 1e-5);
    EXPECT_NEAR(rounded[0].elevation_rad, blobs[0].elevation_rad, 1e-5);
    EXPECT_NEAR(std::cos(rounded[0].elevation_rad) * std::remainder(rounded[0].angle_rad - blobs[0].angle_rad, 2 * kPi),
                0, 1e-5);
    // The nearest pixel of the image, whose columns are across the way that the camera is turned.
    const Vector3 across(-std::sin(pan), std::cos(pan), 0);
    const auto pixel_of = [&](const CCI_ColourBlob& blob)
    {
      const Vector3 way(std::cos(blob.elevation_rad) * std::cos(blob.angle_rad),
                        std::cos(blob.elevation_rad) * std::sin(blob.angle_rad), std::sin(blob.elevation_rad));
      return std::pair(way.dot(across) / way.dot(axis) * 10 / std::tan(kPi / 6),
                       way.dot(axis.cross(across)) / way.dot(axis) * 10 / std::tan(kPi / 6));
    };
    const auto whole = coarse.Of<CCI_ColourBlobSensor>(0).GetAllBlobs();
    ASSERT_EQ(whole.size(), 1U);
    EXPECT_NEAR(pixel_of(whole[0]).first, std::round(pixel_of(blobs[0]).first), 1e-9);
    EXPECT_NEAR(pixel_of(whole[0]).second, std::round(pixel_of(blobs[0]).second), 1e-9);
  }
  EXPECT_GT(seen, 40);
  EXPECT_LT(seen, kTrials / 2);
}

}  // namespace
}  // namespace swarmanoid

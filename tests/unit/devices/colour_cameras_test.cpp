#include "controller_host/devices/cameras/blob_sources.h"
#include "tests/unit/devices/colour_scene.h"

namespace swarmanoid
{
namespace
{

constexpr double kBody = 0.085036758;

TEST(ColourCameras, OmnidirectionalCameraSeesLitRobotsAroundAtTheirDistanceAndAngle)
{
  TestWorld world;
  world.AddFootbot(5, 5, kPi / 2);
  world.AddFootbot(5.4, 5);
  world.AddFootbot(5, 5.3);
  world.AddFootbot(4.5, 5);  // dark
  TestSensor camera(world, "footbot_omnidirectional_camera", "generic_footbot_omnidirectional_camera", {0});
  Paint(world, 1, CCI_Colour::RED);
  Paint(world, 2, CCI_Colour::BLUE);
  camera.Update();
  ASSERT_EQ(BlobsOf(camera, 0).size(), 2U);
  const CCI_ColourBlob* red = camera.Of<CCI_ColourBlobSensor>(0).GetNearestBlob(CCI_Colour::RED);
  const CCI_ColourBlob* blue = camera.Of<CCI_ColourBlobSensor>(0).GetNearestBlob(CCI_Colour::BLUE);
  ASSERT_NE(red, nullptr);
  ASSERT_NE(blue, nullptr);
  EXPECT_NEAR(red->distance_m, 0.4, 1e-12);
  EXPECT_NEAR(red->angle_rad, -kPi / 2, 1e-12);
  EXPECT_NEAR(blue->distance_m, 0.3, 1e-12);
  EXPECT_NEAR(blue->angle_rad, 0, 1e-12);
  EXPECT_EQ(camera.Of<CCI_ColourBlobSensor>(0).GetNearestBlob(CCI_Colour::GREEN), nullptr);
}

TEST(ColourCameras, ViewEndsWhereTheApertureSays)
{
  // The eye is at 0.2887 m, LEDs are at 0.085 m, and 70 degrees give 0.5597 m.
  for (const double distance : {0.559, 0.561})
  {
    TestWorld world;
    world.AddFootbot(5, 5);
    world.AddFootbot(5 + distance, 5);
    TestSensor camera(world, "footbot_omnidirectional_camera", "generic_footbot_omnidirectional_camera", {0});
    Paint(world, 1, CCI_Colour::RED);
    camera.Update();
    EXPECT_EQ(BlobsOf(camera, 0).size(), distance < 0.56 ? 1U : 0U);
  }
}

TEST(ColourCameras, LedsOfOneColourAreOneBlobAtTheirMiddleAndTurnWithTheTurret)
{
  TestWorld world;
  world.AddFootbot(5, 5);
  world.AddFootbot(5.4, 5, kPi / 2);
  auto& other = world.Space().GetEntity(1);
  for (int led = 0; led < 3; ++led) other.SetAttribute("led", CCI_Colour::RED, led);  // middle at 45 degrees
  other.SetAttribute("led", CCI_Colour::GREEN, 7);
  other.SetAttribute("turret_angle", -kPi / 4);
  other.SetAttribute("beacon", CCI_Colour::WHITE);
  SensorWorld sensor_world(world.Space());
  sensor_world.Refresh();
  BlobSources sources(sensor_world);
  sources.Refresh();
  const auto bodies = sensor_world.Grid().Sorted();
  const auto place = std::find(bodies.begin(), bodies.end(), 1U) - bodies.begin();
  const auto on_other = sources.AtForTest(static_cast<std::uint32_t>(place));
  ASSERT_EQ(on_other.size(), 3U);
  const double ring = kBody + 0.005;
  EXPECT_EQ(on_other[0].colour, CCI_Colour::WHITE);
  EXPECT_NEAR((on_other[0].position - Vector3(5.4, 5, 0.174)).norm(), 0, 1e-12);
  // The angle in the space is 90 - 45 + 45 degrees.
  const double middle = ring * (1 + 2 * std::cos(kPi / 6)) / 3;
  EXPECT_NEAR((on_other[1].position - Vector3(5.4, 5 + middle, 0.085)).norm(), 0, 1e-12);
  const double green = (90 - 45 + 15 + 7 * 30) * kPi / 180;
  EXPECT_NEAR((on_other[2].position - Vector3(5.4 + ring * std::cos(green), 5 + ring * std::sin(green), 0.085)).norm(),
              0, 1e-12);
}

// The robot is rolled by 30 degrees to its right, about its x axis.
TEST(ColourCameras, LedsAndBeaconLeanWithTheirRobot)
{
  TestWorld world;
  world.AddFootbot(5, 5);
  CSwarmanoidSpace& space = world.Space();
  const Pose pose{{5, 5, 0.02}, QuaternionFromEuler({kPi / 6, 0, 0})};
  space.SetPose(0, pose);
  Paint(world, 0, CCI_Colour::RED);
  space.GetEntity(0).SetAttribute("beacon", CCI_Colour::WHITE);
  SensorWorld sensor_world(space);
  sensor_world.Refresh();
  BlobSources sources(sensor_world);
  sources.Refresh();
  const auto blobs = sources.AtForTest(0);
  ASSERT_EQ(blobs.size(), 2U);
  for (const auto& [blob, height] : {std::pair(blobs[0], 0.174), std::pair(blobs[1], 0.085)})
  {
    const Vector3 leant(5, 5 - height * std::sin(kPi / 6), 0.02 + height * std::cos(kPi / 6));
    EXPECT_NEAR((blob.position - leant).norm(), 0, 1e-12) << blob.position.transpose();
  }
}

// Distances and angles are those in the plane of its base.
TEST(ColourCameras, ALeaningCameraMeasuresInTheFrameOfItsRobot)
{
  TestWorld world;
  world.AddFootbot(5, 5);
  const std::vector<Vector3> places{{5.3, 5, 0}, {5, 5.4, 0}, {4.8, 4.8, 0}};
  for (const Vector3& place : places) world.AddFootbot(place.x(), place.y());
  TestSensor camera(world, "footbot_omnidirectional_camera", "generic_footbot_omnidirectional_camera", {0});
  const std::vector<std::uint32_t> colours{CCI_Colour::RED, CCI_Colour::GREEN, CCI_Colour::BLUE};
  for (std::uint32_t k = 0; k < 3; ++k) Paint(world, k + 1, colours[k]);
  const Pose pose{{5, 5, 0}, QuaternionFromEuler({0.15, -0.1, 0.7})};
  world.Space().SetPose(0, pose);
  camera.Update();
  ASSERT_EQ(BlobsOf(camera, 0).size(), 3U);
  const Vector3 eye = pose.Apply({0, 0, 0.2887});
  for (std::size_t k = 0; k < 3; ++k)
  {
    const Vector3 seen = pose.orientation.conjugate() * (places[k] + Vector3(0, 0, 0.085) - eye);
    const CCI_ColourBlob* blob = camera.Of<CCI_ColourBlobSensor>(0).GetNearestBlob(colours[k]);
    ASSERT_NE(blob, nullptr);
    EXPECT_NEAR(blob->distance_m, std::hypot(seen.x(), seen.y()), 1e-9) << k;
    EXPECT_NEAR(blob->angle_rad, std::atan2(seen.y(), seen.x()), 1e-9) << k;
  }
}

TEST(ColourCameras, ATallBlockHidesWhatIsBehindIt)
{
  TestWorld world;
  world.AddFootbot(5, 5);
  world.AddFootbot(5.5, 5);
  world.AddFootbot(5, 5.5);
  world.AddBlock({5.25, 5, 0.25}, {0.05, 0.2, 0.5});
  TestSensor camera(world, "footbot_omnidirectional_camera", "generic_footbot_omnidirectional_camera", {0});
  Paint(world, 1, CCI_Colour::RED);
  Paint(world, 2, CCI_Colour::RED);
  camera.Update();
  ASSERT_EQ(BlobsOf(camera, 0).size(), 1U);
  EXPECT_NEAR(BlobsOf(camera, 0)[0].angle_rad, kPi / 2, 1e-12);
}

TEST(ColourCameras, RobotsSeeTheLedsOfAnotherWorldButItsBodiesHideNothing)
{
  TestWorld world;
  world.AddEngine("other");
  world.AddFootbot(5, 5);
  world.AddFootbot(5.5, 5);
  // A tall pillar of the other world is between them, and a target of that world is behind another pillar of it.
  world.Add(EntityKind::kBlock, {5.25, 5, 0.25}, 0, {0.05, 0.2, 0.5}, false, 1);
  world.AddFootbot(5, 5.5, 0, 0, 1);
  world.Add(EntityKind::kBlock, {5, 5.25, 0.25}, 0, {0.2, 0.05, 0.5}, false, 1);
  TestSensor camera(world, "footbot_omnidirectional_camera", "generic_footbot_omnidirectional_camera", {0});
  Paint(world, 1, CCI_Colour::RED);
  Paint(world, 3, CCI_Colour::GREEN);
  camera.Update();
  ASSERT_EQ(BlobsOf(camera, 0).size(), 1U);
  EXPECT_EQ(BlobsOf(camera, 0)[0].colour, CCI_Colour::RED);
}

TEST(ColourCameras, EyebotSeesPreysPatchesAndFootbotsBelow)
{
  TestWorld world;
  world.AddEngine("sky");
  world.AddEyebot(5, 5, 2, kPi, 1);
  world.AddFootbot(5.5, 5);
  const auto prey = world.AddPrey(5, 5.6, 0.1, 0.1);
  world.Configuration().entities[prey].colour = CCI_Colour::MAGENTA;
  const auto nest = world.Add(EntityKind::kGroundPatch, {4.3, 5, 0}, 0, {1, 1, 0}, false, -1);
  world.Configuration().entities[nest].colour = CCI_Colour::GREEN;
  world.AddPrey(7, 5, 0.1, 0.1);  // beyond 2 m * tan 30 degrees = 1.155 m
  TestSensor camera(world, "eyebot_camera", "generic_eyebot_camera", {0});
  Paint(world, 1, CCI_Colour::BLUE);
  camera.Update();
  const auto& sensor = camera.Of<CCI_ColourBlobSensor>(0);
  EXPECT_EQ(sensor.GetAllBlobs().size(), 3U);
  ASSERT_NE(sensor.GetNearestBlob(CCI_Colour::BLUE), nullptr);
  EXPECT_NEAR(sensor.GetNearestBlob(CCI_Colour::BLUE)->distance_m, 0.5, 1e-12);
  EXPECT_NEAR(std::abs(sensor.GetNearestBlob(CCI_Colour::BLUE)->angle_rad), kPi, 1e-12);
  EXPECT_NEAR(sensor.GetNearestBlob(CCI_Colour::MAGENTA)->angle_rad, -kPi / 2, 1e-12);
  EXPECT_NEAR(sensor.GetNearestBlob(CCI_Colour::GREEN)->distance_m, 0.7, 1e-12);
  EXPECT_NEAR(sensor.GetNearestBlob(CCI_Colour::GREEN)->angle_rad, 0, 1e-12);
}

TEST(ColourCameras, LaserSpotLiesWhereTheBeamMeetsFloorOrRobotAndFootbotsSeeIt)
{
  TestWorld world;
  world.AddEngine("sky");
  world.AddFootbot(5, 5);
  const auto eyebot = world.AddEyebot(5, 6, 1, kPi / 2, 1);
  const auto lit = world.AddFootbot(8, 8);
  TestSensor camera(world, "footbot_omnidirectional_camera", "generic_footbot_omnidirectional_camera", {0});
  CSwarmanoidSpace& space = world.Space();
  auto& laser = space.GetEntity(eyebot);
  const auto spots = [&]
  {
    SensorWorld sensor_world(space);
    sensor_world.Refresh();
    BlobSources sources(sensor_world);
    sources.Refresh();
    return std::vector<BlobSource>(sources.Free().begin(), sources.Free().end());
  };
  EXPECT_TRUE(spots().empty());

  // The robot heads north and the pan is 180 degrees, so the beam leans south.
  laser.SetAttribute("laser", 1);
  laser.SetAttribute("laser_pan", kPi);
  laser.SetAttribute("laser_tilt", std::atan(0.5));
  ASSERT_EQ(spots().size(), 1U);
  EXPECT_EQ(spots()[0].colour, CCI_Colour::RED);
  EXPECT_NEAR((spots()[0].position - Vector3(5, 5.5, 0)).norm(), 0, 1e-12);
  camera.Update();
  ASSERT_EQ(BlobsOf(camera, 0).size(), 1U);
  EXPECT_NEAR(BlobsOf(camera, 0)[0].distance_m, 0.5, 1e-9);
  EXPECT_NEAR(BlobsOf(camera, 0)[0].angle_rad, kPi / 2, 1e-9);

  // The beam falls onto the top of a robot.
  space.SetPose(lit, {{5, 6, 0}, Quaternion::Identity()});
  laser.SetAttribute("laser_tilt", 0);
  ASSERT_EQ(spots().size(), 1U);
  EXPECT_NEAR((spots()[0].position - Vector3(5, 6, 0.146899733)).norm(), 0, 1e-12);
}

// A laser of an eyebot in the sky, above the middle of the arena.
struct LaserScene
{
  LaserScene()
  {
    world.AddEngine("sky");
    world.AddEngine("third");
    eyebot = world.AddEyebot(5, 5, 2, 0, 1);
  }
  void PointAt(const Vector3& place)
  {
    auto& laser = world.Space().GetEntity(eyebot);
    const Vector3 way = place - laser.GetPosition();
    laser.SetAttribute("laser", 1);
    laser.SetAttribute("laser_pan", std::atan2(way.y(), way.x()));
    laser.SetAttribute("laser_tilt", std::acos(-way.z() / way.norm()));
  }
  // Whether a camera of the robot sees a red blob.
  bool IsSeenBy(std::uint32_t robot, const std::string& camera)
  {
    TestSensor sensor(world, camera, "generic_" + camera, {robot}, {{"aperture", "85"}, {"range", "20"}});
    sensor.Update();
    return sensor.Of<CCI_ColourBlobSensor>(0).GetNearestBlob(CCI_Colour::RED) != nullptr;
  }

  TestWorld world;
  std::uint32_t eyebot = 0;
};

TEST(ColourCameras, BodiesOfAnyEngineHideALaserSpotAsTheyStopTheBeam)
{
  for (const int engine : {0, 1, 2})
  {
    LaserScene scene;
    const auto observer = scene.world.AddFootbot(5, 5.4);
    const auto high = scene.world.AddEyebot(5, 7, 1, 0, 1);
    const auto between = scene.world.AddFootbot(5, 8, 0, 0, engine);
    scene.PointAt({5, 4.6, 0});
    EXPECT_TRUE(scene.IsSeenBy(observer, "footbot_omnidirectional_camera")) << engine;
    EXPECT_TRUE(scene.IsSeenBy(high, "eyebot_camera")) << engine;
    // It stands beside the beam, which falls onto the floor, and between the cameras and the spot.
    scene.world.Space().SetPose(between, {{5, 4.73, 0}, Quaternion::Identity()});
    EXPECT_FALSE(scene.IsSeenBy(observer, "footbot_omnidirectional_camera")) << engine;
    EXPECT_FALSE(scene.IsSeenBy(high, "eyebot_camera")) << engine;
  }
}

TEST(ColourCameras, ALaserSpotOnARobotIsSeenFromAboveAndNotThroughTheRobot)
{
  for (const int engine : {0, 1, 2})
  {
    LaserScene scene;
    const auto lit = scene.world.AddFootbot(5, 5, 0, 0, engine);
    const auto near = scene.world.AddFootbot(5.3, 5);
    const auto far = scene.world.AddFootbot(5, 5.9);
    const auto before = scene.world.AddFootbot(6.6, 5);
    const auto behind = scene.world.AddFootbot(7.2, 5);
    for (double place = -0.08; place < 0.081; place += 0.0101)
    {
      scene.PointAt({5 + place, 5, DescriptionOf(EntityKind::kFootbot).size.z()});
      EXPECT_TRUE(scene.IsSeenBy(near, "footbot_omnidirectional_camera")) << engine << " top at " << place;
      EXPECT_TRUE(scene.IsSeenBy(far, "footbot_omnidirectional_camera")) << engine << " top at " << place;
      EXPECT_TRUE(scene.IsSeenBy(scene.eyebot, "eyebot_camera")) << engine << " top at " << place;
    }
    // On its side.
    scene.world.Space().SetPose(lit, {{7, 5, 0}, Quaternion::Identity()});
    scene.PointAt({7 - 0.085, 5, 0.05});
    EXPECT_TRUE(scene.IsSeenBy(before, "footbot_omnidirectional_camera")) << engine;
    EXPECT_FALSE(scene.IsSeenBy(behind, "footbot_omnidirectional_camera")) << engine;
  }
}

TEST(ColourCameras, NoiseOfReadingsHasTheGivenDeviation)
{
  TestWorld world;
  world.AddFootbot(5, 5);
  world.AddFootbot(5.4, 5);
  TestSensor camera(world, "footbot_omnidirectional_camera", "generic_footbot_omnidirectional_camera", {0},
                    {{"distance_noise_kind", "gaussian"}, {"distance_noise_deviation", "0.02"}});
  Paint(world, 1, CCI_Colour::RED);
  double sum = 0, squares = 0;
  constexpr int kTicks = 10000;
  for (int tick = 0; tick < kTicks; ++tick)
  {
    world.Space().SetTick(static_cast<std::uint64_t>(tick));
    camera.Update();
    const double error = BlobsOf(camera, 0)[0].distance_m - 0.4;
    ASSERT_NEAR(BlobsOf(camera, 0)[0].angle_rad, 0, 1e-12);
    sum += error;
    squares += error * error;
  }
  EXPECT_NEAR(sum / kTicks, 0, 4 * 0.02 / 100);
  EXPECT_NEAR(std::sqrt(squares / kTicks), 0.02, 4 * 0.02 / 141);
}

TEST(ColourCameras, PixelCameraIsAtMostOnePixelOffWithoutNoise)
{
  for (const char* robot : {"footbot", "eyebot"})
  {
    TestWorld world;
    RandomStream random(3, 3, 3, 3);
    const bool is_footbot = robot == std::string("footbot");
    if (is_footbot)
      world.AddFootbot(5, 5);
    else
      world.AddEyebot(5, 5, 2);
    for (int n = 0; n < 12; ++n) world.AddFootbot(5 + random.Uniform(-0.5, 0.5), 5 + random.Uniform(-0.5, 0.5));
    const std::string label = is_footbot ? "footbot_omnidirectional_camera" : "eyebot_camera";
    TestSensor ideal(world, label, "generic_" + label, {0});
    TestSensor pixels(world, label, "pixel_noise_" + label, {0});
    for (const std::uint32_t other : world.RobotsOf(EntityKind::kFootbot)) Paint(world, other, CCI_Colour::RED);
    ideal.Update();
    pixels.Update();
    ASSERT_EQ(BlobsOf(pixels, 0).size(), BlobsOf(ideal, 0).size());
    ASSERT_GT(BlobsOf(ideal, 0).size(), 2U);
    const double height = is_footbot ? 0.2887 - 0.085 : 2 - 0.085;
    const double radians_per_pixel = (is_footbot ? 70 : 30) * kPi / 180 / 240;
    for (std::size_t i = 0; i < BlobsOf(ideal, 0).size(); ++i)
    {
      const double exact = std::atan2(BlobsOf(ideal, 0)[i].distance_m, height);
      const double seen = std::atan2(BlobsOf(pixels, 0)[i].distance_m, height);
      EXPECT_NEAR(seen, exact, 0.71 * radians_per_pixel);
      EXPECT_NEAR(std::remainder(BlobsOf(pixels, 0)[i].angle_rad - BlobsOf(ideal, 0)[i].angle_rad, 2 * kPi), 0,
                  0.71 * radians_per_pixel / exact + 1e-9);
    }
  }
}

TEST(ColourCameras, PixelCameraMissesTheGivenShare)
{
  TestWorld world;
  world.AddFootbot(5, 5);
  world.AddFootbot(5.4, 5);
  TestSensor camera(world, "footbot_omnidirectional_camera", "pixel_noise_footbot_omnidirectional_camera", {0},
                    {{"miss_probability", "0.25"}, {"noise_kind", "gaussian"}, {"noise_deviation", "2"}});
  Paint(world, 1, CCI_Colour::RED);
  int seen = 0;
  for (std::uint64_t tick = 0; tick < 4000; ++tick)
  {
    world.Space().SetTick(tick);
    camera.Update();
    seen += static_cast<int>(BlobsOf(camera, 0).size());
  }
  EXPECT_NEAR(seen / 4000.0, 0.75, 4 * std::sqrt(0.1875 / 4000));
}

TEST(ColourCameras, HandbotLooksAhead)
{
  TestWorld world;
  world.Add(EntityKind::kHandbot, {5, 5, 0}, kPi / 2, {0.18, 0.17, 0.16});
  world.AddFootbot(5, 6);
  world.AddFootbot(5, 4);
  TestSensor camera(world, "handbot_camera", "generic_handbot_camera", {0});
  Paint(world, 1, CCI_Colour::RED);
  Paint(world, 2, CCI_Colour::BLUE);
  camera.Update();
  ASSERT_EQ(BlobsOf(camera, 0).size(), 1U);
  EXPECT_EQ(BlobsOf(camera, 0)[0].colour, CCI_Colour::RED);
  EXPECT_NEAR(BlobsOf(camera, 0)[0].distance_m, std::hypot(0.91, 0.015), 1e-12);
  EXPECT_NEAR(BlobsOf(camera, 0)[0].elevation_rad, std::atan2(-0.015, 0.91), 1e-12);
}

TEST(ColourCameras, AFootbotLooksAheadFromItsRim)
{
  TestWorld world;
  world.AddFootbot(5, 5, kPi / 2);
  for (const double y : {6.0, 4.0, 7.5}) world.AddFootbot(5, y);  // ahead, behind, too far
  for (const std::uint32_t robot : {1U, 2U, 3U}) world.Space().GetEntity(robot).SetAttribute("beacon", CCI_Colour::RED);
  TestSensor camera(world, "footbot_perspective_camera", "generic_footbot_perspective_camera", {0});
  camera.Update();
  ASSERT_EQ(BlobsOf(camera, 0).size(), 1U);
  EXPECT_NEAR(BlobsOf(camera, 0)[0].distance_m, 1 - 0.085036758, 1e-12);
  EXPECT_NEAR(BlobsOf(camera, 0)[0].elevation_rad, 0, 1e-12);
  EXPECT_NEAR(BlobsOf(camera, 0)[0].angle_rad, 0, 1e-12);
}

}  // namespace
}  // namespace swarmanoid

// Sensors and queries use the bodies that the engines describe.
#include "common/space/collision_models.h"

#include "common/control_interface/ci_colour_blob_sensor.h"
#include "common/control_interface/footbot/ci_footbot_proximity_sensor.h"
#include "common/mesh/convex_hull.h"
#include "common/plugin_descriptions/describe_builtins.h"
#include "common/plugin_descriptions/robot_parts.h"
#include "common/space/space_query.h"
#include "controller_host/devices/sensing/sensor_world.h"
#include "tests/unit/devices/test_world.h"

namespace swarmanoid
{
namespace
{

using Parts = HandbotParts;

const Vector3 kHandbotSize(0.22, 0.17, 0.16);

std::uint32_t AddHandbot(TestWorld& world, double x, double y, double yaw = 0)
{
  return world.Add(EntityKind::kHandbot, {x, y, 0}, yaw, kHandbotSize);
}

TEST(CollisionModels, AnArmTurnsAboutItsShoulderAndTheHeadAboutItsAxis)
{
  DescribeBuiltins();
  TestWorld world;
  world.Configuration().engines[0].tag = "dynamics3d";
  const std::uint32_t handbot = AddHandbot(world, 5, 5);
  const CollisionModels models(world.Space());
  EXPECT_TRUE(models.IsArticulated(handbot));
  std::vector<CollisionBody> bodies;
  const auto tip = [&](std::size_t arm)
  {
    models.BodiesOf(handbot, bodies);
    return bodies.at(2 + arm).pose.Apply({0, 0, bodies[2 + arm].half_size.z()});
  };
  constexpr double kAhead = Parts::kHeadForward + Parts::kArmLength;
  EXPECT_LT((tip(0) - Vector3(kAhead, Parts::kShoulder, Parts::kHeadHeight)).norm(), 1e-12);
  EXPECT_LT((tip(1) - Vector3(kAhead, -Parts::kShoulder, Parts::kHeadHeight)).norm(), 1e-12);
  // A quarter turn outwards, then the head by a quarter turn: what was on the left is above.
  world.Space().GetEntity(handbot).SetAttribute("arm", kPi / 2, 0);
  EXPECT_LT((tip(0) - Vector3(Parts::kHeadForward, Parts::kShoulder + Parts::kArmLength, Parts::kHeadHeight)).norm(),
            1e-12);
  world.Space().GetEntity(handbot).SetAttribute("head_angle", kPi / 2);
  EXPECT_LT(
      (tip(0) - Vector3(Parts::kHeadForward, 0, Parts::kHeadHeight + Parts::kShoulder + Parts::kArmLength)).norm(),
      1e-12);
}

TEST(CollisionModels, TheGripperOfTheKinematicFootbotTurnsWithItsTurretAndIsNoBodyToSensors)
{
  DescribeBuiltins();
  TestWorld world;
  const std::uint32_t footbot = world.AddFootbot(5, 5);
  const std::uint32_t loose = world.Add(EntityKind::kHandbot, {3, 3, 0}, 0, kHandbotSize, true, -1);
  const CollisionModels models(world.Space());
  EXPECT_TRUE(models.Articulated().empty());
  world.Space().GetEntity(footbot).SetAttribute("turret_angle", kPi / 2);
  std::vector<CollisionBody> bodies;
  models.BodiesOf(footbot, bodies);
  ASSERT_EQ(bodies.size(), 4U);  // the body, two wheels, the gripper
  const Vector3 face = bodies[3].pose.Apply({bodies[3].half_size.x(), 0, 0});
  EXPECT_LT((face.head<2>() - Vector2(0, GripperSquare::kReach)).norm(), 1e-12);
  models.BodiesOf(loose, bodies);
  ASSERT_EQ(bodies.size(), 1U) << "no engine has it: its plain body";
  EXPECT_EQ(bodies[0].half_size, kHandbotSize / 2);
}

// A footbot before the tip of an arm at the height of its ring, in the engines that have arms and in one that has none.
TEST(CollisionModels, AFootbotFeelsTheArmThatItWouldRunInto)
{
  DescribeBuiltins();
  for (const char* engine : {"dynamics3d", "dummy_engine"})
  {
    TestWorld world;
    world.Configuration().engines[0].tag = engine;
    const std::uint32_t handbot = AddHandbot(world, 5, 5);
    constexpr double kGap = 0.03;
    constexpr double kRing = 0.085036758;
    const double tip = 5 + Parts::kHeadForward + Parts::kArmLength;
    world.AddFootbot(tip + kGap + kRing, 5 + Parts::kShoulder, kPi);
    // The head is turned by 90 degrees: the left arm is above and the right one below, at 0.05 m; the ring is at 0.06
    // m.
    world.Space().GetEntity(handbot).SetAttribute("head_angle", kPi / 2);
    const bool has_arms = std::string(engine) == "dynamics3d";
    TestSensor sensor(world, "footbot_proximity", "generic_footbot_proximity", {1});
    world.Space().SetPose(1, {{tip + kGap + kRing, 5, 0}, QuaternionFromYaw(kPi - 7.5 * kPi / 180)});
    sensor.Update();
    // The first ray goes straight towards the arm.
    const double reading = sensor.Of<CCI_FootBotProximitySensor>(0).GetAllSensorReadings()[0];
    if (has_arms)
      EXPECT_NEAR(reading, 0.0100527 / (kGap + 0.000163144), 1e-9);
    else
      EXPECT_EQ(reading, 0);
  }
}

// A footbot is before the long side of a prism of half a square, inside the box around it.
TEST(CollisionModels, AFootbotFeelsAHullWhereItsSideIs)
{
  DescribeBuiltins();
  for (const bool movable : {false, true})
  {
    TestWorld world;
    world.Configuration().engines[0].tag = "dynamics3d";
    const std::uint32_t prism = world.Add(EntityKind::kBlock, {5, 5, 0.1}, 0, {0.4, 0.4, 0.2}, movable);
    std::vector<Vector3> corners;
    for (const double z : {-0.1, 0.1}) corners.insert(corners.end(), {{-0.2, -0.2, z}, {0.2, -0.2, z}, {-0.2, 0.2, z}});
    world.Configuration().entities[prism].hull = std::make_shared<const ConvexHull>(HullOf(corners));
    constexpr double kGap = 0.03;
    const double away = (0.085036758 + kGap) / std::sqrt(2.0);
    world.AddFootbot(5 + away, 5 + away, 1.25 * kPi - 7.5 * kPi / 180);
    TestSensor sensor(world, "footbot_proximity", "generic_footbot_proximity", {1});
    sensor.Update();
    EXPECT_NEAR(sensor.Of<CCI_FootBotProximitySensor>(0).GetAllSensorReadings()[0], 0.0100527 / (kGap + 0.000163144),
                1e-9);
    SpaceQuery query(world.Space());
    EXPECT_FALSE(query.IsOccluded({5.19, 4.83, 0.1}, {5.19, 5.19, 0.1}, 1, 1));
    EXPECT_TRUE(query.IsOccluded({5.19, 4.79, 0.1}, {5.19, 5.19, 0.1}, 1, 1));
    EXPECT_TRUE(query.IsOccluded({4.9, 4.9, 0.3}, {4.9, 4.9, 0.05}, 1, 1));
  }
}

// An eyebot of one engine above a footbot of another one, with a roof between that only the footbot's engine has.
TEST(CollisionModels, CamerasAndQueriesAgreeOnWhatIsHidden)
{
  DescribeBuiltins();
  int hidden = 0;
  for (int place = 0; place < 40; ++place)
  {
    TestWorld world;
    world.AddEngine("sky");
    world.AddEyebot(5, 5, 1.5, 0, 1);
    world.AddFootbot(5.4, 5);
    world.AddBlock({5.1 + 0.02 * place, 5, 0.9}, {0.1, 0.3, 0.02});
    for (int led = 0; led < 12; ++led) world.Space().GetEntity(1).SetAttribute("led", 0, led);
    world.Space().GetEntity(1).SetAttribute("beacon", 0xff0000);
    TestSensor camera(world, "eyebot_camera", "generic_eyebot_camera", {0});
    camera.Update();
    SpaceQuery query(world.Space());
    const Vector3 beacon(5.4, 5, *DescriptionOf(EntityKind::kFootbot).beacon_height_m);
    const bool occluded = query.IsOccluded(world.Space().GetEntity(0).GetPosition(), beacon, 0, 1);
    EXPECT_EQ(camera.Of<CCI_ColourBlobSensor>(0).GetAllBlobs().empty(), occluded) << place;
    hidden += occluded ? 1 : 0;
  }
  EXPECT_GT(hidden, 2);
  EXPECT_LT(hidden, 38);
}

// Among handbots with arms in all positions: the grid of the sensors, the index of the queries, and all parts of all.
TEST(CollisionModels, RaysOfSensorsAndQueriesMeetTheSameArms)
{
  DescribeBuiltins();
  TestWorld world;
  world.Configuration().engines[0].tag = "dynamics3d";
  RandomStream random(1, 2, 3, 4);
  for (int k = 0; k < 12; ++k)
    AddHandbot(world, 4 + random.Uniform(0, 2), 4 + random.Uniform(0, 2), random.Uniform(-3, 3));
  const std::uint32_t observer = world.AddFootbot(8, 8);
  for (std::uint32_t k = 0; k < 12; ++k)
  {
    CSwarmanoidSpaceEntity& handbot = world.Space().GetEntity(k);
    handbot.SetAttribute("head_angle", random.Uniform(-3, 3));
    for (const int arm : {0, 1}) handbot.SetAttribute("arm", random.Uniform(0, 1), arm);
  }
  SpaceQuery query(world.Space());
  SensorWorld sensed(world.Space());
  sensed.Refresh();
  const CollisionModels models(world.Space());
  std::vector<CollisionBody> bodies;
  int hits = 0;
  for (int trial = 0; trial < 600; ++trial)
  {
    const Vector3 from(3.5 + random.Uniform(0, 3), 3.5 + random.Uniform(0, 3), random.Uniform(0, 0.2));
    const Vector3 to = from + Vector3(random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-0.2, 0.2));
    double nearest = 2;
    for (std::uint32_t k = 0; k < 12; ++k)
    {
      models.BodiesOf(k, bodies);
      if (const auto hit = SegmentHit(bodies, world.Space().GetPose(k), from, to)) nearest = std::min(nearest, *hit);
    }
    const auto asked = query.FindFirstHit(from, to, observer);
    EXPECT_EQ(asked ? asked->fraction : 2, nearest);
    EXPECT_EQ(sensed.FirstHit(from, to, [](std::uint32_t) { return true; }), nearest);
    hits += nearest < 2 ? 1 : 0;
  }
  EXPECT_GT(hits, 30);
  EXPECT_LT(hits, 570);
}

}  // namespace
}  // namespace swarmanoid

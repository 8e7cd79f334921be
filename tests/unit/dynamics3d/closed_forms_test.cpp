// Tests the engine against closed forms of mechanics.
#include <cmath>

#include "dynamics3d_test_world.h"
#include "engine_worker/engines/dynamics3d/propelled.h"

namespace swarmanoid
{
namespace
{

TEST(Dynamics3dClosedForms, ABlockFallsFreely)
{
  Dynamics3dTestWorld world;
  const auto block = world.AddBlock({5, 5, 20}, {0.2, 0.2, 0.2}, 1);
  world.Run(10);
  // Semi-implicit Euler of n steps h falls g h² n (n + 1) / 2, which is g t² / 2 and g h t / 2 more.
  EXPECT_NEAR(20 - world.Position(block).z(), kGravity * 0.005 * 0.005 * 200 * 201 / 2, 1e-9);
  EXPECT_NEAR(20 - world.Position(block).z(), kGravity / 2, 0.03);
}

TEST(Dynamics3dClosedForms, TheSubclockShortensTheSteps)
{
  Dynamics3dTestWorld world;
  world.SetSubclock(4);
  const auto block = world.AddBlock({5, 5, 20}, {0.2, 0.2, 0.2}, 1);
  world.Run(10);
  EXPECT_NEAR(20 - world.Position(block).z(), kGravity * 0.00125 * 0.00125 * 800 * 801 / 2, 1e-9);
}

TEST(Dynamics3dClosedForms, GravityPullsAlongTheAxisThatIsAskedFor)
{
  Dynamics3dTestWorld world("gravity", "0, 1.5, 0");
  const auto block = world.AddBlock({5, 5, 2}, {0.2, 0.2, 0.2}, 1);
  world.Run(20);
  EXPECT_NEAR(world.Position(block).y(), 5 + 1.5 * 4 / 2, 0.01);
  EXPECT_NEAR(world.Position(block).z(), 2, 1e-12);
}

// The ground is tilted about the y axis of the engine's frame; the block slides towards +x of the frame.
double SlideAfterTwoSeconds(double degrees, const char* friction)
{
  Dynamics3dTestWorld world("orientation", "0, " + std::to_string(degrees) + ", 0", "friction", friction);
  const Quaternion tilt = QuaternionFromEuler({0, DegreesToRadians(degrees), 0});
  const auto block = world.AddBlock(tilt * Vector3(0, 0, 0.05), {0.4, 0.4, 0.1}, 2, tilt);
  world.Run(20);
  const Vector3 moved = tilt.conjugate() * world.Position(block);
  EXPECT_NEAR(moved.y(), 0, 0.02);
  EXPECT_NEAR(moved.z(), 0.05, 1e-3);
  return moved.x();
}

TEST(Dynamics3dClosedForms, ABlockHoldsBelowTheAngleOfFrictionAndSlidesAboveIt)
{
  // The angle is atan(0.4) = 21.8 degrees.
  EXPECT_NEAR(SlideAfterTwoSeconds(20, "0.4"), 0, 2e-3);
  EXPECT_GT(SlideAfterTwoSeconds(24, "0.4"), 0.3);
}

TEST(Dynamics3dClosedForms, ABlockSlidesDownAnInclineWithTheAccelerationOfCoulombFriction)
{
  const double angle = DegreesToRadians(30);
  const double acceleration = kGravity * (Sin(angle) - 0.3 * Cos(angle));
  EXPECT_NEAR(SlideAfterTwoSeconds(30, "0.3"), acceleration * 2, 0.02 * acceleration * 2);
}

TEST(Dynamics3dClosedForms, AHandbotOnItsRopeSwingsLikeAPendulum)
{
  // Gravity is 5 degrees off the vertical: let go below its hook, the robot swings about that angle.
  Dynamics3dTestWorld world;
  const double angle = DegreesToRadians(5);
  world.Set("gravity", "0, " + std::to_string(kGravity * Sin(angle)) + ", " + std::to_string(-kGravity * Cos(angle)));
  world.Set("ceiling", "true");
  world.experiment.clock_tick_ms = 10;
  const auto handbot = world.AddHandbot({5, 5, 0.5});
  world.Command("handbot_rope", handbot, {1, 0});
  world.Tick();
  ASSERT_EQ(world.Attribute(handbot, "rope_attached"), 1);
  const double rope = world.Attribute(handbot, "rope_length");
  EXPECT_NEAR(rope, 3 - 0.5 - 0.16, 1e-3);

  std::vector<double> crossings;
  const double to_mass = 0.09;  // m from the rope's end to the centre of mass
  const double middle = 5 + (rope + 0.16) * Sin(angle);
  double before = -1;
  for (int tick = 0; tick < 1500; ++tick)
  {
    world.Tick();
    const double now = world.Position(handbot).y() - middle;
    if (before < 0 && now >= 0) crossings.push_back(0.01 * tick);
    before = now;
  }
  ASSERT_GE(crossings.size(), 3U);
  const double period = (crossings.back() - crossings.front()) / static_cast<double>(crossings.size() - 1);
  EXPECT_NEAR(period, 2 * kPi * std::sqrt((rope + to_mass) / kGravity), 0.03);
}

TEST(Dynamics3dClosedForms, AnEyebotHoversWithAThrustOfItsWeight)
{
  Dynamics3dTestWorld world;
  const auto eyebot = world.AddEyebot({5, 5, 1}, 0.7);
  world.Run(100);
  EXPECT_LT((world.Position(eyebot) - Vector3(5, 5, 1)).norm(), 1e-4);
  EXPECT_NEAR(world.Yaw(eyebot), 0.7, 1e-4);
  const auto* model = dynamic_cast<const dynamics3d::PropelledModel*>(world.engine->ModelForTest(eyebot));
  ASSERT_NE(model, nullptr);
  EXPECT_NEAR(model->ThrustForTest(), DescriptionOf(EntityKind::kEyebot).mass_kg * kGravity, 1e-3);
}

TEST(Dynamics3dClosedForms, TheWorkOfAnEyebotsThrustIsTheEnergyThatItGains)
{
  Dynamics3dTestWorld world;
  world.experiment.clock_tick_ms = 5;  // a tick is a step: the thrust of each is seen
  const auto eyebot = world.AddEyebot({5, 5, 0.5});
  world.Run(20);
  world.Command("eyebot_propellers", eyebot, {0, 0, 0.4, 0});
  const auto* model = dynamic_cast<const dynamics3d::PropelledModel*>(world.engine->ModelForTest(eyebot));
  ASSERT_NE(model, nullptr);
  const double mass = DescriptionOf(EntityKind::kEyebot).mass_kg;
  const double start = world.Position(eyebot).z();
  double work = 0;
  double speed = 0;
  for (int step = 0; step < 400; ++step)
  {
    const double before = world.Position(eyebot).z();
    world.Tick();
    const double way = world.Position(eyebot).z() - before;
    // Since x' = x + h v', the mean speed of the step is half of the old and half of the new one.
    work += model->ThrustForTest() * (speed + way / 0.005) / 2 * 0.005;
    speed = way / 0.005;
  }
  const double risen = world.Position(eyebot).z() - start;
  EXPECT_NEAR(speed, 0.4, 0.01);
  const double gained = mass * kGravity * risen + mass * speed * speed / 2;
  EXPECT_NEAR(work, gained, 0.005 * gained);
}

TEST(Dynamics3dClosedForms, AnEyebotReachesTheCommandedVelocityAndYawRate)
{
  Dynamics3dTestWorld world;
  const auto eyebot = world.AddEyebot({5, 5, 1});
  world.Command("eyebot_propellers", eyebot, {0.5, 0.2, 0.1, 0});
  world.Run(50);
  const Vector3 start = world.Position(eyebot);
  world.Run(10);
  EXPECT_LT((world.Position(eyebot) - start - Vector3(0.5, 0.2, 0.1)).norm(), 0.01);

  world.Command("eyebot_propellers", eyebot, {0, 0, 0, 0.5});
  world.Run(30);
  const double yaw = world.Yaw(eyebot);
  world.Run(10);
  EXPECT_NEAR(WrapAngle(world.Yaw(eyebot) - yaw), 0.5, 0.01);
}

TEST(Dynamics3dClosedForms, AFootbotDrivesAtTheSpeedOfItsWheels)
{
  Dynamics3dTestWorld world;
  const auto footbot = world.AddFootbot({2, 5, 0});
  world.Run(10);
  for (int k = 0; k < 3; ++k)
    EXPECT_NEAR(world.Sensor("footbot_accelerometer", footbot, k), k == 2 ? kGravity : 0, 0.05);
  world.Drive(footbot, 0.1, 0.1);
  world.Run(10);
  const double start = world.Position(footbot).x();
  world.Run(50);
  const double driven = world.Position(footbot).x() - start;
  EXPECT_NEAR(driven, 0.5, 0.01 * 0.5);
  EXPECT_NEAR(world.Position(footbot).y(), 5, 1e-3);
  EXPECT_NEAR(world.Sensor("footbot_encoders", footbot, 0), driven / 50, 0.05 * 0.01);
  EXPECT_LT(world.Tilt(footbot), DegreesToRadians(1));
}

// Returns the acceleration of the accelerometer, along the axes of the space and without gravity.
Vector3 AccelerationOf(Dynamics3dTestWorld& world, std::uint32_t footbot)
{
  Vector3 felt;
  for (int k = 0; k < 3; ++k) felt[k] = world.Sensor("footbot_accelerometer", footbot, k);
  return world.Space().GetPose(footbot).orientation * felt - kGravity * Vector3::UnitZ();
}

TEST(Dynamics3dClosedForms, TheAccelerometerSumsUpToTheSpeedOfTheWheels)
{
  Dynamics3dTestWorld world;
  const auto footbot = world.AddFootbot({2, 5, 0}, 0.6);
  world.Run(10);
  world.Drive(footbot, 0.2, 0.2);
  Vector3 velocity = Vector3::Zero();
  for (int tick = 0; tick < 15; ++tick)
  {
    world.Tick();
    velocity += 0.1 * AccelerationOf(world, footbot);
  }
  EXPECT_LT((velocity - Vector3(0.2 * std::cos(0.6), 0.2 * std::sin(0.6), 0)).norm(), 0.002);
  EXPECT_NEAR(world.Sensor("footbot_encoders", footbot, 0) / 0.1, 0.2, 0.002);
}

// At rest the accelerometer feels what holds the robot, upwards, however it leans; in free fall it feels nothing.
TEST(Dynamics3dClosedForms, TheAccelerometerFeelsTheSlopeAndNoFall)
{
  Dynamics3dTestWorld world("orientation", "0, 10, 0");
  const double slope = DegreesToRadians(10);
  const Quaternion tilt(Eigen::AngleAxisd(slope, Vector3::UnitY()));
  const auto ahead = world.AddFootbot({0, 0, 0});
  const auto across = world.AddFootbot({0, 1, 0});
  const auto falling = world.AddFootbot({0, 3, 3});
  world.experiment.entities[ahead].pose.orientation = tilt;
  world.experiment.entities[across].pose.orientation = tilt * QuaternionFromYaw(kPi / 2);
  world.Run(4);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(world.Sensor("footbot_accelerometer", falling, k), 0, 1e-6) << k;
  world.Run(16);
  for (const auto footbot : {ahead, across}) EXPECT_LT(AccelerationOf(world, footbot).norm(), 0.02);
  // The front of the one is its lower end, the right side of the other; on their springs they lean a little more.
  EXPECT_NEAR(world.Sensor("footbot_accelerometer", ahead, 0), -kGravity * std::sin(slope), 0.2);
  EXPECT_NEAR(world.Sensor("footbot_accelerometer", across, 1), kGravity * std::sin(slope), 0.2);
}

TEST(Dynamics3dClosedForms, AFootbotTurnsOnTheSpotAtTheDifferentialRate)
{
  Dynamics3dTestWorld world;
  const auto footbot = world.AddFootbot({5, 5, 0});
  world.Drive(footbot, -0.07, 0.07);  // 1 rad/s
  world.Run(5);
  const double yaw = world.Yaw(footbot);
  world.Run(20);
  EXPECT_NEAR(WrapAngle(world.Yaw(footbot) - yaw), 2, 0.01);
  EXPECT_LT((world.Position(footbot) - Vector3(5, 5, 0)).norm(), 2e-3);
}

// On a slope with the angle a the wheels need m g sin a. Their traction is mu times their share of m g cos a.
TEST(Dynamics3dClosedForms, AFootbotClimbsWhatItsWheelsGripAndNothingSteeper)
{
  const auto climbed = [](double degrees, const char* friction)
  {
    Dynamics3dTestWorld world("orientation", "0, " + std::to_string(-degrees) + ", 0", "wheel_friction", friction,
                              "friction", "0.1");
    const Quaternion tilt = QuaternionFromEuler({0, DegreesToRadians(-degrees), 0});
    const auto footbot =
        world.Add(EntityKind::kFootbot, Vector3::Zero(), tilt, {0.085036758, 0.085036758, 0.146899733});
    world.Drive(footbot, 0.1, 0.1);
    world.Run(10);
    const double start = (tilt.conjugate() * world.Position(footbot)).x();
    world.Run(20);
    return (tilt.conjugate() * world.Position(footbot)).x() - start;
  };
  EXPECT_NEAR(climbed(20, "1"), 0.2, 0.01);
  EXPECT_NEAR(climbed(8, "0.4"), 0.2, 0.01);
  EXPECT_LT(climbed(25, "0.4"), -0.2) << "atan(0.4) is 21.8 degrees";
}

// Across a slope, over its lower wheel: 70 mm out, the centre of mass 44.8 mm high, atan(70 / 44.8) is 57.4 degrees.
TEST(Dynamics3dClosedForms, AFootbotTipsWhereItsCentreOfMassPassesItsWheel)
{
  for (const double degrees : {54.0, 61.0})
  {
    Dynamics3dTestWorld world("orientation", "0, " + std::to_string(degrees) + ", 0", "wheel_friction", "20",
                              "friction", "20");
    const Quaternion tilt = QuaternionFromEuler({0, DegreesToRadians(degrees), 0});
    const auto footbot = world.Add(EntityKind::kFootbot, Vector3::Zero(), tilt * QuaternionFromYaw(kPi / 2),
                                   {0.085036758, 0.085036758, 0.146899733});
    world.Run(20);
    const double turned = Acos((tilt.conjugate() * world.Orientation(footbot) * Vector3::UnitZ()).z());
    if (degrees < 57)
      EXPECT_LT(turned, DegreesToRadians(3));
    else
      EXPECT_GT(turned, DegreesToRadians(30));
  }
}

TEST(Dynamics3dClosedForms, AFootbotSpeedsUpAsItsMotorsLoseTorque)
{
  Dynamics3dTestWorld world;
  world.experiment.clock_tick_ms = 10;
  const auto footbot = world.AddFootbot({2, 5, 0});
  world.Run(50);
  const double start = world.Position(footbot).x();
  world.Drive(footbot, 2, 2);
  for (int tick = 1; tick <= 100; ++tick)
  {
    world.Tick();
    const double t = 0.01 * tick;
    EXPECT_NEAR(world.Position(footbot).x() - start, WayOfStartingFootbot(t), 0.006) << t;
  }
}

TEST(Dynamics3dClosedForms, AFootbotThatStartsStopsOrTurnsBackHardlyPitches)
{
  Dynamics3dTestWorld world;
  world.experiment.clock_tick_ms = 10;
  const auto footbot = world.AddFootbot({2, 5, 0});
  world.Start();
  for (const double speed : {0.3, 0.0, 0.3, -0.3})
  {
    world.Drive(footbot, speed, speed);
    for (int tick = 0; tick < 100; ++tick)
    {
      world.Tick();
      ASSERT_LT(world.Tilt(footbot), DegreesToRadians(1.5)) << speed << " m/s, tick " << tick;
    }
  }
}

TEST(Dynamics3dClosedForms, ABlockTipsWhereItsCentreOfMassPassesItsEdge)
{
  // It is 0.1 wide and 0.2 high: atan(0.1 / 0.2) = 26.6 degrees.
  for (const double degrees : {24.0, 29.0})
  {
    Dynamics3dTestWorld world("orientation", "0, " + std::to_string(degrees) + ", 0", "friction", "2");
    const Quaternion tilt = QuaternionFromEuler({0, DegreesToRadians(degrees), 0});
    const auto block = world.AddBlock(tilt * Vector3(0, 0, 0.1), {0.1, 0.1, 0.2}, 1, tilt);
    world.Run(30);
    const double turned = Acos((tilt.conjugate() * world.Orientation(block) * Vector3::UnitZ()).z());
    if (degrees < 26)
      EXPECT_LT(turned, DegreesToRadians(2));
    else
      EXPECT_GT(turned, DegreesToRadians(45));
  }
}

TEST(Dynamics3dClosedForms, AnUprightPreyTopplesWhereItsCentreOfMassPassesItsRim)
{
  // Radius 0.05 and height 0.25: atan(0.05 / 0.125) = 21.8 degrees.
  for (const double degrees : {19.0, 25.0})
  {
    Dynamics3dTestWorld world("orientation", "0, " + std::to_string(degrees) + ", 0", "friction", "2");
    const Quaternion tilt = QuaternionFromEuler({0, DegreesToRadians(degrees), 0});
    const auto prey = world.Add(EntityKind::kCylindricPrey, Vector3::Zero(), tilt, {0.05, 0.05, 0.25}, 1);
    world.Run(30);
    const double turned = Acos((tilt.conjugate() * world.Orientation(prey) * Vector3::UnitZ()).z());
    if (degrees < 20)
      EXPECT_LT(turned, DegreesToRadians(2));
    else
      EXPECT_GT(turned, DegreesToRadians(45));
  }
}

TEST(Dynamics3dClosedForms, ARollingPreyAcceleratesAsASolidCylinder)
{
  // Rolls without slipping down a slope: a = 2/3 g sin.
  const double degrees = 10;
  Dynamics3dTestWorld world("orientation", "0, " + std::to_string(degrees) + ", 0");
  const Quaternion tilt = QuaternionFromEuler({0, DegreesToRadians(degrees), 0});
  // It lies along y; the position is the centre of its base.
  const Quaternion lying = tilt * QuaternionFromEuler({-kPi / 2, 0, 0});
  const auto prey = world.Add(EntityKind::kCylindricPrey, tilt * Vector3(0, -0.05, 0.1), lying, {0.1, 0.1, 0.1}, 1);
  world.Run(20);
  const double along = (tilt.conjugate() * world.Position(prey)).x();
  const double expected = 2.0 / 3 * kGravity * Sin(DegreesToRadians(degrees)) * 2;
  EXPECT_NEAR(along, expected, 0.03 * expected);
}

}  // namespace
}  // namespace swarmanoid

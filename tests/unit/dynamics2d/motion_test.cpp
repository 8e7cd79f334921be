#include <cmath>

#include "dynamics2d_test_world.h"

namespace swarmanoid
{
namespace
{

constexpr double kGravity = 9.81;

TEST(Dynamics2d, EqualPreysExchangeTheirSpeedsInAnElasticHeadOnCollision)
{
  Dynamics2dTestWorld world("restitution", "1", "ground_friction", "0");
  const auto a = world.AddPrey(1, 1, 1);
  const auto b = world.AddPrey(1.5, 1, 1);
  world.Start();
  world.engine->SetVelocity(a, {0.5, 0, 0});
  world.Run(20);
  const double a_before = world.Position(a).x();
  const double b_before = world.Position(b).x();
  world.Run(10);
  EXPECT_NEAR(world.Position(a).x() - a_before, 0, 1e-4);
  EXPECT_NEAR(world.Position(b).x() - b_before, 0.5, 1e-4);
  EXPECT_NEAR(world.Position(b).y(), 1, 1e-5);
}

// If a body of m1 hits one of m2 at rest, v1 = (m1 - e m2) / (m1 + m2) u and v2 = m1 (1 + e) / (m1 + m2) u.
TEST(Dynamics2d, HeadOnCollisionsFollowMassesAndRestitution)
{
  for (const double restitution : {0.0, 0.5, 1.0})
  {
    Dynamics2dTestWorld world("restitution", std::to_string(restitution), "ground_friction", "0");
    const double heavy = 3;
    const auto a = world.AddPrey(1, 1, heavy);
    const auto b = world.AddPrey(1.5, 1, 1);
    world.Start();
    world.engine->SetVelocity(a, {0.4, 0, 0});
    world.Run(20);
    const double a_before = world.Position(a).x();
    const double b_before = world.Position(b).x();
    world.Run(10);
    const double va = world.Position(a).x() - a_before;
    const double vb = world.Position(b).x() - b_before;
    EXPECT_NEAR(va, (heavy - restitution) / (heavy + 1) * 0.4, 2e-3) << restitution;
    EXPECT_NEAR(vb, heavy * (1 + restitution) / (heavy + 1) * 0.4, 2e-3) << restitution;
    EXPECT_NEAR(heavy * va + vb, heavy * 0.4, 1e-3) << restitution;
  }
}

// The solver takes mu g h off the speed before it moves the body by v h: short by v h / 2 against v^2 / (2 mu g).
TEST(Dynamics2d, ASlidingPreyStopsAfterTheDistanceOfCoulombFriction)
{
  for (const int substeps : {4, 40, 400})
  {
    Dynamics2dTestWorld world("ground_friction", "0.25", "substeps", std::to_string(substeps));
    const auto prey = world.AddPrey(1, 1, 2);
    world.Start();
    const double speed = 1.5;
    world.engine->SetVelocity(prey, {speed, 0, 0});
    world.Run(30);
    const double exact = speed * speed / (2 * 0.25 * kGravity);
    const double step = 0.1 / substeps;
    EXPECT_NEAR(world.Position(prey).x() - 1, exact - speed * step / 2, 1e-3) << substeps;
    world.Run(10);
    EXPECT_NEAR(world.Position(prey).x() - 1, exact - speed * step / 2, 1e-3) << "it has come to rest";
  }
}

// The subclock cuts the solver's steps: the shortfall v h / 2 goes with them.
TEST(Dynamics2d, TheSubclockShortensTheSteps)
{
  for (const int subclock : {1, 5})
  {
    Dynamics2dTestWorld world("ground_friction", "0.25");
    world.SetSubclock(subclock);
    const auto prey = world.AddPrey(1, 1, 2);
    world.Start();
    world.engine->SetVelocity(prey, {1.5, 0, 0});
    world.Run(30);
    const double step = 0.1 / (4 * subclock);
    EXPECT_NEAR(world.Position(prey).x() - 1, 1.5 * 1.5 / (2 * 0.25 * kGravity) - 1.5 * step / 2, 1e-3) << subclock;
  }
}

// The round back of a robot against a prey: see the test of the same name in dynamics3d.
TEST(Dynamics2d, APreyOffTheMiddleLeavesTheRobotThatPushesIt)
{
  for (const char* friction : {"0", "0.7"})
  {
    Dynamics2dTestWorld world("friction", friction);
    const double offset = 0.01;
    const double reach = 0.085036758 + 0.1;
    const auto robot = world.AddFootbot(2, 5, kPi);
    const auto prey = world.AddPrey(2.001 + std::sqrt(reach * reach - offset * offset), 5 + offset, 0.5, 0.1);
    world.Drive(robot, -0.05, -0.05);
    Vector3 arm = Vector3::UnitX();
    for (int tick = 0; tick < 1000 && std::abs(arm.y()) < arm.x(); ++tick)
    {
      world.Tick();
      arm = world.Position(prey) - world.Position(robot);
    }
    const double slower = friction[1] == 0 ? 1 : 1 + 4.0 / 9;  // a contact without friction lets the prey slip
    const double way = reach * slower * std::log(std::tan(kPi / 8) / std::tan(std::asin(offset / reach) / 2));
    EXPECT_NEAR(world.Position(robot).x() - 2, way, 0.02 * way) << friction;
  }
}

// The angle is w^2 / (2 a), with a = (2/3 mu m g R) / (m R^2 / 2).
TEST(Dynamics2d, ASpinningPreyStopsByTheFrictionOfADisc)
{
  Dynamics2dTestWorld world("ground_friction", "0.2", "substeps", "100");
  const auto prey = world.AddPrey(1, 1, 2, 0.15);
  world.Start();
  world.engine->SetVelocity(prey, {0, 0, 8});
  world.Run(30);
  const double deceleration = 4.0 / 3.0 * 0.2 * kGravity / 0.15;
  EXPECT_NEAR(world.Yaw(prey), 64 / (2 * deceleration), 8e-3);
}

// A block counts as the disc with its radius of gyration k = sqrt((a^2 + b^2) / 12): the deceleration is
// (2/3 mu g sqrt(2)) / k.
TEST(Dynamics2d, ASpinningBlockStopsByItsRadiusOfGyration)
{
  Dynamics2dTestWorld world("ground_friction", "0.2", "substeps", "100");
  const auto block = world.AddBlock({1, 1, 0.05}, {0.4, 0.1, 0.1}, 2);
  world.Start();
  world.engine->SetVelocity(block, {0, 0, 8});
  world.Run(30);
  const double gyration = std::sqrt((0.4 * 0.4 + 0.1 * 0.1) / 12);
  const double deceleration = 2.0 / 3.0 * 0.2 * kGravity * std::sqrt(2.0) / gyration;
  EXPECT_NEAR(world.Yaw(block), 64 / (2 * deceleration), 1e-2);
}

TEST(Dynamics2d, AFootbotDrivesTheArcOfItsWheels)
{
  Dynamics2dTestWorld world;
  const auto robot = world.AddFootbot(2, 2);
  world.Drive(robot, 0.08, 0.12);
  world.Run(1);  // at speed after the first tick
  const double yaw = world.Yaw(robot);
  const Vector3 start = world.Position(robot);
  world.Run(50);
  const double turn = 0.04 / 0.14 * 5;
  const double radius = 0.1 / (0.04 / 0.14);
  EXPECT_NEAR(WrapAngle(world.Yaw(robot) - yaw - turn), 0, 1e-4);
  EXPECT_NEAR(world.Position(robot).x() - start.x(), radius * (std::sin(yaw + turn) - std::sin(yaw)), 2e-4);
  EXPECT_NEAR(world.Position(robot).y() - start.y(), -radius * (std::cos(yaw + turn) - std::cos(yaw)), 2e-4);
  EXPECT_NEAR(world.Sensor("footbot_encoders", robot, 0), 0.008, 1e-5);
  EXPECT_NEAR(world.Sensor("footbot_encoders", robot, 1), 0.012, 1e-5);
}

TEST(Dynamics2d, WheelsSlipUntilTheSpeedIsReached)
{
  Dynamics2dTestWorld world("wheel_friction", "0.1", "substeps", "50");
  const auto robot = world.AddFootbot(1, 1);
  world.Drive(robot, 2, 2);
  world.Run(5);
  EXPECT_NEAR(world.Position(robot).x() - 1, 0.5 * 0.1 * kGravity * 0.25, 2e-3);
  EXPECT_NEAR(world.Sensor("footbot_accelerometer", robot, 0), 0.1 * kGravity, 1e-3);
  EXPECT_NEAR(world.Sensor("footbot_accelerometer", robot, 1), 0, 1e-3);
  world.Run(20);
  const double before = world.Position(robot).x();
  world.Run(10);
  EXPECT_NEAR(world.Position(robot).x() - before, 2, 1e-3) << "terminal speed";
}

TEST(Dynamics2d, TheAccelerometerReadsInTheFrameOfTheRobot)
{
  Dynamics2dTestWorld world("wheel_friction", "0.1", "substeps", "50");
  const auto ahead = world.AddFootbot(1, 1, kPi / 2);
  const auto turning = world.AddFootbot(5, 5, 2);
  world.Drive(ahead, 2, 2);
  world.Drive(turning, 0.2, 0.3);
  world.Run(10);
  EXPECT_NEAR(world.Sensor("footbot_accelerometer", ahead, 0), 0.1 * kGravity, 1e-3);
  EXPECT_NEAR(world.Sensor("footbot_accelerometer", ahead, 1), 0, 1e-3);
  // To the left: v w, on a circle to the left.
  EXPECT_NEAR(world.Sensor("footbot_accelerometer", turning, 1), 0.25 * 0.1 / 0.14, 5e-3);
  EXPECT_NEAR(world.Sensor("footbot_accelerometer", turning, 0), 0, 1e-2);
  EXPECT_NEAR(world.Sensor("footbot_accelerometer", turning, 2), kGravity, 1e-12);
}

TEST(Dynamics2d, MotorsLimitTheAccelerationWhereTheyAreWeakerThanTheGround)
{
  Dynamics2dTestWorld world("drive_force", "0.8");
  const auto robot = world.AddFootbot(1, 1);
  world.Drive(robot, 2, 2);
  world.Run(3);
  EXPECT_NEAR(world.Sensor("footbot_accelerometer", robot, 0), 0.8 / 1.6, 1e-4);
}

TEST(Dynamics2d, APreyHeavierThanTheWheelsGripStandsStill)
{
  Dynamics2dTestWorld world;
  const auto robot = world.AddFootbot(1, 1);
  const auto prey = world.AddPrey(1.25, 1, 4);
  world.Drive(robot, 0.1, 0.1);
  world.Run(20);
  const double before = world.Position(prey).x();
  world.Run(100);
  EXPECT_NEAR(world.Position(prey).x() - before, 0, 1e-4) << "mu M g = 19.6 N against 12.6 N";
}

TEST(Dynamics2d, APreyLighterThanTheWheelsGripIsPushedAtTheirSpeed)
{
  Dynamics2dTestWorld world;
  const auto robot = world.AddFootbot(1, 1);
  const auto prey = world.AddPrey(1.25, 1, 1.5);
  world.Drive(robot, 0.1, 0.1);
  world.Run(20);
  const double before = world.Position(prey).x();
  world.Run(20);
  EXPECT_NEAR(world.Position(prey).x() - before, 0.2, 2e-3);
}

TEST(Dynamics2d, EyebotsFlyWhereTheirPropellersPush)
{
  Dynamics2dTestWorld world("distance", "1");
  const auto eyebot = world.AddEyebot({3, 3, 1}, kPi / 2);
  world.Command("eyebot_propellers", eyebot, {0.2, 0.1, 0, 0});
  world.Run(3);
  const Vector3 before = world.Position(eyebot);
  world.Run(10);
  EXPECT_NEAR(world.Position(eyebot).y() - before.y(), 0.2, 1e-4);
  EXPECT_NEAR(world.Position(eyebot).x() - before.x(), -0.1, 1e-4);
  EXPECT_NEAR(world.Position(eyebot).z(), 1, 1e-12);
}

TEST(Dynamics2d, AFootbotDrivesAsFastFarFromTheOriginAsNearIt)
{
  for (const double place : {0.0, 500.0, 9000.0})
  {
    Dynamics2dTestWorld world;
    const auto straight = world.AddFootbot(place, place);
    const auto slant = world.AddFootbot(place, place + 1, kPi / 6);
    // The bodies are 1 cm apart, since bodies without neighbours are not in the solver.
    const auto beside = world.AddFootbot(place, place - 0.18);
    const auto beside_slant = world.AddFootbot(place + 0.09, place + 1 - 0.156, kPi / 6);
    world.Start();
    for (const auto robot : {straight, slant, beside, beside_slant}) world.Drive(robot, 0.05, 0.05);
    world.Run(10);
    const Vector3 start = world.Position(straight);
    const Vector3 slant_start = world.Position(slant);
    world.Run(200);
    const Vector3 way = world.Position(straight) - start;
    EXPECT_NEAR(way.x(), 1, 1e-3) << place;
    EXPECT_NEAR(way.y(), 0, 1e-3) << place;
    EXPECT_NEAR((world.Position(slant) - slant_start).norm(), 1, 1e-3) << place;
  }
}

// Whatever the phase of the sub-steps at which two robots meet: a contact lets them approach by their gap and no
// farther.
TEST(Dynamics2d, RobotsThatMeetDoNotOverlap)
{
  for (int phase = 0; phase < 12; ++phase)
  {
    Dynamics2dTestWorld world;
    world.experiment.clock_tick_ms = 25;
    world.Set("substeps", "1");  // each is seen
    const auto left = world.AddFootbot(4, 5);
    const auto right = world.AddFootbot(4.4 + 0.00125 * phase, 5, kPi);
    world.Start();
    for (const auto robot : {left, right}) world.Drive(robot, 0.3, 0.3);
    // The squares of the grippers, which reach 10 cm from the axes, meet first.
    const auto gap = [&] { return (world.Position(left) - world.Position(right)).norm() - 0.2; };
    for (int step = 0; step < 120; ++step)
    {
      world.Tick();
      EXPECT_GT(gap(), -1e-5) << "phase " << phase << ", step " << step;
    }
    EXPECT_LT(gap(), 0.001) << "pressed together";
  }
}

// A load that the wheels cannot move does not creep, whatever it weighs: its friction is solved together with the push.
TEST(Dynamics2d, ALoadJustTooHeavyForTheWheelsDoesNotCreep)
{
  for (const double part : {0.99, 1.01, 3.0})
  {
    Dynamics2dTestWorld world;
    const double limit = 0.8 * 1.6 / 0.5;  // kg, of the load whose friction is that of the wheels
    const auto robot = world.AddFootbot(1, 1);
    const auto prey = world.AddPrey(1.205, 1, part * limit);
    world.Drive(robot, 0.1, 0.1);
    world.Run(30);
    const double before = world.Position(prey).x();
    world.Run(50);
    EXPECT_NEAR(world.Position(prey).x() - before, part < 1 ? 0.5 : 0, 1e-6) << part;
  }
}

}  // namespace
}  // namespace swarmanoid

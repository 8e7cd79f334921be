// Wheels that spin or slide on slippery ground.
#include <ode/ode.h>

#include <string>
#include <utility>

#include "dynamics3d_test_world.h"

namespace swarmanoid
{
namespace
{

constexpr double kFreeFall = 9.81;

// The wheels carry 77 % of the weight at rest. They rub with 1 + 0.5 s/m of slip times their friction.
TEST(Dynamics3dWheelSlip, AStartOnSlipperyGroundSpinsTheWheelsAndEncodersShowIt)
{
  for (const double friction : {0.1, 0.3})
  {
    Dynamics3dTestWorld world("wheel_friction", std::to_string(friction));
    world.experiment.clock_tick_ms = 10;
    const auto footbot = world.AddFootbot({2, 5, 0});
    world.Run(50);
    world.Drive(footbot, 0.3, 0.3);
    double rolled = 0;
    for (int tick = 0; tick < 10; ++tick)
    {
      world.Tick();
      rolled += world.Sensor("footbot_encoders", footbot, 0);
    }
    const double way = world.Position(footbot).x() - 2;
    EXPECT_NEAR(way, 0.77 * friction * 1.1 * kFreeFall * 0.01 / 2, 0.25 * way) << friction;
    EXPECT_GT(rolled, 1.4 * way) << friction;
    world.Run(300);
    EXPECT_NEAR(dBodyGetLinearVel(world.engine->WorldForTest().Body(0))[0], 0.3, 3e-3) << "they grip in the end";
  }
}

TEST(Dynamics3dWheelSlip, WheelsDoNotSpinOnGoodGround)
{
  Dynamics3dTestWorld world;
  world.experiment.clock_tick_ms = 10;
  const auto footbot = world.AddFootbot({2, 5, 0});
  world.Run(50);
  world.Drive(footbot, 0.3, 0.3);
  double rolled = 0;
  for (int tick = 0; tick < 30; ++tick)
  {
    world.Tick();
    rolled += world.Sensor("footbot_encoders", footbot, 0);
  }
  EXPECT_NEAR(rolled, world.Position(footbot).x() - 2, 1e-3);
}

// A robot before a wall: its wheels stand still if they grip, and turn as commanded if they do not.
TEST(Dynamics3dWheelSlip, ARobotThatIsHeldBackSpinsItsWheelsOnSlipperyGroundOnly)
{
  for (const bool slippery : {true, false})
  {
    Dynamics3dTestWorld world("wheel_friction", slippery ? "0.3" : "1");
    const auto footbot = world.AddFootbot({2, 5, 0});
    world.AddWall({2.2, 5, 0.1}, {0.1, 1, 0.2});
    world.Drive(footbot, 0.1, 0.1);
    world.Run(50);
    for (int wheel = 0; wheel < 2; ++wheel)
      EXPECT_NEAR(world.Sensor("footbot_encoders", footbot, wheel), slippery ? 0.01 : 0, 5e-4) << slippery;
  }
}

// Returns how fast (m/s) a pair of equal robots moves together while they push each other.
double DriftOfAPair(const char* friction, double speed, bool is_swapped)
{
  Dynamics3dTestWorld world("wheel_friction", friction);
  const auto first = world.AddFootbot({is_swapped ? 5.15 : 4.85, 5, 0}, is_swapped ? kPi : 0);
  const auto second = world.AddFootbot({is_swapped ? 4.85 : 5.15, 5, 0}, is_swapped ? 0 : kPi);
  for (const auto footbot : {first, second}) world.Drive(footbot, speed, speed);
  const auto middle = [&] { return (world.Position(first).x() + world.Position(second).x()) / 2; };
  world.Run(50);
  const double start = middle();
  world.Run(100);
  return (middle() - start) / 10;
}

TEST(Dynamics3dWheelSlip, EqualRobotsHeadOnDrawWhetherTheirWheelsSpinOrNot)
{
  for (const auto& [friction, speed] : {std::pair("0.8", 0.1), std::pair("0.6", 0.3), std::pair("0.2", 0.1)})
    for (const bool is_swapped : {false, true})
      EXPECT_NEAR(DriftOfAPair(friction, speed, is_swapped), 0, 5e-4) << friction << " at " << speed;
}

// Friction points against the slip, so a wheel that spins hardly holds across. Across a slope of 6 degrees, gravity
// pulls with 1.03 m/s2, and the wheels hold up to 0.77 * 0.2 g at rest.
TEST(Dynamics3dWheelSlip, ASpinningRobotSlidesDownASlopeThatHoldsItAtRest)
{
  for (const bool spins : {true, false})
  {
    Dynamics3dTestWorld world("orientation", "6, 0, 0", "wheel_friction", "0.2");
    const Quaternion tilt = QuaternionFromEuler({DegreesToRadians(6), 0, 0});
    const auto footbot =
        world.Add(EntityKind::kFootbot, Vector3::Zero(), tilt, DescriptionOf(EntityKind::kFootbot).size);
    world.Run(5);
    if (spins) world.Drive(footbot, 0.6, 0.6);
    const Vector3 start = tilt.conjugate() * world.Position(footbot);
    world.Run(3);
    const double down = start.y() - (tilt.conjugate() * world.Position(footbot)).y();
    if (spins)
      EXPECT_GT(down, 0.01);
    else
      EXPECT_LT(std::abs(down), 1e-3);
  }
}

}  // namespace
}  // namespace swarmanoid

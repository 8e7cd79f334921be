// If equal robots work against each other, none wins, in any order of the file.
#include "dynamics3d_test_world.h"

namespace swarmanoid
{
namespace
{

constexpr double kSpeed = 0.1;   // m/s, of each robot
constexpr double kDrift = 5e-4;  // m/s, for robots that should stand still

// A robot on the left looks right and one on the right looks left; they are listed in either order.
struct Pair
{
  Pair(Dynamics3dTestWorld& world, double apart, double offset, bool left_first)
  {
    const auto add = [&](bool is_left)
    {
      const double side = is_left ? -0.5 : 0.5;
      (is_left ? left : right) = world.AddFootbot({5 + side * apart, 5 + side * offset, 0}, is_left ? 0 : kPi);
    };
    add(left_first);
    add(!left_first);
  }
  double Middle(Dynamics3dTestWorld& world) const { return (world.Position(left).x() + world.Position(right).x()) / 2; }
  std::uint32_t left = 0;
  std::uint32_t right = 0;
};

TEST(Dynamics3dBalance, NeitherOfTwoEqualRobotsPushesTheOtherBack)
{
  for (const double offset : {0.0, 0.004})
  {
    for (const bool left_first : {true, false})
    {
      Dynamics3dTestWorld world;
      const Pair pair(world, 0.4, offset, left_first);
      world.Drive(pair.left, kSpeed, kSpeed);
      world.Drive(pair.right, kSpeed, kSpeed);
      world.Run(10);
      EXPECT_NEAR(world.Sensor("footbot_encoders", pair.left, 0), 0.01, 1e-4) << "they drive until they meet";
      world.Run(40);
      const double before = pair.Middle(world);
      world.Run(100);
      EXPECT_NEAR(pair.Middle(world), before, kDrift * 10) << "offset " << offset << ", left first: " << left_first;
      EXPECT_NEAR((world.Position(pair.left) - world.Position(pair.right)).norm(), 2 * 0.085036758, 0.002);
    }
  }
}

// A robot of one kilogram more pushes the other back: the test above would notice a push.
TEST(Dynamics3dBalance, AHeavierRobotPushesALighterOneBack)
{
  Dynamics3dTestWorld world;
  const Pair pair(world, 0.4, 0, true);
  world.experiment.entities[pair.right].mass_kg = 2.6;
  world.Drive(pair.left, kSpeed, kSpeed);
  world.Drive(pair.right, kSpeed, kSpeed);
  world.Run(50);
  const double before = pair.Middle(world);
  world.Run(100);
  EXPECT_LT(pair.Middle(world), before - 0.2);
}

TEST(Dynamics3dBalance, ATugOfWarBetweenTwoEqualRobotsIsADraw)
{
  for (const bool left_first : {true, false})
  {
    Dynamics3dTestWorld world;
    const Pair pair(world, 2 * (0.085036758 + 0.1 + 0.002), 0, left_first);
    const auto prey = world.AddPrey({5, 5, 0}, 0.5);
    world.Start();
    for (const auto robot : {pair.left, pair.right}) world.Command("footbot_gripper", robot, {1});
    world.Tick();
    for (const auto robot : {pair.left, pair.right}) world.Drive(robot, -kSpeed, -kSpeed);
    world.Run(50);
    EXPECT_GT(world.Sensor("footbot_turret_torque", pair.left, 0) * 25, 5) << "they pull";
    const double before = world.Position(prey).x();
    world.Run(100);
    EXPECT_NEAR(world.Position(prey).x(), before, kDrift * 10) << "left first: " << left_first;
  }
}

TEST(Dynamics3dBalance, AStandingHandbotDoesNotCreep)
{
  Dynamics3dTestWorld world;
  const auto handbot = world.AddHandbot({5, 5, 0}, 0.3);
  world.Run(50);
  const Vector3 start = world.Position(handbot);
  const double heading = world.Yaw(handbot);
  world.Run(300);
  EXPECT_LT((world.Position(handbot) - start).norm(), 5e-5);
  EXPECT_NEAR(world.Yaw(handbot), heading, 1e-4);
}

}  // namespace
}  // namespace swarmanoid

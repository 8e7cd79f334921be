// Robots that meet only upright walls and one another are solved in the plane, all others by ODE.
#include <cmath>

#include "dynamics3d_test_world.h"
#include "engine_worker/engines/dynamics3d/wheeled.h"

namespace swarmanoid
{
namespace
{

bool IsPlanar(const Dynamics3dTestWorld& world, std::uint32_t entity)
{
  const auto* robot = dynamic_cast<const dynamics3d::WheeledModel*>(world.engine->ModelForTest(entity));
  return robot != nullptr && robot->IsPlanar();
}

TEST(PlanarSolver, MovesRobotsAtUprightThingsOnly)
{
  Dynamics3dTestWorld world;
  const auto at_wall = world.AddFootbot({1, 1, 0});
  world.AddWall({1.2, 1, 0.25}, {0.1, 1, 0.5});
  const auto left = world.AddFootbot({3, 1, 0}), right = world.AddFootbot({3.2, 1, 0}, kPi);
  const auto at_prey = world.AddFootbot({1, 3, 0});
  world.AddPrey({1.2, 3, 0}, 5);
  const auto at_plate = world.AddFootbot({1, 5, 0});
  world.AddWall({1.3, 5, 0.005}, {0.4, 1, 0.01});
  const auto at_bar = world.AddFootbot({1, 7, 0});
  world.AddWall({1.2, 7, 0.2}, {0.1, 1, 0.2});
  for (const auto robot : {at_wall, left, right, at_prey, at_plate, at_bar}) world.Drive(robot, 0.1, 0.1);
  world.Run(20);
  for (const auto robot : {at_wall, left, right}) EXPECT_TRUE(IsPlanar(world, robot)) << "e" << robot;
  for (const auto robot : {at_prey, at_plate, at_bar}) EXPECT_FALSE(IsPlanar(world, robot)) << "e" << robot;
  EXPECT_GT(world.Position(at_plate).z(), 0.001) << "it drives onto the plate";
}

// Without friction at the wall nothing turns the robot, and the slip of its wheels points at the wall.
TEST(PlanarSolver, RobotsSlideAlongASmoothWallWithTheirSpeedAlongIt)
{
  for (const double degrees : {5.0, 15.0, 30.0, 45.0})
  {
    Dynamics3dTestWorld world("friction", "0");
    const auto robot = world.AddFootbot({1, 1, 0}, DegreesToRadians(90 - degrees));
    world.AddWall({1 + 0.085036758 + 0.05, 2, 0.25}, {0.1, 6, 0.5});
    world.Drive(robot, 0.1, 0.1);
    world.Run(20);
    const double start = world.Position(robot).y();
    world.Run(50);
    EXPECT_TRUE(IsPlanar(world, robot));
    EXPECT_NEAR(world.Position(robot).x(), 1, 2e-3);
    const double expected = 0.5 * std::cos(DegreesToRadians(degrees));
    EXPECT_NEAR(world.Position(robot).y() - start, expected, 0.01 * expected) << degrees;
  }
}

// A stalled robot pushes with the force of its motors, 11.5 N, against one that is braked by as much.
TEST(PlanarSolver, ALockedRobotHoldsOneThatPushesIt)
{
  Dynamics3dTestWorld world;
  const auto pushes = world.AddFootbot({1, 1, 0}), holds = world.AddFootbot({1.175, 1, 0}, kPi / 2);
  world.Drive(pushes, 0.1, 0.1);
  world.Drive(holds, 0, 0);
  world.Run(50);
  EXPECT_TRUE(IsPlanar(world, pushes));
  EXPECT_LT(world.Position(holds).x(), 1.175 + 0.015) << "its wheels hold sideways with 12 N";
  EXPECT_GT(world.Position(holds).x() - world.Position(pushes).x(), 2 * 0.085 - 1e-3);
}

}  // namespace
}  // namespace swarmanoid

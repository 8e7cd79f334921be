#include <cmath>
#include <string>
#include <utility>

#include "dynamics2d_test_world.h"

namespace swarmanoid
{
namespace
{

constexpr double kReach = 0.1;  // from the turret's axis to the gripper's face

TEST(Dynamics2d, AGripperTakesWhatItTouchesAndLetsGo)
{
  Dynamics2dTestWorld world;
  const auto robot = world.AddFootbot(1, 1);
  const auto far_robot = world.AddFootbot(1, 3);
  const auto prey = world.AddPrey(1 + kReach + 0.1 + 0.002, 1, 0.5);
  world.Command("footbot_gripper", robot, {1});
  world.Command("footbot_gripper", far_robot, {1});
  world.Run(1);
  EXPECT_EQ(world.Attribute(robot, "gripped"), 1 + prey);
  EXPECT_EQ(world.Attribute(robot, "gripper_aperture"), 0);
  EXPECT_EQ(world.Attribute(far_robot, "gripped"), 0);
  world.Drive(robot, -0.1, -0.1);
  world.Run(20);
  EXPECT_NEAR(world.Position(prey).x() - world.Position(robot).x(), kReach + 0.102, 1e-3) << "it follows";
  EXPECT_NEAR(world.Position(robot).x(), 0.8, 5e-3);
  world.Command("footbot_gripper", robot, {0});
  world.Run(1);
  EXPECT_EQ(world.Attribute(robot, "gripped"), 0);
  EXPECT_NEAR(world.Attribute(robot, "gripper_aperture"), kPi / 2, 1e-12);
  const double before = world.Position(prey).x();
  world.Run(20);
  EXPECT_NEAR(world.Position(prey).x(), before, 1e-3) << "it stays behind";
}

TEST(Dynamics2d, MovableBlocksAreGrippedAndEyebotsAreNot)
{
  Dynamics2dTestWorld world;
  const auto a = world.AddFootbot(1, 1);
  const auto b = world.AddFootbot(1, 3);
  const auto block = world.AddBlock({1 + kReach + 0.1, 1, 0.1}, {0.2, 0.2, 0.2}, 1);
  world.AddEyebot({1 + kReach + 0.25, 3, 0});
  world.Command("footbot_gripper", a, {1});
  world.Command("footbot_gripper", b, {1});
  world.Run(3);
  EXPECT_EQ(world.Attribute(a, "gripped"), block + 1);
  EXPECT_EQ(world.Attribute(b, "gripped"), 0);
}

TEST(Dynamics2d, AHandbotCanBeGrippedByTwo)
{
  Dynamics2dTestWorld world;
  const auto a = world.AddFootbot(1, 1);
  const auto handbot =
      world.Add(EntityKind::kHandbot, {1 + kReach + 0.1, 1, 0}, Quaternion::Identity(), {0.2, 0.3, 0.4});
  const auto b = world.AddFootbot(1 + 2 * kReach + 0.2, 1, kPi);
  world.Command("footbot_gripper", a, {1});
  world.Command("footbot_gripper", b, {1});
  world.Run(1);
  EXPECT_EQ(world.Attribute(a, "gripped"), 1 + handbot);
  EXPECT_EQ(world.Attribute(b, "gripped"), 1 + handbot);
}

TEST(Dynamics2d, ARingOfFootbotsCannotClose)
{
  Dynamics2dTestWorld world;
  const auto a = world.AddFootbot(1, 1, 0);
  const auto b = world.AddFootbot(1 + kReach + 0.085, 1, kPi);
  world.Command("footbot_gripper", a, {1});
  world.Command("footbot_gripper", b, {1});
  world.Run(5);
  EXPECT_EQ(world.Attribute(a, "gripped"), 1 + b);
  EXPECT_EQ(world.Attribute(b, "gripped"), 0);
}

// The gripper of ARGoS3's foot-bots is a sensor (dynamics2d_footbot_model.cpp): its body alone meets walls.
TEST(Dynamics2d, AGripperOfTheModelRodStopsNothing)
{
  for (const auto& [model, gap] : {std::pair("square", kReach), std::pair("rod", 0.085)})
  {
    Dynamics2dTestWorld world("gripper", model);
    const auto robot = world.AddFootbot(1, 1);
    world.AddWall({1.6, 1, 0.1}, {0.2, 2, 0.2});
    world.Drive(robot, 0.1, 0.1);
    world.Run(100);
    EXPECT_NEAR(1.5 - world.Position(robot).x(), gap, 2e-3) << model;
  }
}

TEST(Dynamics2d, ARodTakesWithinACentimetreOfTheFront)
{
  for (const auto& [gap, takes] : {std::pair(0.009, true), std::pair(0.011, false)})
  {
    Dynamics2dTestWorld world("gripper", "rod");
    const auto robot = world.AddFootbot(1, 1);
    const auto prey = world.AddPrey(1 + 0.085 + gap + 0.1, 1, 0.5);
    world.Command("footbot_gripper", robot, {1});
    world.Run(1);
    EXPECT_EQ(world.Attribute(robot, "gripped"), takes ? 1 + prey : 0) << gap;
  }
}

// Both ends of a rod turn freely: a robot that turns on the spot leaves its load where it is, and one that drives back
// pulls it.
TEST(Dynamics2d, ARodPullsAndDoesNotTurnItsLoad)
{
  for (const std::string model : {"square", "rod"})
  {
    Dynamics2dTestWorld world("gripper", model);
    const auto robot = world.AddFootbot(2, 2);
    const auto prey = world.AddPrey(2 + 0.085 + 0.1, 2, 0.5);
    world.Command("footbot_gripper", robot, {1});
    world.Run(1);
    ASSERT_EQ(world.Attribute(robot, "gripped"), 1 + prey);
    const Vector3 before = world.Position(prey);
    world.Drive(robot, -0.05, 0.05);
    world.Run(20);
    const double moved = (world.Position(prey) - before).norm();
    if (model == "rod")
      EXPECT_LT(moved, 2e-3);
    else
      EXPECT_GT(moved, 0.1);
    world.Drive(robot, 0, 0);
    world.Run(10);
    const double length = (world.Position(prey) - world.Position(robot)).norm();
    world.Drive(robot, -0.1, -0.1);
    world.Run(20);
    EXPECT_GT((world.Position(prey) - before).norm(), 0.1) << model;
    EXPECT_NEAR((world.Position(prey) - world.Position(robot)).norm(), length, 0.012) << model;
  }
}

// A load that is dragged at a steady speed pulls with mu M g.
TEST(Dynamics2d, TheTorqueSensorReadsTheTractionOfADraggedLoad)
{
  Dynamics2dTestWorld world;
  const auto robot = world.AddFootbot(2, 1);
  world.AddPrey(2 + kReach + 0.1, 1, 1);
  world.UseTurrets();
  world.Command("footbot_gripper", robot, {1});
  world.Drive(robot, -0.1, -0.1);
  world.Run(30);
  EXPECT_NEAR(world.Sensor("footbot_turret_torque", robot, 0) * 25, 0.5 * 1 * 9.81, 0.02);
  EXPECT_NEAR(world.Sensor("footbot_turret_torque", robot, 1) * 25, 0, 0.02);
}

// The turret turns the load about its axis. It takes I dw/dt at first, which is all of the motor's torque here, and the
// load reacts with the opposite sign.
TEST(Dynamics2d, ATurretTurnsItsLoadWithinItsTorque)
{
  Dynamics2dTestWorld world("ground_friction", "0", "turret_torque", "0.3");
  world.Set("footbot_mass", "1000");  // it does not give way
  const auto robot = world.AddFootbot(2, 2);
  const auto prey = world.AddPrey(2 + kReach + 0.1, 2, 5);
  world.UseTurrets();
  world.Command("footbot_gripper", robot, {1});
  world.Command("footbot_turret", robot, {2});
  world.Run(5);
  const double inertia = 5 * (0.2 * 0.2 + 0.1 * 0.1 / 2);
  const double expected = 0.5 * (0.3 / inertia) * 0.25;
  EXPECT_NEAR(world.Attribute(robot, "turret_angle"), expected, 0.06 * expected)
      << "half a step too far, as in any Euler step";
  EXPECT_NEAR(world.Sensor("footbot_turret_torque", robot, 2), -1, 1e-3);
  world.Run(100);
  const Vector3 arm = world.Position(prey) - world.Position(robot);
  EXPECT_NEAR(WrapAngle(Atan2(arm.y(), arm.x()) - world.Yaw(robot) - world.Attribute(robot, "turret_angle")), 0, 5e-3);
  EXPECT_NEAR(arm.norm(), kReach + 0.1, 1e-3);
  EXPECT_NEAR(world.Sensor("footbot_turret_torque", robot, 2), 0, 0.1)
      << "nothing resists a steady turn but the solver's steps along the arc";
}

// A load that turns at a steady speed rubs at each point against the direction of motion, with even pressure. Force and
// torque are integrals over the disc. The motor of the turret gives all of it, and the load reacts. The engine's
// ellipsoid is within 3 % of the integrals.
TEST(Dynamics2d, TheTorqueSensorReadsTheFrictionOfATurnedLoad)
{
  Dynamics2dTestWorld world;
  const auto robot = world.AddFootbot(2, 2);
  const double mass = 0.5;
  const double radius = 0.1;
  world.AddPrey(2 + kReach + radius, 2, mass, radius);
  world.UseTurrets();
  world.Command("footbot_gripper", robot, {1});
  world.Command("footbot_turret", robot, {0.5});
  world.Run(30);
  const double friction = 0.5 * mass * 9.81;
  double arm = 0;     // mean distance from the axis, m
  double across = 0;  // mean part of the unit slip that is across the arm
  constexpr int kRings = 100;
  for (int ring = 0; ring < kRings; ++ring)
    for (int k = 0; k < 100; ++k)
    {
      const double r = radius * std::sqrt((ring + 0.5) / kRings);
      const double x = kReach + radius + r * Cos(2 * kPi * k / 100);
      const double distance = std::hypot(x, r * Sin(2 * kPi * k / 100));
      arm += distance / (100 * kRings);
      across += x / distance / (100 * kRings);
    }
  EXPECT_NEAR(world.Sensor("footbot_turret_torque", robot, 2) * 1.5, -friction * arm, 0.03 * friction * arm);
  EXPECT_NEAR(world.Sensor("footbot_turret_torque", robot, 1) * 25, -friction * across, 0.03 * friction * across)
      << "against the turn";
}

// Two footbots hold a bar-like handbot, one drives sideways: the other's turret feels force times lever.
TEST(Dynamics2d, TheTorqueSensorReadsALeverOnTheTurret)
{
  Dynamics2dTestWorld world("ground_friction", "0", "wheel_friction", "50", "drive_force", "2");
  const auto holder = world.AddFootbot(1, 1, 0);
  const auto handbot = world.Add(EntityKind::kHandbot, {1 + kReach + 0.5, 1, 0}, Quaternion::Identity(), {1, 0.2, 0.4});
  const auto puller = world.AddFootbot(1 + kReach + 0.9, 1 + 0.1 + kReach, -kPi / 2);
  world.UseTurrets();
  world.Command("footbot_gripper", holder, {1});
  world.Command("footbot_gripper", puller, {1});
  world.Run(20);
  ASSERT_EQ(world.Attribute(holder, "gripped"), 1 + handbot);
  ASSERT_EQ(world.Attribute(puller, "gripped"), 1 + handbot);
  world.Drive(puller, -0.05, -0.05);
  world.Run(3);
  EXPECT_GT(world.Sensor("footbot_turret_torque", holder, 2), 0.05) << "counter-clockwise, as the lever is pulled";
}

TEST(Dynamics2d, AnUnloadedTurretTurnsAtItsSpeedAndCarriesTheGripper)
{
  Dynamics2dTestWorld world;
  const auto robot = world.AddFootbot(1, 1);
  const auto prey = world.AddPrey(1, 1 + kReach + 0.105, 0.5);
  world.UseTurrets();
  world.Command("footbot_turret", robot, {kPi / 4});
  world.Run(20);
  EXPECT_NEAR(world.Attribute(robot, "turret_angle"), kPi / 2, 1e-9);
  world.Command("footbot_turret", robot, {0});
  world.Command("footbot_gripper", robot, {1});
  world.Run(2);
  EXPECT_EQ(world.Attribute(robot, "gripped"), 1 + prey);
  EXPECT_NEAR(world.Attribute(robot, "turret_angle"), kPi / 2, 1e-3);
}

// Ten footbots in a row, each gripping the next, the last one a prey, all driving backwards.
void ChainOfTenPullsAPrey(bool turrets)
{
  Dynamics2dTestWorld world;
  std::vector<std::uint32_t> robots;
  const double spacing = kReach + 0.085036758;
  for (int i = 0; i < 10; ++i) robots.push_back(world.AddFootbot(5 + spacing * i, 2));
  const auto prey = world.AddPrey(5 + spacing * 9 + kReach + 0.15, 2, 12, 0.15);
  if (turrets) world.UseTurrets();
  for (const auto robot : robots) world.Command("footbot_gripper", robot, {1});
  world.Run(1);
  for (int i = 0; i < 9; ++i)
    ASSERT_EQ(world.Attribute(robots[static_cast<std::size_t>(i)], "gripped"),
              1 + robots[static_cast<std::size_t>(i) + 1]);
  ASSERT_EQ(world.Attribute(robots.back(), "gripped"), 1 + prey);

  // The limit is mu M g = 58.9 N: two robots (25.1 N) cannot move it, and ten can.
  world.Drive(robots[0], -0.1, -0.1);
  world.Drive(robots[1], -0.1, -0.1);
  world.Run(20);
  const double before = world.Position(prey).x();
  world.Run(50);
  EXPECT_NEAR(world.Position(prey).x(), before, 2e-3);

  for (const auto robot : robots) world.Drive(robot, -0.1, -0.1);
  world.Run(100);
  EXPECT_NEAR(world.Position(prey).x() - before, -1, 0.02);
  EXPECT_NEAR(world.Sensor("footbot_turret_torque", robots.back(), 0), 1, 1e-9) << "58.9 N are beyond its 25 N";
  for (std::size_t i = 0; i + 1 < robots.size(); ++i)
  {
    EXPECT_NEAR((world.Position(robots[i + 1]) - world.Position(robots[i])).norm(), spacing, 1e-3) << "rigid";
    EXPECT_NEAR(world.Position(robots[i]).y(), 2, 5e-3);
  }
}

TEST(Dynamics2d, AChainOfTenPullsAPreyWithRigidGrips) { ChainOfTenPullsAPrey(false); }
TEST(Dynamics2d, AChainOfTenPullsAPreyWithTurrets) { ChainOfTenPullsAPrey(true); }

TEST(Dynamics2d, MovingAMemberFromOutsideOpensItsGrips)
{
  Dynamics2dTestWorld world;
  const auto a = world.AddFootbot(1, 1);
  const auto b = world.AddFootbot(1 + kReach + 0.085, 1);
  const auto prey = world.AddPrey(1 + 2 * kReach + 0.085 + 0.1, 1, 1);
  world.UseTurrets();
  world.Command("footbot_gripper", a, {1});
  world.Command("footbot_gripper", b, {1});
  world.Run(2);
  ASSERT_EQ(world.Attribute(b, "gripped"), 1 + prey);
  world.Space().SetPose(b, {Vector3(4, 4, 0), Quaternion::Identity()});
  for (const auto robot : {a, b}) world.Space().GetEntity(robot).SetAttribute("gripped", 0);
  world.engine->EntityMoved(b);
  world.Run(2);
  EXPECT_EQ(world.Attribute(a, "gripped"), 0);
  EXPECT_EQ(world.Attribute(b, "gripped"), 0);
  EXPECT_LT((world.Position(b) - Vector3(4, 4, 0)).norm(), 1e-4);
}

// Turned by nearly half a turn, some headings pass from pi to -pi and others do not; the grips feel nothing of it.
void AChainThatIsMovedKeepsItsShape(bool turrets, double yaw)
{
  Dynamics2dTestWorld world;
  std::vector<std::uint32_t> robots;
  for (int i = 0; i < 4; ++i) robots.push_back(world.AddFootbot(1 + i * (kReach + 0.085), 1, i == 0 ? 0 : 1e-3));
  if (turrets) world.UseTurrets();
  for (const auto robot : robots) world.Command("footbot_gripper", robot, {1});
  world.Run(3);
  for (std::size_t i = 0; i + 1 < robots.size(); ++i)
    ASSERT_EQ(world.Attribute(robots[i], "gripped"), 1 + robots[i + 1]);
  const auto between = [&](std::size_t i)
  { return world.Space().GetPose(robots[i]).Inverse().Compose(world.Space().GetPose(robots[i + 1])); };
  std::vector<Pose> before;
  for (std::size_t i = 0; i + 1 < robots.size(); ++i) before.push_back(between(i));

  const std::vector<Pose> poses =
      world.Space().Structure().GetCompound(robots[1]).PosesAt(robots[1], {Vector3(5, 5, 0), QuaternionFromYaw(yaw)});
  for (std::size_t i = 0; i < robots.size(); ++i) world.Space().SetPose(robots[i], poses[i]);
  for (const auto robot : robots) world.engine->EntityMoved(robot);
  world.Run(10);
  EXPECT_LT((world.Position(robots[1]) - Vector3(5, 5, 0)).norm(), 1e-4) << "yaw " << yaw;
  for (std::size_t i = 0; i + 1 < robots.size(); ++i)
  {
    EXPECT_EQ(world.Attribute(robots[i], "gripped"), 1 + robots[i + 1]);
    EXPECT_LT((between(i).position - before[i].position).norm(), 1e-4) << "yaw " << yaw;
    EXPECT_LT(between(i).orientation.angularDistance(before[i].orientation), 1e-4) << "yaw " << yaw;
  }
}

TEST(Dynamics2d, AChainThatIsMovedKeepsItsShapeWithRigidGrips)
{
  for (const double yaw : {1.0, kPi - 5e-4, -kPi + 5e-4}) AChainThatIsMovedKeepsItsShape(false, yaw);
}
TEST(Dynamics2d, AChainThatIsMovedKeepsItsShapeWithTurrets)
{
  for (const double yaw : {1.0, kPi - 5e-4, -kPi + 5e-4}) AChainThatIsMovedKeepsItsShape(true, yaw);
}

// The prey is not turned, so its heading stays below pi when that of the robot passes it.
void AGripFeelsNothingOfAHeadingThatPassesPi(bool turrets)
{
  Dynamics2dTestWorld world;
  const double yaw = kPi - 0.1;
  const auto robot = world.AddFootbot(2, 2, yaw);
  const auto prey = world.AddPrey(2 + (kReach + 0.1) * std::cos(yaw), 2 + (kReach + 0.1) * std::sin(yaw), 0.2);
  if (turrets) world.UseTurrets();
  world.Command("footbot_gripper", robot, {1});
  world.Run(2);
  ASSERT_EQ(world.Attribute(robot, "gripped"), 1 + prey);
  const auto between = [&] { return world.Space().GetPose(robot).Inverse().Compose(world.Space().GetPose(prey)); };
  const Pose before = between();
  world.Drive(robot, -0.02, 0.02);
  for (int tick = 0; tick < 20; ++tick)
  {
    world.Tick();
    world.engine->Canonicalise();
    EXPECT_LT((between().position - before.position).norm(), 5e-3) << tick;
    EXPECT_LT(between().orientation.angularDistance(before.orientation), 0.05) << tick;
  }
  EXPECT_LT(world.Yaw(robot), 0) << "it has passed pi";
}

TEST(Dynamics2d, ARigidGripFeelsNothingOfAHeadingThatPassesPi) { AGripFeelsNothingOfAHeadingThatPassesPi(false); }
TEST(Dynamics2d, AGripOfATurretFeelsNothingOfAHeadingThatPassesPi) { AGripFeelsNothingOfAHeadingThatPassesPi(true); }

}  // namespace
}  // namespace swarmanoid

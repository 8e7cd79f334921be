// Tests gripping and checkpoints of the kinematic engine.
#include <gtest/gtest.h>

#include <cmath>

#include "common/math/random.h"
#include "tests/unit/kinematics2d/engine_fixture.h"

namespace swarmanoid
{
namespace
{

constexpr double kPreyRadius = 0.1;
// It is the distance from the centre of a prey to that of a robot whose closed gripper touches it.
constexpr double kReach = kinematics2d::kFootbotGripperReach + kPreyRadius + 0.005;

std::uint32_t AddPrey(EngineFixture& f, double x, double y)
{
  return f.Add(EntityKind::kCylindricPrey, Vector3(x, y, 0), {}, Vector3(kPreyRadius, kPreyRadius, 0.1));
}

std::uint32_t AddRobotAround(EngineFixture& f, double x, double y, double angle)
{
  return f.Add(EntityKind::kFootbot, Vector3(x + kReach * std::cos(angle), y + kReach * std::sin(angle), 0),
               {0, 0, angle + kPi});
}

double GrippedBy(EngineFixture& f, std::uint32_t robot) { return f.Space().GetEntity(robot).GetAttribute("gripped"); }

// Channel values of robot k: wheels first, then grippers.
void Drive(EngineFixture& f, std::size_t k, double left, double right)
{
  f.Command(2 * k) = WheelSpeed(left);
  f.Command(2 * k + 1) = WheelSpeed(right);
}

// Robots around a prey at (5, 5), with wheels, grippers and torques of their turrets.
struct Group
{
  EngineFixture f;
  std::uint32_t prey = AddPrey(f, 5, 5);
  std::vector<std::uint32_t> robots;

  explicit Group(const std::vector<double>& angles)
  {
    for (const double angle : angles) robots.push_back(AddRobotAround(f, 5, 5, angle));
    f.AddCommands("footbot_wheels", 2, robots);
    f.AddCommands("footbot_gripper", 1, robots);
    f.AddSensors("footbot_turret_torque", 3, robots);
  }
  void Grip()
  {
    for (std::size_t k = 0; k < robots.size(); ++k) f.Command(2 * robots.size() + k) = 1;
  }
};

TEST(Kinematics2dGrip, ARobotDrivesWithItsPreyAsIfItWereAlone)
{
  Group group({0});
  auto& [f, prey, robots] = group;
  const auto robot = robots[0];
  const Pose start = f.PoseOf(robot);
  const Pose held = start.Inverse().Compose(f.PoseOf(prey));
  f.Command(2) = 1;
  Drive(f, 0, -0.05, -0.1);
  f.Ticks(50);
  EXPECT_EQ(GrippedBy(f, robot), 1.0 + prey);
  const auto alone = kinematics2d::Advanced({start.position.x(), start.position.y(), kinematics2d::RotorOf(kPi)},
                                            {-0.075, 0, -0.05 / 0.14}, 5);
  EXPECT_NEAR(f.PoseOf(robot).position.x(), alone.x, 1e-9);
  EXPECT_NEAR(f.PoseOf(robot).position.y(), alone.y, 1e-9);
  const Pose now = f.PoseOf(robot).Inverse().Compose(f.PoseOf(prey));
  EXPECT_LT((now.position - held.position).norm(), 1e-12);
  EXPECT_NEAR(std::abs(now.orientation.dot(held.orientation)), 1, 1e-12);
  EXPECT_NEAR(f.Sensor(0), 0, 1e-9);

  // Released, the prey stays where it is.
  const Vector3 left_at = f.PoseOf(prey).position;
  f.Command(2) = 0;
  f.Ticks(10);
  EXPECT_EQ(GrippedBy(f, robot), 0);
  EXPECT_LT((f.PoseOf(prey).position - left_at).norm(), 1e-15);
  EXPECT_GT((f.PoseOf(robot).position - left_at).norm(), kReach + 0.01);
}

TEST(Kinematics2dGrip, OpposedRobotsHoldThePreyStillAndFeelTheTraction)
{
  Group group({0, kPi});
  auto& [f, prey, robots] = group;
  group.Grip();
  Drive(f, 0, -0.15, -0.15);
  Drive(f, 1, -0.15, -0.15);
  f.Ticks(20);
  EXPECT_LT((f.PoseOf(prey).position - Vector3(5, 5, 0)).norm(), 1e-12);
  // Each would go backwards at half of full speed and does not.
  constexpr double kFullTraction = 0.8 * 1.6 * 9.81 / 25;  // the force of the wheels, as a fraction of 25 N
  EXPECT_NEAR(f.Sensor(0), 0.5 * kFullTraction, 1e-9) << "the load pulls ahead";
  EXPECT_NEAR(f.Sensor(1), 0, 1e-9);
  EXPECT_NEAR(f.Sensor(3), 0.5 * kFullTraction, 1e-9);
  EXPECT_NEAR(f.Sensor(2), 0, 1e-9);
}

// One would turn to the left, the other to the right: the prey between them would have to do both.
TEST(Kinematics2dGrip, RobotsThatTurnAgainstEachOtherFeelTheTorque)
{
  Group group({0, kPi});
  auto& [f, prey, robots] = group;
  group.Grip();
  Drive(f, 0, -0.15, 0.15);
  Drive(f, 1, 0.15, -0.15);
  f.Ticks(20);
  EXPECT_LT((f.PoseOf(prey).position - Vector3(5, 5, 0)).norm(), 1e-12);
  constexpr double kFullTorque = 0.8 * 1.6 * 9.81 * 0.07 / 1.5;  // the torque of the wheels, as a fraction of 1.5 N m
  EXPECT_NEAR(f.Sensor(2), -0.5 * kFullTorque, 1e-9) << "the load turns the one to the right that would turn left";
  EXPECT_NEAR(f.Sensor(5), 0.5 * kFullTorque, 1e-9);
}

TEST(Kinematics2dGrip, ThreeRobotsTurnAPreyTogetherRigidly)
{
  Group group({0, 2 * kPi / 3, 2 * kPi * 2 / 3});
  auto& [f, prey, robots] = group;
  std::vector<Pose> held;
  for (const auto robot : robots) held.push_back(f.PoseOf(prey).Inverse().Compose(f.PoseOf(robot)));
  group.Grip();
  for (std::size_t k = 0; k < 3; ++k) Drive(f, k, -0.05, 0.05);
  f.Ticks(30);
  // By symmetry the whole turns about the prey.
  EXPECT_LT((f.PoseOf(prey).position - Vector3(5, 5, 0)).norm(), 1e-12);
  EXPECT_GT(YawOf(f.PoseOf(prey).orientation), 0.1);
  for (std::size_t k = 0; k < 3; ++k)
  {
    const Pose now = f.PoseOf(prey).Inverse().Compose(f.PoseOf(robots[k]));
    EXPECT_LT((now.position - held[k].position).norm(), 1e-12);
    EXPECT_NEAR(std::abs(now.orientation.dot(held[k].orientation)), 1, 1e-12);
  }
}

TEST(Kinematics2dGrip, OnlyPreysInReachAreGripped)
{
  EngineFixture f;
  const auto robot = f.Add(EntityKind::kFootbot, Vector3(5, 5, 0));
  f.Add(EntityKind::kFootbot, Vector3(5.2, 5, 0), {0, 0, kPi / 2});  // touches the gripper, but is no prey
  AddPrey(f, 4.7, 5);                                                // behind
  AddPrey(f, 5 + kReach + 0.02, 5.3);                                // beside
  const auto other = AddRobotAround(f, 8 + 0.05, 8, 0);
  AddPrey(f, 8, 8);  // ahead, 5 cm from its gripper
  f.AddCommands("footbot_gripper", 1, {robot, other});
  f.Command(0) = f.Command(1) = 1;
  f.Ticks(3);
  EXPECT_EQ(GrippedBy(f, robot), 0);
  EXPECT_EQ(GrippedBy(f, other), 0);
  EXPECT_EQ(f.Space().GetEntity(robot).GetAttribute("gripper_aperture"), 0);
}

TEST(Kinematics2dGrip, AGroupThatRunsIntoAWallStopsAsAWhole)
{
  Group group({kPi});
  auto& [f, prey, robots] = group;
  const auto robot = robots[0];
  f.Parameter("elasticity", "0");
  f.Add(EntityKind::kBlock, Vector3(5.35, 5, 0.25), {}, Vector3(0.1, 2, 0.5), false);
  const double distance = (f.PoseOf(prey).position - f.PoseOf(robot).position).norm();
  f.Command(2) = 1;
  Drive(f, 0, 0.2, 0.2);
  f.Ticks(60);
  EXPECT_NEAR(f.PoseOf(prey).position.x(), 5.3 - kPreyRadius, 1e-3);
  EXPECT_NEAR((f.PoseOf(prey).position - f.PoseOf(robot).position).norm(), distance, 1e-12);
}

TEST(Kinematics2dGrip, MovingAGrippedRobotAwayEndsTheGrip)
{
  EngineFixture f;
  const auto prey = AddPrey(f, 5, 5);
  const auto robot = AddRobotAround(f, 5, 5, 0);
  f.AddCommands("footbot_gripper", 1, {robot});
  f.Command(0) = 1;
  f.Tick();
  EXPECT_EQ(GrippedBy(f, robot), 1.0 + prey);
  f.Space().SetPose(robot, {Vector3(8, 8, 0), Quaternion::Identity()});
  f.Space().GetEntity(robot).SetAttribute("gripped", 0);
  f.Engine().EntityMoved(robot);
  f.Tick();
  EXPECT_EQ(GrippedBy(f, robot), 0);
  EXPECT_LT((f.PoseOf(prey).position - Vector3(5, 5, 0)).norm(), 1e-12);
}

// A robot keeps its grip, though another prey would be nearer to the gripper. So does a restored one.
TEST(Kinematics2dGrip, ARobotThatIsMovedWithItsPreyHoldsItToTheLastBit)
{
  for (const bool restored : {false, true})
  {
    EngineFixture f;
    const auto prey = AddPrey(f, 5, 5);
    const auto robot = AddRobotAround(f, 5, 5, 0.3);
    const auto nearer = AddPrey(f, 8, 2);
    f.AddCommands("footbot_gripper", 1, {robot});
    f.Command(0) = 1;
    f.Tick();
    ASSERT_EQ(GrippedBy(f, robot), 1.0 + prey);
    const auto grip = [&]
    { return dynamic_cast<Kinematics2dEngine&>(f.Engine()).WorldForTest().Grips().at(0).relative; };
    const kinematics2d::Pose2 before = grip();
    if (restored)
    {
      ByteWriter state;
      f.Engine().SaveState(state);
      auto fresh = f.MakeEngine();
      ByteReader reader(state.Bytes());
      fresh->LoadState(reader);
      std::swap(f.EnginePointer(), fresh);
    }
    const Pose there{Vector3(7, 3, 0), QuaternionFromYaw(3)};
    const std::vector<Pose> poses = f.Space().Structure().GetCompound(robot).PosesAt(robot, there);
    f.Space().SetPose(prey, poses[0]);
    f.Space().SetPose(robot, poses[1]);
    // The point is between gripper and prey.
    f.Space().SetPose(nearer, {there.Apply({kinematics2d::kFootbotGripperReach + kPreyRadius - 0.001, 0, 0}),
                               Quaternion::Identity()});
    for (const std::uint32_t moved : {prey, robot, nearer}) f.Engine().EntityMoved(moved);
    f.Tick();
    EXPECT_EQ(GrippedBy(f, robot), 1.0 + prey);
    EXPECT_EQ(grip().x, before.x);
    EXPECT_EQ(grip().y, before.y);
    EXPECT_EQ(grip().heading.z, before.heading.z);
  }
}

// A crowd with turning turrets, grips, a mirror and walls, driven at random.
struct Crowd
{
  EngineFixture f;
  std::vector<std::uint32_t> robots;
  std::uint32_t mirror = 0;

  Crowd()
  {
    f.Configuration().subclock = 2;
    for (int k = 0; k < 60; ++k)
      robots.push_back(
          f.Add(EntityKind::kFootbot, Vector3(0.2 + 0.25 * (k % 8), 0.2 + 0.25 * (k / 8), 0), {0, 0, 0.7 * k}));
    for (int k = 0; k < 8; ++k) AddPrey(f, 0.3 + 0.25 * k, 2.4);
    mirror = f.AddMirror(EntityKind::kEyebot, Vector3(3, 1, 0));
    f.Add(EntityKind::kBlock, Vector3(-0.05, 1.5, 0.25), {}, Vector3(0.1, 4, 0.5), false);
    f.Add(EntityKind::kBlock, Vector3(1.5, -0.05, 0.25), {}, Vector3(4, 0.1, 0.5), false);
    f.AddCommands("footbot_wheels", 2, robots);
    f.AddCommands("footbot_gripper", 1, robots);
    f.AddCommands("footbot_turret", 1, robots);
    f.AddSensors("footbot_encoders", 2, robots);
    f.AddSensors("footbot_turret_torque", 3, robots);
    f.Start();
  }

  void Tick(std::uint32_t tick)
  {
    RandomStream random(3, 0, 0, tick / 5);
    const std::size_t n = robots.size();
    for (std::size_t k = 0; k < n; ++k)
    {
      f.Command(2 * k) = WheelSpeed(random.Uniform(-0.1, 0.3));
      f.Command(2 * k + 1) = WheelSpeed(random.Uniform(-0.1, 0.3));
      f.Command(2 * n + k) = random.Uniform() < 0.8 ? 1 : 0;
      f.Command(3 * n + k) = random.Uniform(-1, 1);
    }
    f.Space().SetPose(mirror, {Vector3(3 - 0.02 * tick, 1, 0), Quaternion::Identity()});
    f.Tick();
  }
};

TEST(Kinematics2dCheckpoint, ARestoredEngineGoesOnWithTheSameBits)
{
  bool gripped = false;
  for (const std::uint32_t checkpoint : {1U, 17U, 60U, 83U})
  {
    Crowd whole;
    std::vector<std::uint64_t> hashes;
    for (std::uint32_t tick = 0; tick < 100; ++tick)
    {
      whole.Tick(tick);
      hashes.push_back(whole.f.Space().Hash());
    }

    Crowd restored;
    for (std::uint32_t tick = 0; tick < checkpoint; ++tick) restored.Tick(tick);
    for (const auto robot : restored.robots) gripped = gripped || GrippedBy(restored.f, robot) != 0;
    ByteWriter saved;
    restored.f.Engine().Canonicalise();
    restored.f.Engine().SaveState(saved);
    restored.f.EnginePointer() = restored.f.MakeEngine();
    ByteReader reader(saved.Bytes());
    restored.f.Engine().LoadState(reader);
    EXPECT_TRUE(reader.AtEnd());
    for (std::uint32_t tick = checkpoint; tick < 100; ++tick)
    {
      restored.Tick(tick);
      ASSERT_EQ(restored.f.Space().Hash(), hashes[tick]) << checkpoint << " " << tick;
    }
  }
  EXPECT_TRUE(gripped);
}

TEST(Kinematics2dCheckpoint, AStateOfAnotherExperimentIsRefused)
{
  Crowd crowd;
  ByteWriter saved;
  crowd.f.Engine().SaveState(saved);
  EngineFixture other;
  other.Add(EntityKind::kFootbot, Vector3(1, 1, 0));
  other.Start();
  ByteReader reader(saved.Bytes());
  EXPECT_THROW(other.Engine().LoadState(reader), std::runtime_error);
}

}  // namespace
}  // namespace swarmanoid

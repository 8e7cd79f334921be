// Handbots and eyebots in both engines of the plane.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/engines/jointed_robots.h"
#include "tests/unit/engines/saved_state_bytes.h"
#include "tests/unit/engines/test_quadrotor.h"
#include "tests/unit/kinematics2d/engine_fixture.h"

namespace swarmanoid
{
namespace
{

constexpr double kTick = 0.1;  // s

class PlaneRobotsIn : public testing::TestWithParam<const char*>
{
protected:
  PlaneRobotsIn() { f.Configuration().tag = GetParam(); }
  double Height(std::uint32_t entity) { return f.PoseOf(entity).position.z(); }
  double Attribute(std::uint32_t entity, const char* name, int element = 0)
  {
    return f.Space().GetEntity(entity).GetAttribute(name, element);
  }
  // A handbot at (2, 3), commands: 0-4 joints, 5-6 hands, 7-8 rope.
  std::uint32_t AddHandbot()
  {
    const auto robot = f.Add(EntityKind::kHandbot, Vector3(2, 3, 0));
    f.AddCommands("handbot_arms", 5, {robot});
    f.AddCommands("handbot_hands", 2, {robot});
    f.AddCommands("handbot_rope", 2, {robot});
    return robot;
  }

  // Puts a fresh engine in place of the running one, from its saved state, as a checkpoint does.
  void ReplaceEngineBySavedState()
  {
    f.Engine().Canonicalise();
    RestoreFromSavedState(f);
  }
  static void RestoreFromSavedState(EngineFixture& world)
  {
    ByteWriter state;
    world.Engine().SaveState(state);
    auto restored = world.MakeEngine();
    ByteReader reader(state.Bytes());
    restored->LoadState(reader);
    EXPECT_TRUE(reader.AtEnd());
    std::swap(world.EnginePointer(), restored);
  }

  EngineFixture f;
};

INSTANTIATE_TEST_SUITE_P(Engines, PlaneRobotsIn, testing::Values("kinematics2d", "dynamics2d"),
                         [](const auto& test) { return std::string(test.param); });

TEST_P(PlaneRobotsIn, TheWinchRaisesTheHandbotByTheRopeThatItTakesIn)
{
  const auto robot = AddHandbot();
  f.Command(7) = 1;
  f.Tick();
  EXPECT_EQ(Attribute(robot, "rope_attached"), 1);
  EXPECT_NEAR(Attribute(robot, "rope_length"), 3 - 0.16, 1e-12);  // the ceiling of the arena is at 3 m
  EXPECT_NEAR(Height(robot), 0, 1e-12);
  f.Command(8) = -0.1;
  f.Ticks(50);
  EXPECT_NEAR(Height(robot), 0.5, 1e-9);
  EXPECT_NEAR(Attribute(robot, "rope_length"), 2.34, 1e-9);
  EXPECT_NEAR(f.PoseOf(robot).position.x(), 2, 1e-6);
  f.Command(8) = -5;  // limited to 0.15 m/s; ends where the rope is 5 cm long
  f.Ticks(10);
  EXPECT_NEAR(Height(robot), 0.65, 1e-9);
  f.Ticks(200);
  EXPECT_NEAR(Height(robot), 3 - 0.16 - 0.05, 1e-9);
  // With the rope let out the robot stands. Further rope hangs slack.
  f.Command(8) = 0.15;
  f.Ticks(250);
  EXPECT_EQ(Height(robot), 0);
  EXPECT_GT(Attribute(robot, "rope_length"), 2.9);
}

TEST_P(PlaneRobotsIn, AHandbotThatLetsGoOfItsRopeFallsFreely)
{
  const auto robot = AddHandbot();
  f.Command(7) = 1;
  f.Command(8) = -0.15;
  f.Ticks(100);
  ASSERT_NEAR(Height(robot), 1.5, 1e-9);
  f.Command(7) = f.Command(8) = 0;
  f.Ticks(3);
  EXPECT_NEAR(Height(robot), 1.5 - 0.5 * 9.81 * std::pow(3 * kTick, 2), 1e-9);
  EXPECT_EQ(Attribute(robot, "rope_attached"), 0);
  f.Ticks(10);
  EXPECT_EQ(Height(robot), 0);
}

TEST_P(PlaneRobotsIn, JointsTurnAtTheirSpeedsWithinTheirRanges)
{
  const auto robot = AddHandbot();
  f.Command(0) = 1;     // head
  f.Command(1) = 0.5;   // left arm
  f.Command(2) = -0.5;  // right arm
  f.Command(4) = 3;     // right wrist
  f.Ticks(10);
  EXPECT_NEAR(Attribute(robot, "head_angle"), 1, 1e-12);
  EXPECT_NEAR(Attribute(robot, "arm", 0), 0.5, 1e-12);
  EXPECT_EQ(Attribute(robot, "arm", 1), 0);
  EXPECT_EQ(Attribute(robot, "wrist", 0), 0);
  EXPECT_NEAR(Attribute(robot, "wrist", 1), 1.5708, 1e-12);
  EXPECT_NEAR(Attribute(robot, "hand_aperture", 0), 3, 1e-12);  // its command is to open at 3 rad/s since the start
  f.Ticks(30);
  EXPECT_NEAR(Attribute(robot, "head_angle"), 4 - 2 * kPi, 1e-9);  // turns on and on
  EXPECT_NEAR(Attribute(robot, "arm", 0), 1.0472, 1e-12);
}

TEST_P(PlaneRobotsIn, LinksOfRobotsOnWheelsFollowTheirCommands)
{
  const auto robot = f.Add(test::CartWithArm(), Vector3(2, 3, 0));
  f.AddCommands("joints", 6, {robot});
  f.AddSensors("joints", 9, {robot});
  f.Command(0) = 1;  // lift: to a position, at its 0.2 m/s
  f.Command(1) = 0.1;
  f.Command(2) = 2;  // shoulder: at a speed
  f.Command(3) = 1;
  f.Command(4) = 1;  // elbow: beyond its range
  f.Command(5) = 9;
  f.Ticks(3);
  EXPECT_NEAR(Attribute(robot, "joint_lift"), 0.06, 1e-12);
  EXPECT_NEAR(f.Sensor(0), 0.06, 1e-12);
  EXPECT_NEAR(f.Sensor(1), 0.2, 1e-9);
  EXPECT_NEAR(f.Sensor(2), 0, 0);
  EXPECT_NEAR(Attribute(robot, "joint_shoulder"), 0.3, 1e-12);
  EXPECT_NEAR(Attribute(robot, "joint_elbow"), 0.9, 1e-12);
  ReplaceEngineBySavedState();
  f.Ticks(37);
  EXPECT_NEAR(Attribute(robot, "joint_lift"), 0.1, 1e-12);
  EXPECT_NEAR(f.Sensor(1), 0, 1e-12);
  EXPECT_NEAR(f.Sensor(3), 4 - 2 * kPi, 1e-9);  // turns on and on
  EXPECT_NEAR(f.Sensor(6), 1.2, 1e-12);
}

TEST_P(PlaneRobotsIn, ACommandThatIsNotANumberNamesRobotAndChannel)
{
  const std::uint32_t robot = AddHandbot();
  f.Start();
  for (std::size_t command = 0; command < 9; ++command)
  {
    f.Command(command) = std::nan("");
    const std::string channel = command < 5 ? "handbot_arms" : command < 7 ? "handbot_hands" : "handbot_rope";
    EXPECT_THAT([&] { f.Tick(); },
                testing::ThrowsMessage<std::runtime_error>(testing::HasSubstr(
                    "robot '" + f.Space().GetEntity(robot).GetId() + "' gave " + channel + " a value")))
        << command;
    f.Command(command) = 0;
  }
}

// The left hand's tip is 0.256 m ahead, 0.05 m to the left and 0.1 m high.
TEST_P(PlaneRobotsIn, AHandTakesABlockItCanReachAndLiftsIt)
{
  const auto robot = AddHandbot();
  const auto book = f.Add(EntityKind::kBlock, Vector3(2.3, 3.05, 0.1), {}, Vector3(0.06, 0.1, 0.2));
  const auto far = f.Add(EntityKind::kBlock, Vector3(2.36, 3.3, 0.1), {}, Vector3(0.1, 0.2, 0.2));
  f.Command(5) = f.Command(6) = 1;
  f.Ticks(2);
  EXPECT_EQ(Attribute(robot, "gripped", 0), 1 + book);
  EXPECT_EQ(Attribute(robot, "gripped", 1), 0);  // 3 cm is the reach of a hand; the right one is 5 cm away
  f.Command(7) = 1;
  f.Command(8) = -0.1;
  f.Ticks(50);
  EXPECT_NEAR(Height(robot), 0.5, 1e-9);
  EXPECT_NEAR(Height(book), 0.6, 1e-9);
  EXPECT_NEAR(Height(far), 0.1, 1e-9);
  // When it opens, the hand drops it.
  f.Command(5) = 0;
  f.Ticks(2);
  EXPECT_EQ(Attribute(robot, "gripped", 0), 0);
  EXPECT_LT(Height(book), 0.6);
  f.Ticks(10);
  EXPECT_NEAR(Height(book), 0.1, 1e-9);
}

// Upside down, the right hand is on the left.
TEST_P(PlaneRobotsIn, HandsGoRoundWithTheHead)
{
  const auto robot = AddHandbot();
  const auto book = f.Add(EntityKind::kBlock, Vector3(2.3, 3.05, 0.1), {}, Vector3(0.06, 0.1, 0.2));
  f.Command(0) = kPi;
  f.Ticks(10);
  f.Command(0) = 0;
  f.Command(5) = f.Command(6) = 1;
  f.Ticks(2);
  EXPECT_EQ(Attribute(robot, "gripped", 0), 0);
  EXPECT_EQ(Attribute(robot, "gripped", 1), 1 + book);
}

// Opened for one tick and closed again, the hand is still within reach.
TEST_P(PlaneRobotsIn, WhatAHandCatchesInItsFallFallsAnewFromRest)
{
  const auto robot = AddHandbot();
  const auto book = f.Add(EntityKind::kBlock, Vector3(2.3, 3.05, 0.1), {}, Vector3(0.06, 0.1, 0.2));
  f.Command(5) = 1;
  f.Ticks(2);
  f.Command(7) = 1;
  f.Command(8) = -0.1;
  f.Ticks(50);
  f.Command(8) = 0;
  const double height = Height(book);
  const double fall = 0.5 * 9.81 * kTick * kTick;
  f.Command(5) = 0;
  f.Tick();
  EXPECT_NEAR(Height(book), height - fall, 1e-9);
  f.Command(5) = 1;
  f.Tick();
  EXPECT_EQ(Attribute(robot, "gripped", 0), 1 + book);
  EXPECT_NEAR(Height(book), height - fall, 1e-9);
  f.Command(5) = 0;
  f.Tick();
  EXPECT_NEAR(Height(book), height - 2 * fall, 1e-9);
}

TEST_P(PlaneRobotsIn, AHandCannotTakeWhatStandsAboveOrBelowIt)
{
  const auto robot = AddHandbot();
  f.Add(EntityKind::kBlock, Vector3(2.3, 3.05, 0.025), {}, Vector3(0.06, 0.1, 0.05));
  f.Command(5) = 1;
  f.Ticks(3);
  EXPECT_EQ(Attribute(robot, "gripped", 0), 0);
}

TEST_P(PlaneRobotsIn, AHandbotAndWhatItHoldsAreOneWhole)
{
  const auto robot = AddHandbot();
  const auto prey = f.Add(EntityKind::kCylindricPrey, Vector3(2.33, 3.05, 0), {}, Vector3(0.06, 0.06, 0.2));
  const auto left = f.Add(EntityKind::kFootbot, Vector3(1.7, 3.0875, 0));
  const auto right = f.Add(EntityKind::kFootbot, Vector3(1.7, 2.9125, 0));
  f.AddCommands("footbot_wheels", 2, {left, right});
  f.Command(5) = 1;
  f.Ticks(2);
  ASSERT_EQ(Attribute(robot, "gripped", 0), 1 + prey);
  const Vector3 before = f.PoseOf(prey).position - f.PoseOf(robot).position;
  for (std::size_t wheel = 9; wheel < 13; ++wheel) f.Command(wheel) = WheelSpeed(0.1);
  f.Ticks(60);
  EXPECT_GT(f.PoseOf(robot).position.x(), 2.02);
  const Pose robot_pose = f.PoseOf(robot);
  const Vector3 after = robot_pose.orientation.conjugate() * (f.PoseOf(prey).position - robot_pose.position);
  EXPECT_LT((after - before).norm(), 2e-3);
}

TEST_P(PlaneRobotsIn, AStateRestoredInTheAirGoesOnAsBefore)
{
  const auto robot = AddHandbot();
  const auto book = f.Add(EntityKind::kBlock, Vector3(2.3, 3.05, 0.1), {}, Vector3(0.06, 0.1, 0.2));
  f.Command(5) = f.Command(7) = 1;
  f.Command(0) = 0.2;
  f.Command(8) = -0.1;
  f.Ticks(20);
  ReplaceEngineBySavedState();
  f.Ticks(5);
  EXPECT_EQ(Attribute(robot, "gripped", 0), 1 + book);
  EXPECT_NEAR(Height(robot), 0.25, 1e-9);
  EXPECT_NEAR(Height(book), 0.35, 1e-9);
  EXPECT_NEAR(Attribute(robot, "head_angle"), 0.5, 1e-9);
}

TEST_P(PlaneRobotsIn, WhatAHandTakesStaysAtItsHeightHoweverHighTheHandbotHangs)
{
  AddHandbot();
  const auto book = f.Add(EntityKind::kBlock, Vector3(2.3, 3.05, 0.1), {}, Vector3(0.06, 0.1, 0.2));
  f.Command(7) = 1;
  f.Command(8) = -0.1;
  f.Ticks(6);
  f.Command(5) = 1;
  f.Command(8) = 0;
  f.Ticks(3);
  EXPECT_NEAR(Height(book), 0.1, 1e-9);
  ReplaceEngineBySavedState();
  f.Command(8) = -0.1;
  f.Ticks(10);
  EXPECT_NEAR(Height(book), 0.2, 1e-9);
}

TEST_P(PlaneRobotsIn, AFallGoesOnAtItsSpeedWhenRestored)
{
  const auto robot = AddHandbot();
  f.Command(7) = 1;
  f.Command(8) = -0.15;
  f.Ticks(100);
  f.Command(7) = f.Command(8) = 0;
  f.Ticks(3);
  ReplaceEngineBySavedState();
  f.Ticks(2);
  EXPECT_NEAR(Height(robot), 1.5 - 0.5 * 9.81 * std::pow(5 * kTick, 2), 1e-9);
}

// A block that another engine turns or tips meets the plane in another outline: here its half length along x is 0.4 m
// as it lies, 0.1 m once turned, and it is 0.1 m wide at the floor once tipped up.
TEST_P(PlaneRobotsIn, AMirroredBlockBlocksAsItStandsNow)
{
  const auto block = f.AddMirror(EntityKind::kBlock, Vector3(5, 3, 0.1), Vector3(0.8, 0.2, 0.2));
  const auto robot = f.Add(EntityKind::kFootbot, Vector3(4, 3, 0));
  if (std::string(GetParam()) == "kinematics2d") f.Parameter("elasticity", "0");
  f.AddCommands("footbot_wheels", 2, {robot});
  f.Start();
  // Where the front of the gripper comes to rest. What is put elsewhere pushes nothing on its way.
  const auto stops_at = [&](const Pose& pose)
  {
    f.Space().SetPose(block, {Vector3(8, 8, 0.1), pose.orientation});
    f.Tick();
    f.Space().SetPose(block, pose);
    f.Ticks(60);
    return f.PoseOf(robot).position.x() + 0.1;
  };
  f.Command(0) = f.Command(1) = WheelSpeed(0.2);
  EXPECT_NEAR(stops_at({Vector3(5, 3, 0.1), Quaternion::Identity()}), 4.6, 5e-3);
  EXPECT_NEAR(stops_at({Vector3(5, 3, 0.1), QuaternionFromYaw(kPi / 2)}), 4.9, 5e-3);
  EXPECT_NEAR(stops_at({Vector3(5.4, 3, 0.4), QuaternionFromEuler({0, kPi / 2, 0})}), 5.3, 5e-3);
}

// Tests every field of a checkpoint, including those that keep their start values in most runs.
TEST_P(PlaneRobotsIn, EachByteOfASavedStateIsTakenBack)
{
  AddHandbot();
  f.Add(EntityKind::kBlock, Vector3(2.3, 3.05, 0.1), {}, Vector3(0.06, 0.1, 0.2));
  f.AddMirror(EntityKind::kBlock, Vector3(5, 3, 0.1), Vector3(0.8, 0.2, 0.2));
  const auto footbot = f.Add(EntityKind::kFootbot, Vector3(7, 3, 0));
  const auto prey = f.Add(EntityKind::kCylindricPrey, Vector3(7.205, 3, 0), {}, Vector3(0.1, 0.1, 0.1));
  f.Add(EntityKind::kEyebot, Vector3(8, 8, 0));
  f.AddCommands("footbot_wheels", 2, {footbot});
  f.AddCommands("footbot_gripper", 1, {footbot});
  f.AddCommands("footbot_turret", 1, {footbot});
  f.Start();
  for (const std::size_t command : {0, 1, 3, 5, 7, 11}) f.Command(command) = 1;
  f.Command(8) = -0.1;
  f.Command(9) = -1;
  f.Command(12) = 0.3;
  f.Ticks(20);
  ASSERT_EQ(Attribute(footbot, "gripped"), 1 + prey);
  f.Engine().Canonicalise();
  ByteWriter state;
  f.Engine().SaveState(state);
  EXPECT_THAT(LostBytes(state.Bytes(), [this](const auto& changed) { return SavedAgain(f.Engine(), changed); }),
              testing::IsEmpty());
}

// Another engine tips a block over while a robot leans against it.
TEST_P(PlaneRobotsIn, AMirrorThatTipsGoesOnWithTheSameBitsWhenRestored)
{
  const auto hashes = [this](int restored_at)
  {
    EngineFixture world;
    world.Configuration().tag = GetParam();
    const auto block = world.AddMirror(EntityKind::kBlock, Vector3(5, 3, 0.1), Vector3(0.8, 0.2, 0.2));
    const auto robot = world.Add(EntityKind::kFootbot, Vector3(4.5, 3, 0));
    world.AddCommands("footbot_wheels", 2, {robot});
    world.Command(0) = world.Command(1) = WheelSpeed(0.2);
    std::vector<std::uint64_t> found;
    for (int tick = 0; tick < 60; ++tick)
    {
      world.Space().SetPose(block, {Vector3(5, 3, 0.1), QuaternionFromEuler({0, 0.02 * tick, 0.003 * tick})});
      world.Engine().Canonicalise();
      if (tick == restored_at) RestoreFromSavedState(world);
      world.Tick();
      found.push_back(world.Space().Hash());
    }
    return found;
  };
  for (const int tick : {5, 30, 50}) EXPECT_EQ(hashes(tick), hashes(-1)) << tick;
}

TEST_P(PlaneRobotsIn, AnEyebotOnThePlaneUnderTheCeilingHangsOnItByItsMagnet)
{
  f.Parameter("distance", "2.42");  // the top of the robot is 1.4 cm below the ceiling
  const auto robot = f.Add(EntityKind::kEyebot, Vector3(2, 3, 2.42));
  f.AddCommands("eyebot_propellers", 4, {robot});
  f.AddCommands("eyebot_attach", 1, {robot});
  f.Command(0) = 0.2;
  f.Ticks(10);
  EXPECT_EQ(Attribute(robot, "attached"), 0);
  f.Command(4) = 1;
  f.Ticks(2);
  EXPECT_EQ(Attribute(robot, "attached"), 1);
  const double x = f.PoseOf(robot).position.x();
  EXPECT_GT(x, 2.1);
  f.Ticks(10);
  EXPECT_NEAR(f.PoseOf(robot).position.x(), x, 1e-6);
  f.Command(4) = 0;
  f.Ticks(10);
  EXPECT_EQ(Attribute(robot, "attached"), 0);
  EXPECT_GT(f.PoseOf(robot).position.x(), x + 0.1);
}

TEST_P(PlaneRobotsIn, QuadrotorsFlyAtTheCommandedVelocityAtTheHeightOfThePlane)
{
  f.Parameter("distance", "1");
  const auto robot = f.Add(test::Quadrotor(), Vector3(2, 3, 1));
  f.AddCommands("eyebot_propellers", 4, {robot});
  f.Command(0) = 0.4;
  f.Command(1) = -0.2;
  f.Ticks(10);
  const Vector3 before = f.PoseOf(robot).position;
  f.Ticks(20);
  EXPECT_LT((f.PoseOf(robot).position - before - Vector3(0.8, -0.4, 0)).norm(), 1e-4);
}

TEST_P(PlaneRobotsIn, WindCarriesFlyingRobotsAlongHoweverTheyTurn)
{
  f.GetExperiment().wind = WindConfiguration{{0.3, -0.1, 0.2}, 0, 3};
  std::vector<std::uint32_t> robots;
  for (const double y : {3.0, 5.0, 7.0}) robots.push_back(f.Add(EntityKind::kEyebot, Vector3(2, y, 0), {0, 0, y}));
  const auto footbot = f.Add(EntityKind::kFootbot, Vector3(8, 8, 0));
  f.AddCommands("eyebot_propellers", 4, robots);
  f.Command(7) = 1;    // the second one turns,
  f.Command(8) = 0.2;  // and the third one also flies on a circle
  f.Command(11) = kPi / 2;
  f.Ticks(10);
  std::vector<Vector3> before;
  for (const std::uint32_t robot : robots) before.push_back(f.PoseOf(robot).position);
  f.Ticks(40);  // one turn of the third robot
  for (std::size_t k = 0; k < robots.size(); ++k)
    EXPECT_LT((f.PoseOf(robots[k]).position - before[k] - Vector3(1.2, -0.4, 0)).norm(), 1e-3) << k;
  EXPECT_EQ(f.PoseOf(footbot).position, Vector3(8, 8, 0));
}

TEST_P(PlaneRobotsIn, FarBelowTheCeilingTheMagnetHoldsNothing)
{
  const auto robot = f.Add(EntityKind::kEyebot, Vector3(2, 3, 0));
  f.AddCommands("eyebot_attach", 1, {robot});
  f.Command(0) = 1;
  f.Ticks(3);
  EXPECT_EQ(Attribute(robot, "attached"), 0);
}

}  // namespace
}  // namespace swarmanoid

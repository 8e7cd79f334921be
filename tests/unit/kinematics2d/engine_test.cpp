#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "tests/unit/kinematics2d/engine_fixture.h"
#include "tests/world/message_of.h"

namespace swarmanoid
{
namespace
{

TEST(Kinematics2dEngine, WheelsDriveAFootbotAlongTheExactArc)
{
  EngineFixture f;
  const auto robot = f.Add(EntityKind::kFootbot, Vector3(2, 3, 0), {0, 0, 0.4});
  f.AddCommands("footbot_wheels", 2, {robot});
  f.AddSensors("footbot_encoders", 2, {robot});
  f.Command(0) = WheelSpeed(0.1);
  f.Command(1) = WheelSpeed(0.2);
  f.Ticks(10);
  const double turn = 0.1 / 0.14;
  const double radius = 0.15 / turn;
  EXPECT_NEAR(f.PoseOf(robot).position.x(), 2 + radius * (std::sin(0.4 + turn) - std::sin(0.4)), 1e-12);
  EXPECT_NEAR(f.PoseOf(robot).position.y(), 3 - radius * (std::cos(0.4 + turn) - std::cos(0.4)), 1e-12);
  EXPECT_NEAR(YawOf(f.PoseOf(robot).orientation), 0.4 + turn, 1e-12);
  EXPECT_NEAR(f.Sensor(0), 0.01, 1e-14);
  EXPECT_NEAR(f.Sensor(1), 0.02, 1e-14);
}

TEST(Kinematics2dEngine, EncodersReadWhatWasRolledNotWhatWasWanted)
{
  EngineFixture f;
  f.Parameter("elasticity", "0");
  const auto robot = f.Add(EntityKind::kFootbot, Vector3(2, 3, 0));
  f.Add(EntityKind::kBlock, Vector3(2.2, 3, 0.25), {}, Vector3(0.1, 2, 0.5), false);
  f.AddCommands("footbot_wheels", 2, {robot});
  f.AddSensors("footbot_encoders", 2, {robot});
  f.Command(0) = f.Command(1) = WheelSpeed(0.3);
  f.Ticks(20);
  EXPECT_NEAR(f.Sensor(0), 0, 1e-4);
  EXPECT_NEAR(f.Sensor(1), 0, 1e-4);
  EXPECT_NEAR(f.PoseOf(robot).position.x(), 2.15 - kinematics2d::kFootbotGripperReach, 1e-3);
}

TEST(Kinematics2dEngine, RobotsMoveOnThePlanePerpendicularToTheChosenAxis)
{
  struct Case
  {
    const char* axis;
    Vector3 forward, left, normal;
  };
  for (const Case& c : {Case{"x", Vector3::UnitY(), Vector3::UnitZ(), Vector3::UnitX()},
                        Case{"y", Vector3::UnitZ(), Vector3::UnitX(), Vector3::UnitY()},
                        Case{"z", Vector3::UnitX(), Vector3::UnitY(), Vector3::UnitZ()}})
  {
    EngineFixture f;
    f.Parameter("perpendicular_axis", c.axis);
    f.Parameter("distance", "-1.5");
    const auto frame = PlaneFrame(*c.axis == 'x'   ? PlaneAxis::kX
                                  : *c.axis == 'y' ? PlaneAxis::kY
                                                   : PlaneAxis::kZ,
                                  -1.5);
    const Pose start = frame.ToSpace({0.5, 0.25, 0});
    const auto robot = f.Add(EntityKind::kEyebot, start.position, EulerFromQuaternion(start.orientation));
    f.AddCommands("eyebot_propellers", 4, {robot});
    f.Command(0) = 0.4;
    f.Command(1) = -0.2;
    f.Command(2) = 5;  // up: out of the plane, ignored
    f.Ticks(10);
    const Vector3 expected = start.position + 0.4 * c.forward - 0.2 * c.left;
    EXPECT_LT((f.PoseOf(robot).position - expected).norm(), 1e-12) << c.axis;
    EXPECT_LT((f.PoseOf(robot).orientation * Vector3::UnitZ() - c.normal).norm(), 1e-12) << c.axis;
    f.Command(3) = 1;
    f.Ticks(5);
    EXPECT_LT(
        (f.PoseOf(robot).orientation * Vector3::UnitX() - (std::cos(0.5) * c.forward + std::sin(0.5) * c.left)).norm(),
        1e-12);
  }
}

TEST(Kinematics2dEngine, ATiltedPlaneCarriesItsRobots)
{
  EngineFixture f;
  f.Parameter("tilt", "0, -30, 0");
  const auto robot = f.Add(EntityKind::kFootbot, Vector3(0, 0, 0));
  f.AddCommands("footbot_wheels", 2, {robot});
  f.Command(0) = f.Command(1) = WheelSpeed(0.2);
  f.Ticks(10);
  const Vector3 uphill(std::cos(kPi / 6), 0, std::sin(kPi / 6));
  EXPECT_LT((f.PoseOf(robot).position - 0.2 * uphill).norm(), 1e-12);
  EXPECT_LT((f.PoseOf(robot).orientation * Vector3::UnitX() - uphill).norm(), 1e-12);
}

TEST(Kinematics2dEngine, RobotsArePutOnThePlaneAndBlocksKeepTheirHeight)
{
  EngineFixture f;
  f.Parameter("distance", "0.1");
  const auto robot = f.Add(EntityKind::kFootbot, Vector3(2, 3, 0.7), {0, 0, 1});
  const auto block = f.Add(EntityKind::kBlock, Vector3(5, 5, 0.25), {0, 0, 0.5}, Vector3(0.5, 0.1, 0.5));
  f.Tick();
  EXPECT_LT((f.PoseOf(robot).position - Vector3(2, 3, 0.1)).norm(), 1e-12);
  EXPECT_LT((f.PoseOf(block).position - Vector3(5, 5, 0.25)).norm(), 1e-12);
  EXPECT_NEAR(YawOf(f.PoseOf(block).orientation), 0.5, 1e-12);
}

// If all bodies are upright, poses are written by columns.
TEST(Kinematics2dEngine, BlocksThatAreNotTurnedKeepTheirHeightAmongRobots)
{
  EngineFixture f;
  f.Parameter("distance", "0.1");
  const auto robot = f.Add(EntityKind::kFootbot, Vector3(2, 3, 0.1));
  const auto low = f.Add(EntityKind::kBlock, Vector3(5, 5, 0.15), {0, 0, 0}, Vector3(0.5, 0.1, 0.3));
  const auto other = f.Add(EntityKind::kFootbot, Vector3(4, 3, 0.1));
  const auto high = f.Add(EntityKind::kBlock, Vector3(8, 5, 0.25), {0, 0, 0}, Vector3(0.5, 0.1, 0.5));
  f.Ticks(3);
  EXPECT_EQ(f.PoseOf(robot).position.z(), 0.1);
  EXPECT_EQ(f.PoseOf(other).position.z(), 0.1);
  EXPECT_NEAR(f.PoseOf(low).position.z(), 0.15, 1e-12);
  EXPECT_NEAR(f.PoseOf(high).position.z(), 0.25, 1e-12);
}

// It does so also while others on the plane drive.
TEST(Kinematics2dEngine, BlocksThatLeanKeepTheirHeightAndLean)
{
  EngineFixture f;
  const auto robot = f.Add(EntityKind::kFootbot, Vector3(2, 3, 0));
  const auto leaning = f.Add(EntityKind::kBlock, Vector3(5, 5, 0.25), {0.3, -0.2, 0.5}, Vector3(0.5, 0.1, 0.5));
  const auto lying = f.Add(EntityKind::kBlock, Vector3(8, 5, 0.05), {kPi / 2, 0, 2}, Vector3(0.5, 0.5, 0.1));
  f.AddCommands("footbot_wheels", 2, {robot});
  f.Command(0) = f.Command(1) = WheelSpeed(0.2);
  const Pose before[] = {f.PoseOf(leaning), f.PoseOf(lying)};
  f.Ticks(5);
  for (const std::uint32_t k : {0U, 1U})
  {
    const Pose after = f.PoseOf(k == 0 ? leaning : lying);
    EXPECT_LT((after.position - before[k].position).norm(), 1e-12) << k;
    EXPECT_LT(after.orientation.angularDistance(before[k].orientation), 1e-7) << k;
  }
}

TEST(Kinematics2dEngine, OnlyBlocksThatThePlaneCutsAreInTheWay)
{
  // One block is on the plane, one is above it, and one is centred far below but reaches up through it.
  for (const auto& [height, size, blocked] :
       {std::tuple{0.25, 0.5, true}, std::tuple{0.8, 0.5, false}, std::tuple{-4.0, 9.0, true}})
  {
    EngineFixture f;
    const auto robot = f.Add(EntityKind::kFootbot, Vector3(2, 3, 0));
    f.Add(EntityKind::kBlock, Vector3(2.5, 3, height), {}, Vector3(0.1, 2, size), false);
    f.AddCommands("footbot_wheels", 2, {robot});
    f.Command(0) = f.Command(1) = WheelSpeed(0.3);
    f.Ticks(40);
    EXPECT_EQ(f.PoseOf(robot).position.x() < 2.5, blocked) << height;
  }
}

TEST(Kinematics2dEngine, AMirrorPushesIsNotMovedAndCountsOnlyInThePlane)
{
  for (const double height : {0.0, 1.0})
  {
    EngineFixture f;
    const auto pushed = f.Add(EntityKind::kFootbot, Vector3(2, 3, 0), {0, 0, kPi / 2});
    const auto mirror = f.AddMirror(EntityKind::kEyebot, Vector3(1.5, 3, height));
    f.Start();
    for (int k = 1; k <= 10; ++k)
    {
      f.Space().SetPose(mirror, {Vector3(1.5 + 0.05 * k, 3, height), Quaternion::Identity()});
      f.Tick();
    }
    EXPECT_EQ(f.LastUpdate().poses.size(), 7U);
    const double gap = f.PoseOf(pushed).position.x() - 2.0;
    if (height == 0)
      EXPECT_GT(gap, 0.3);
    else
      EXPECT_EQ(gap, 0);
  }
}

TEST(Kinematics2dEngine, AMirrorThatDrivesOnEntersNoRobotThatHasRoom)
{
  // The mirror is an eyebot of 0.25 m that goes 0.1 m a tick, straight on or on a curve.
  for (const double turn : {0.0, 0.5})
  {
    EngineFixture f;
    const Vector3 start = turn == 0 ? Vector3(3, 3, 0) : Vector3(2.435, 3.607, 0);
    const auto pushed = f.Add(EntityKind::kFootbot, start, {0, 0, kPi / 2});
    const auto mirror = f.AddMirror(EntityKind::kEyebot, Vector3(1, 3, 0));
    f.Start();
    double deepest = 0;
    for (int k = 1; k <= 30; ++k)
    {
      const double angle = 0.1 * turn * k;
      const Vector3 at = turn == 0 ? Vector3(1 + 0.1 * k, 3, 0)
                                   : Vector3(1 + std::sin(angle) / turn, 3 + (1 - std::cos(angle)) / turn, 0);
      f.Tick();
      f.Space().SetPose(mirror, {at, QuaternionFromYaw(angle)});
      const Vector3 between = f.PoseOf(pushed).position - at;
      deepest = std::max(deepest, 0.25 + kinematics2d::kFootbotRadius - between.norm());
    }
    EXPECT_GT((f.PoseOf(pushed).position - start).norm(), 0.2);
    EXPECT_LT(deepest, 1e-3) << turn;
  }
}

TEST(Kinematics2dEngine, AMirrorThatWasPutElsewhereDoesNotGoOn)
{
  EngineFixture f;
  const auto near = f.Add(EntityKind::kFootbot, Vector3(2, 3, 0));
  const auto mirror = f.AddMirror(EntityKind::kEyebot, Vector3(1.2, 3, 0));
  f.Start();
  f.Tick();
  f.Space().SetPose(mirror, {Vector3(1.6, 3, 0), Quaternion::Identity()});
  f.Engine().MirrorMoved(mirror);
  f.Ticks(2);
  EXPECT_EQ(f.PoseOf(near).position.x(), 2);
}

TEST(Kinematics2dEngine, FrictionOfWallsIsThatOfTheFileOrOfTheEngine)
{
  const auto way = [](const std::string& of_engine)
  {
    EngineFixture f;
    f.Parameter("wall_friction", of_engine);
    const auto robot = f.Add(EntityKind::kFootbot, Vector3(2.9, 3, 0), {0, 0, kPi / 4});
    f.Add(EntityKind::kBlock, Vector3(3.5, 5, 0.2), {}, Vector3(1, 9, 0.4), false);
    f.AddCommands("footbot_wheels", 2, {robot});
    f.Command(0) = f.Command(1) = WheelSpeed(0.1);
    f.Ticks(300);
    return f.PoseOf(robot).position.y() - 3;
  };
  EXPECT_NEAR(way("0"), 3 * std::sqrt(0.5), 1e-3);
  EXPECT_NEAR(way("0.01"), 3 * std::sqrt(0.5) * 0.93, 2e-3);
}

TEST(Kinematics2dEngine, AnEntityPutElsewhereGoesOnFromThere)
{
  EngineFixture f;
  const auto robot = f.Add(EntityKind::kFootbot, Vector3(2, 3, 0));
  f.AddCommands("footbot_wheels", 2, {robot});
  f.Command(0) = f.Command(1) = WheelSpeed(0.1);
  f.Tick();
  f.Space().SetPose(robot, {Vector3(7, 7, 0), QuaternionFromYaw(kPi / 2)});
  f.Engine().EntityMoved(robot);
  f.Ticks(10);
  EXPECT_LT((f.PoseOf(robot).position - Vector3(7, 7.1, 0)).norm(), 1e-12);
}

TEST(Kinematics2dEngine, TheSubclockDividesTheTick)
{
  EngineFixture f;
  f.Configuration().subclock = 5;
  f.Add(EntityKind::kFootbot, Vector3(2, 3, 0));
  f.Tick();
  EXPECT_EQ(f.Engine().StatusText().substr(0, 10), "5 substeps");
}

TEST(Kinematics2dEngine, ACommandThatIsNotANumberNamesTheRobot)
{
  EngineFixture f;
  const auto robot = f.Add(EntityKind::kFootbot, Vector3(2, 3, 0));
  f.AddCommands("footbot_wheels", 2, {robot});
  f.Command(0) = std::nan("");
  EXPECT_THAT(test::MessageOf<std::runtime_error>([&] { f.Tick(); }), testing::HasSubstr("'e0'"));
}

TEST(Kinematics2dEngine, ABlockThatItMovesMustBeCutByItsPlane)
{
  EngineFixture f;
  f.Add(EntityKind::kBlock, Vector3(5, 5, 1), {}, Vector3(0.5, 0.1, 0.5));
  EXPECT_THROW(f.Start(), ConfigurationError);
}

TEST(Kinematics2dEngine, TurretsTurnAndReportTheirAngle)
{
  EngineFixture f;
  const auto robot = f.Add(EntityKind::kFootbot, Vector3(2, 3, 0));
  f.AddCommands("footbot_turret", 1, {robot});
  f.Command(0) = 2;
  f.Ticks(10);
  EXPECT_NEAR(f.Space().GetEntity(robot).GetAttribute("turret_angle"), 2, 1e-14);
  f.Command(0) = 0;
  f.Tick();
  EXPECT_TRUE(f.LastUpdate().attributes.slots.empty());
}

// No command exists for it, so the engine does not look at it each tick.
TEST(Kinematics2dEngine, ATurretThatSomebodyTurnsInTheSpaceIsTurnedBack)
{
  EngineFixture f;
  const auto robot = f.Add(EntityKind::kFootbot, Vector3(2, 3, 0));
  f.AddCommands("footbot_wheels", 2, {robot});
  const auto slot = f.Space().GetEntity(robot).SlotOf("turret_angle");
  for (const double angle : {1.0, 2.0})
  {
    f.Ticks(3);
    EXPECT_TRUE(f.LastUpdate().attributes.slots.empty());
    f.Space().SetAttribute(slot, angle);
    f.Tick();
    EXPECT_EQ(f.LastUpdate().attributes.slots, std::vector<std::uint32_t>{slot});
    EXPECT_EQ(f.Space().GetEntity(robot).GetAttribute("turret_angle"), 0);
  }
}

TEST(Kinematics2dEngine, ThreadsChangeNoPoseAndNoMistake)
{
  constexpr std::uint32_t kRobots = 2500;
  const auto run = [](WorkerPool* pool, double faulty)
  {
    EngineFixture f(pool);
    std::vector<std::uint32_t> robots;
    for (std::uint32_t k = 0; k < kRobots; ++k)
      robots.push_back(f.Add(EntityKind::kFootbot, Vector3(0.4 * (k % 50), 0.4 * (k / 50), 0), {0.001 * k, 0, 0}));
    f.AddCommands("footbot_wheels", 2, robots);
    f.Start();
    std::vector<double> poses;  // poses of all ticks, since both ways are tried
    for (int tick = 0; tick < 12; ++tick)
    {
      for (std::uint32_t k = 0; k < kRobots; ++k)
      {
        f.Command(2 * k) = 1 + 0.001 * k;
        f.Command(2 * k + 1) = 2 - 0.001 * k;
      }
      if (tick == 6) f.Command(2 * 2100) = faulty;
      f.Tick();
      poses.insert(poses.end(), f.LastUpdate().poses.begin(), f.LastUpdate().poses.end());
    }
    return poses;
  };
  WorkerPool pool(3);
  EXPECT_EQ(run(&pool, 1), run(nullptr, 1));
  for (WorkerPool* by : {&pool, static_cast<WorkerPool*>(nullptr)})
  {
    EXPECT_THAT(test::MessageOf<std::runtime_error>([&] { run(by, std::numeric_limits<double>::infinity()); }),
                testing::HasSubstr("robot 'e2100' gave footbot_wheels"));
  }
}

}  // namespace
}  // namespace swarmanoid

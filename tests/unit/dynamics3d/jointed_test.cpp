// Links that joints move, against closed forms: pendulums, motors with limited speed and effort, stops, lifts. Walkers
// walk, and give the same bits after a restart and in regions and threads.
#include "test_folders.h"
#include "tests/unit/engines/jointed_robots.h"

#include "dynamics3d_test_world.h"
#include "swarm_of_rigid_bodies.h"
#include "tests/unit/engines/saved_state_bytes.h"

namespace swarmanoid
{
namespace
{

using namespace test;

constexpr double kPosition = 1, kVelocity = 2;  // modes of the channel "joints"
constexpr double kTick = 0.1;                   // s

// One robot with one joint, in the middle of the arena.
class OneJoint : public Dynamics3dTestWorld
{
public:
  explicit OneJoint(EntityKind kind) : robot_(Add(kind, {5, 5, 0}, Quaternion::Identity(), DescriptionOf(kind).size)) {}
  double Angle() { return Sensor("joints", robot_, 0); }
  double Speed() { return Sensor("joints", robot_, 1); }
  double Effort() { return Sensor("joints", robot_, 2); }
  void Order(double mode, double value) { Command("joints", robot_, {mode, value}); }
  // Sets the speed (rad/s) of the bar of BarAtTower, which hangs.
  void Push(double speed)
  {
    Start();
    const dBodyID bar = engine->WorldForTest().Body(engine->ModelForTest(robot_)->MainBody() + 1);
    dBodySetAngularVel(bar, speed, 0, 0);
    dBodySetLinearVel(bar, 0, 0.25 * speed, 0);
  }
  std::uint32_t Robot() const { return robot_; }

private:
  std::uint32_t robot_;
};

// A bar of 0.4 kg and 0.5 m at the side of a tower, on a joint about the forward axis at the bar's upper end. It hangs
// at 0.
EntityKind BarAtTower(const std::string& tag, const std::string& type, const std::string& more)
{
  const double moment = 0.4 * 0.5 * 0.5 / 12;
  return KindOfUrdf(tag, UrdfTower() + UrdfLink("bar", Inertial(0.4, moment, "0 0 -0.25")) +
                             UrdfJoint("swing", type, "tower", "bar", "0 0.3 0.3", "1 0 0", more));
}
constexpr double kMoment = 0.4 * 0.5 * 0.5 / 12 + 0.4 * 0.25 * 0.25;  // kg m², about the joint
constexpr double kWeight = 0.4 * kGravity;                            // N

TEST(JointedRobots, AFreeJointSwingsWithThePeriodOfAPendulum)
{
  OneJoint world(BarAtTower("test_pendulum", "continuous", ""));
  world.Push(0.1 * std::sqrt(kWeight * 0.25 / kMoment));  // it swings by 0.1 rad
  std::vector<double> crossings;
  double before = 0;
  for (int tick = 0; tick < 100; ++tick)
  {
    world.Tick();
    const double now = world.Angle();
    if (before < 0 && now >= 0) crossings.push_back(kTick * (tick + now / (before - now)));
    before = now;
  }
  ASSERT_GE(crossings.size(), 5U);
  const double period = (crossings.back() - crossings.front()) / static_cast<double>(crossings.size() - 1);
  const double small = 2 * kPi * std::sqrt(kMoment / (kWeight * 0.25));
  EXPECT_NEAR(period, small * (1 + 0.1 * 0.1 / 16), 0.01 * small);
}

TEST(JointedRobots, AMotorReachesItsTargetAtItsSpeedAndStopsAtItsLimit)
{
  OneJoint world(BarAtTower("test_servo", "revolute", UrdfLimit(-0.5, 1.2, 20, 1.5)));
  world.Order(kPosition, 0.9);
  for (int tick = 1; tick <= 6; ++tick)
  {
    world.Tick();
    EXPECT_LE(world.Angle(), 1.5 * kTick * tick + 1e-3) << tick;
    if (tick > 1 && tick < 6)
    {
      EXPECT_NEAR(world.Speed(), 1.5, 0.02) << tick;
    }
  }
  world.Run(5);
  EXPECT_NEAR(world.Angle(), 0.9, 2e-3);
  EXPECT_NEAR(world.Attribute(world.Robot(), "joint_swing"), world.Angle(), 1e-4);
  EXPECT_NEAR(world.Effort(), kWeight * 0.25 * Sin(0.9), 0.02) << "it bears the weight of the bar";
  world.Order(kPosition, 3);
  world.Run(10);
  EXPECT_NEAR(world.Angle(), 1.2, 2e-3);
  world.Order(kVelocity, -9);
  world.Run(20);
  EXPECT_NEAR(world.Angle(), -0.5, 2e-3);
  EXPECT_NEAR(world.Speed(), 0, 1e-3);
  world.Order(kVelocity, 0.4);
  world.Run(10);
  EXPECT_NEAR(world.Angle(), -0.5 + 0.4 * 10 * kTick, 5e-3);
  EXPECT_NEAR(world.Speed(), 0.4, 5e-3);
}

TEST(JointedRobots, AMotorHoldsALoadOrSinksByItsEffort)
{
  // The bar's weight turns it by up to m g l = 0.981 N m.
  OneJoint strong(BarAtTower("test_strong", "revolute", UrdfLimit(-2, 2, 1.1, 3)));
  OneJoint weak(BarAtTower("test_weak", "revolute", UrdfLimit(-2, 2, 0.5, 3)));
  for (OneJoint* world : {&strong, &weak})
  {
    world->Order(kPosition, kPi / 2);
    world->Run(60);
  }
  EXPECT_NEAR(strong.Angle(), kPi / 2, 5e-3);
  EXPECT_NEAR(strong.Effort(), kWeight * 0.25, 0.02);
  // The weak one swings about asin(0.5 / 0.981), where its effort bears the weight: up to 1.13, as its work allows.
  EXPECT_LT(weak.Angle(), 1.15);
  EXPECT_NEAR(std::abs(weak.Effort()), 0.5, 0.01);
}

TEST(JointedRobots, AStopHoldsAgainstALoadAndLetsTheMotorGo)
{
  // Without a motor, a bar that starts level falls to its stop at 0.4.
  OneJoint world(BarAtTower("test_stop", "revolute", UrdfLimit(0.4, 1.5, 0, 0) + "<dynamics damping='0.05'/>"));
  EXPECT_NEAR(world.Attribute(world.Robot(), "joint_swing"), 0.4, 1e-9);
  world.Run(20);
  EXPECT_NEAR(world.Angle(), 0.4, 5e-3);
  // A motor that was overpowered goes away from its stop without a jump.
  OneJoint pressed(BarAtTower("test_pressed", "revolute", UrdfLimit(0.2, 1.5, 1.2, 2)));
  pressed.Order(kVelocity, -2);
  pressed.Run(10);
  EXPECT_NEAR(pressed.Angle(), 0.2, 5e-3);
  pressed.Order(kVelocity, 0.5);
  for (int tick = 1; tick <= 10; ++tick)
  {
    pressed.Tick();
    EXPECT_NEAR(pressed.Angle(), 0.2 + 0.5 * kTick * tick, 0.01) << tick;
  }
}

TEST(JointedRobots, DampingSlowsAFreeJointExponentially)
{
  // It turns about the vertical, so gravity does nothing: w = w0 exp(-d t / I).
  const double moment = 0.02;
  const EntityKind kind =
      KindOfUrdf("test_damped", UrdfTower() + UrdfLink("wheel", Inertial(0.5, moment)) +
                                    UrdfJoint("axle", "continuous", "tower", "wheel", "0 0 0.6", "0 0 1",
                                              "<limit effort='0' velocity='0'/><dynamics damping='0.01'/>"));
  OneJoint world(kind);
  world.Tick();
  const int link = world.engine->ModelForTest(world.Robot())->MainBody() + 1;
  dBodySetAngularVel(world.engine->WorldForTest().Body(link), 0, 0, 5);
  world.Run(20);
  EXPECT_NEAR(world.Speed(), 5 * Exp(-0.01 * 2 / moment), 0.02);
}

TEST(JointedRobots, FrictionStopsAFreeJointAndHoldsIt)
{
  // Its energy lifts the bar and overcomes friction up to 0.45 rad. There the weight pulls with 0.43 N m, less than it.
  OneJoint world(BarAtTower("test_rubbing", "continuous", "<dynamics friction='0.5'/>"));
  world.Push(std::sqrt(2 * (0.5 * 0.45 + kWeight * 0.25 * (1 - Cos(0.45))) / kMoment));
  world.Run(20);
  EXPECT_NEAR(world.Angle(), 0.45, 0.01);
  EXPECT_NEAR(world.Speed(), 0, 1e-3);
}

TEST(JointedRobots, ASliderLiftsALoadIfItsEffortSuffices)
{
  const auto lift = [](const std::string& tag, double effort)
  {
    return KindOfUrdf(tag, UrdfTower() + UrdfLink("plate", Inertial(2, 0.01) + UrdfBox("0.3 0.3 0.02")) +
                               UrdfJoint("lift", "prismatic", "tower", "plate", "0 0 0.52", "0 0 1",
                                         UrdfLimit(0, 0.5, effort, 0.25)));
  };
  // Plate and load weigh 3 kg: 29.4 N.
  for (const double effort : {35.0, 25.0})
  {
    OneJoint world(lift(effort > 30 ? "test_lift" : "test_weak_lift", effort));
    const std::uint32_t load = world.AddBlock({5, 5, 1.085}, {0.1, 0.1, 0.1}, 1);
    world.Order(kPosition, 0.4);
    world.Run(10);
    // The effort that is left speeds it up first, which costs it v² / (2 a).
    const double behind = 0.25 * 0.25 / (2 * (effort / 3 - kGravity));
    EXPECT_NEAR(world.Angle(), effort > 30 ? 0.25 - behind : 0, 5e-3);
    world.Run(15);
    EXPECT_NEAR(world.Angle(), effort > 30 ? 0.4 : 0, 5e-3);
    EXPECT_NEAR(world.Position(load).z(), 1.08 + (effort > 30 ? 0.4 : 0), 6e-3);
    EXPECT_NEAR(world.Effort(), effort > 30 ? 3 * kGravity : 25, 0.3);
  }
}

TEST(JointedRobots, StandStillWithoutCommands)
{
  Dynamics3dTestWorld world;
  const std::uint32_t robot = world.Add(FourLegs(), {5, 5, 0}, QuaternionFromYaw(0.5), DescriptionOf(FourLegs()).size);
  world.Run(100);
  EXPECT_NEAR((world.Position(robot) - Vector3(5, 5, 0)).norm(), 0, 3e-3);
  EXPECT_NEAR(world.Tilt(robot), 0, 0.01);
  EXPECT_NEAR(world.Yaw(robot), 0.5, 0.01);
}

TEST(JointedRobots, OnWheelsDriveAndMoveTheirArms)
{
  Dynamics3dTestWorld world;
  const EntityKind kind = CartWithArm();
  const std::uint32_t robot = world.Add(kind, {3, 5, 0}, Quaternion::Identity(), DescriptionOf(kind).size, 3.55);
  world.Command("wheels", robot, {4, 4});
  world.Command("joints", robot, {kPosition, 0.15, kVelocity, 1, kPosition, -0.5});
  world.Run(20);
  EXPECT_NEAR(world.Position(robot).x(), 3 + 0.2 * 2, 0.05);
  EXPECT_NEAR(world.Position(robot).z(), 0, 2e-3);
  EXPECT_NEAR(world.Attribute(robot, "joint_lift"), 0.15, 3e-3);
  EXPECT_NEAR(world.Attribute(robot, "joint_shoulder"), 2, 0.03);
  EXPECT_NEAR(world.Attribute(robot, "joint_elbow"), -0.5, 5e-3);
  EXPECT_NEAR(world.Sensor("joints", robot, 0), 0.15, 3e-3);
  EXPECT_EQ(world.engine->FreeRobotCount(), 0U);
}

TEST(JointedRobots, TheirLinksTouchOtherRobots)
{
  // The arm of a cart that stands sweeps a footbot away.
  Dynamics3dTestWorld world;
  const EntityKind kind = CartWithArm();
  const std::uint32_t robot = world.Add(kind, {3, 5, 0}, Quaternion::Identity(), DescriptionOf(kind).size, 3.55);
  const std::uint32_t footbot = world.AddFootbot({3, 5.3, 0});
  world.Command("joints", robot, {0, 0, kPosition, kPi / 2 - 0.01, 0, 0});
  world.Run(3);
  EXPECT_NEAR((world.Position(footbot) - Vector3(3, 5.3, 0)).norm(), 0, 1e-3);
  world.Run(30);
  EXPECT_GT((world.Position(footbot) - Vector3(3, 5.3, 0)).norm(), 0.005);
}

// The walker of configs/hexapods.xml, with the tripod gait of user/controllers/tripod_gait: its joints follow a zigzag
// with a period of 1 s.
TEST(JointedRobots, WalkForwardOnSixLegsAndStayLevel)
{
  const std::string file = SWARMANOID_SOURCE_FOLDER "/configs/urdf/hexapod.urdf";
  if (!KindOfTag("hexapod"))
  {
    ASSERT_TRUE(RegisterUrdfKind("hexapod", file).empty());
  }
  const EntityKind kind = *KindOfTag("hexapod");
  const std::vector<MovingLink>& links = DescriptionOf(kind).links;
  ASSERT_EQ(links.size(), 12U);
  Dynamics3dTestWorld world;
  const std::uint32_t robot = world.Add(kind, {2, 5, 0}, Quaternion::Identity(), DescriptionOf(kind).size);
  constexpr double kStride = 0.25, kLift = 0.4;  // rad
  double most_tilt = 0, lowest = 1, highest = -1;
  for (int tick = 0; tick < 100; ++tick)
  {
    std::vector<double> orders;
    for (const MovingLink& link : links)
    {
      const bool is_left = link.joint.starts_with("left"), is_middle = link.joint.find("middle") != std::string::npos;
      const double at = (tick + 1) * kTick + 0.25 + (is_left == is_middle ? 0.5 : 0);
      const double phase = at - std::floor(at);
      const double along = phase < 0.5 ? 1 - 4 * phase : 4 * phase - 3;
      const double height = phase < 0.5 ? 0 : std::min(1.0, 2 * (1 - std::abs(4 * phase - 3)));
      const double target = link.joint.ends_with("swing") ? kStride * along : kLift * height;
      orders.push_back(kVelocity);
      orders.push_back((target - world.Attribute(robot, link.attribute.c_str())) / kTick);
    }
    world.Command("joints", robot, orders);
    world.Tick();
    most_tilt = std::max(most_tilt, world.Tilt(robot));
    lowest = std::min(lowest, world.Position(robot).z());
    highest = std::max(highest, world.Position(robot).z());
  }
  // A foot at rest carries the body by its way: 4 strides of 0.14 m sin(0.25) in a second.
  const double reach = 0.14;
  EXPECT_NEAR(world.Position(robot).x() - 2, 10 * 4 * reach * Sin(kStride), 0.15 * 10 * 4 * reach * Sin(kStride));
  EXPECT_NEAR(world.Position(robot).y(), 5, 0.15);
  EXPECT_NEAR(world.Yaw(robot), 0, 0.15);
  EXPECT_LT(most_tilt, 0.06);
  EXPECT_GT(lowest, -0.01);
  EXPECT_LT(highest, 0.015);
}

// Walkers, carts with arms, footbots and blocks in a crowd. All commands depend on the tick alone.
class BusyLegs : public Dynamics3dTestWorld
{
public:
  explicit BusyLegs(const char* threads = "1", unsigned regions = 0) : Dynamics3dTestWorld("threads", threads)
  {
    if (regions > 0)
    {
      team_ = std::make_unique<TeamOfDynamics3d>(regions, [this] { return MakeEngine(nullptr); });
      team = team_.get();
    }
    for (int k = 0; k < 3; ++k)
    {
      legs_.push_back(Add(FourLegs(), {4 + 0.3 * k, 5, 0}, QuaternionFromYaw(0.3 * k), DescriptionOf(FourLegs()).size));
      carts_.push_back(Add(CartWithArm(), {4 + 0.45 * k, 5.5, 0}, QuaternionFromYaw(-0.2 * k),
                           DescriptionOf(CartWithArm()).size, 3.55));
      AddFootbot({4 + 0.3 * k, 4.6, 0}, 0.4 * k);
      AddBlock({4.2 + 0.3 * k, 5.25, 0.03}, {0.06, 0.06, 0.06}, 0.1);
    }
    Add(FourLegs(), {8, 8, 0}, Quaternion::Identity(), DescriptionOf(FourLegs()).size);
  }
  ~BusyLegs()
  {
    engine.reset();
    team_.reset();
  }
  BusyLegs(const BusyLegs&) = delete;
  BusyLegs& operator=(const BusyLegs&) = delete;

  void Advance()
  {
    const auto tick = static_cast<double>(Space().GetTick());
    for (std::size_t k = 0; k < 3; ++k)
    {
      std::vector<double> orders;
      for (int joint = 0; joint < 8; ++joint)
      {
        orders.push_back(joint % 3 == 0 ? kVelocity : kPosition);
        orders.push_back(0.4 * Sin(0.5 * tick + joint + static_cast<double>(k)));
      }
      Command("joints", legs_[k], orders);
      Command("joints", carts_[k], {kPosition, 0.1, kVelocity, 1, kPosition, 0.5 * Sin(0.3 * tick)});
      Command("wheels", carts_[k], {3, 3 - static_cast<double>(k)});
    }
    Tick();
  }
  std::uint32_t Walker() const { return legs_.front(); }

private:
  std::unique_ptr<TeamOfDynamics3d> team_;
  std::vector<std::uint32_t> legs_, carts_;
};

TEST(JointedRobots, GoOnFromASavedStateAndInThreadsAndRegionsWithTheSameBits)
{
  BusyLegs whole, restarted, threads("2"), regions("1", 2);
  for (int tick = 0; tick < 24; ++tick)
  {
    if (tick % 7 == 3) restarted.ReplaceEngineBySavedState();
    whole.Advance();
    restarted.Advance();
    threads.Advance();
    regions.Advance();
    ASSERT_EQ(whole.Space().Hash(), restarted.Space().Hash()) << tick;
    ASSERT_EQ(whole.Space().Hash(), threads.Space().Hash()) << tick;
    ASSERT_EQ(whole.Space().Hash(), regions.Space().Hash()) << tick;
    for (int element = 0; element < 24; ++element)
      for (BusyLegs* world : {&restarted, &threads, &regions})
        ASSERT_EQ(whole.Sensor("joints", whole.Walker(), element), world->Sensor("joints", whole.Walker(), element));
  }
}

TEST(JointedRobots, EachByteOfTheirSavedStateIsTakenBack)
{
  OneJoint world(BarAtTower("test_saved", "revolute", UrdfLimit(-0.5, 1.2, 20, 1.5)));
  world.Order(kPosition, 0.9);
  world.Run(3);
  ByteWriter state;
  world.engine->SaveState(state);
  EXPECT_EQ(LostBytes(state.Bytes(), [&](const auto& changed) { return SavedAgain(*world.engine, changed); }),
            std::vector<std::size_t>{});
}

}  // namespace
}  // namespace swarmanoid

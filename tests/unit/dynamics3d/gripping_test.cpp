// Grippers, hands, ropes and magnets.
#include "dynamics3d_test_world.h"
#include "engine_worker/engines/dynamics3d/handbot.h"

namespace swarmanoid
{
namespace
{

using dynamics3d::FootbotShape;

// A footbot at x, y that faces a prey of 0.1 m radius at touching distance.
std::uint32_t AddPreyInFrontOf(Dynamics3dTestWorld& world, double x, double y, double mass)
{
  return world.AddPrey({x + FootbotShape::kRadius + 0.1 + 0.002, y, 0}, mass);
}

TEST(Dynamics3dGripping, AFootbotDragsAPreyAndLetsGoOfIt)
{
  Dynamics3dTestWorld world;
  const auto footbot = world.AddFootbot({2, 5, 0});
  const auto prey = AddPreyInFrontOf(world, 2, 5, 0.4);
  world.Command("footbot_gripper", footbot, {1});
  world.Tick();
  EXPECT_EQ(world.Attribute(footbot, "gripped"), 1 + prey);
  EXPECT_EQ(world.Attribute(footbot, "gripper_aperture"), 0);

  const double apart = (world.Position(prey) - world.Position(footbot)).norm();
  world.Drive(footbot, -0.1, -0.1);
  world.Run(50);
  EXPECT_NEAR(world.Position(footbot).x(), 1.5, 0.03);
  EXPECT_NEAR((world.Position(prey) - world.Position(footbot)).norm(), apart, 2e-3);
  // Dragged at constant speed, the prey pulls forward with its friction, 0.5 m g, and a little more: it is held above
  // the ground, and so is also pressed down.
  EXPECT_NEAR(world.Sensor("footbot_turret_torque", footbot, 0) * 25, 0.5 * 0.4 * 9.81, 0.8);

  world.Command("footbot_gripper", footbot, {0});
  world.Run(20);
  EXPECT_EQ(world.Attribute(footbot, "gripped"), 0);
  EXPECT_GT((world.Position(prey) - world.Position(footbot)).norm(), apart + 0.15);
}

// Gravity leans to the left, and the load does not rub on the ground: it pulls at the turret with m g_y at its distance
// from the axis, and the turret holds.
TEST(Dynamics3dGripping, TheTorqueSensorReadsTheLeverOfALoad)
{
  Dynamics3dTestWorld world("gravity", "0, 1, -9.81", "friction", "0");
  const auto footbot = world.AddFootbot({2, 5, 0});
  const double mass = 2;
  const auto prey = AddPreyInFrontOf(world, 2, 5, mass);
  world.UseTurrets();
  world.Command("footbot_gripper", footbot, {1});
  world.Run(20);
  ASSERT_EQ(world.Attribute(footbot, "gripped"), 1 + prey);
  world.Run(30);
  EXPECT_NEAR(world.Attribute(footbot, "turret_angle"), 0, 0.003) << "5 s under a quarter of what it can bear";
  // The robot itself creeps a little: the load hangs in the direction in which it is now.
  const Vector3 arm = world.Position(prey) - world.Position(footbot);
  const double bearing = Atan2(arm.y(), arm.x());
  EXPECT_NEAR(world.Sensor("footbot_turret_torque", footbot, 0) * 25, mass * Sin(bearing), 0.02 * mass);
  EXPECT_NEAR(world.Sensor("footbot_turret_torque", footbot, 1) * 25, mass * Cos(bearing), 0.02 * mass);
  EXPECT_NEAR(world.Sensor("footbot_turret_torque", footbot, 2) * 1.5, mass * arm.x(), 0.02 * mass * arm.norm());
}

TEST(Dynamics3dGripping, AnEntityThatIsPutElsewhereLeavesItsGripsAndStandsStill)
{
  Dynamics3dTestWorld world;
  const auto footbot = world.AddFootbot({2, 5, 0});
  const auto prey = AddPreyInFrontOf(world, 2, 5, 0.4);
  world.Command("footbot_gripper", footbot, {1});
  world.Run(5);
  ASSERT_EQ(world.Attribute(footbot, "gripped"), 1 + prey);
  world.Space().SetPose(prey, {Vector3(8, 8, 0), QuaternionFromYaw(1)});
  world.Space().GetEntity(footbot).SetAttribute("gripped", 0);
  world.engine->EntityMoved(prey);
  world.Run(5);
  EXPECT_EQ(world.Attribute(footbot, "gripped"), 0);
  EXPECT_LT((world.Position(prey) - Vector3(8, 8, 0)).norm(), 1e-3);
  EXPECT_LT((world.Position(footbot) - Vector3(2, 5, 0)).norm(), 2e-3);
}

TEST(Dynamics3dGripping, TheTurretTurnsWhatTheGripperHolds)
{
  Dynamics3dTestWorld world;
  const auto footbot = world.AddFootbot({5, 5, 0});
  const auto prey = AddPreyInFrontOf(world, 5, 5, 0.05);
  world.UseTurrets();
  world.Command("footbot_gripper", footbot, {1});
  world.Command("footbot_turret", footbot, {0.5});
  world.Run(20);
  EXPECT_NEAR(world.Attribute(footbot, "turret_angle"), 1, 0.05);
  const Vector3 to_prey = world.Position(prey) - world.Position(footbot);
  EXPECT_NEAR(WrapAngle(Atan2(to_prey.y(), to_prey.x()) - world.Yaw(footbot)), 1, 0.05);
}

TEST(Dynamics3dGripping, AChainOfFootbotsPullsTogether)
{
  Dynamics3dTestWorld world;
  std::vector<std::uint32_t> chain;
  const double spacing = 2 * FootbotShape::kRadius + 0.002;
  for (int k = 0; k < 4; ++k) chain.push_back(world.AddFootbot({3 - k * spacing, 5, 0}));
  for (std::size_t k = 1; k < chain.size(); ++k) world.Command("footbot_gripper", chain[k], {1});
  world.Tick();
  for (std::size_t k = 1; k < chain.size(); ++k) EXPECT_EQ(world.Attribute(chain[k], "gripped"), 1 + chain[k - 1]);
  for (const auto footbot : chain) world.Drive(footbot, 0.1, 0.1);
  world.Run(100);
  EXPECT_NEAR(world.Position(chain[0]).x(), 4, 0.03);
  for (std::size_t k = 1; k < chain.size(); ++k)
    EXPECT_NEAR((world.Position(chain[k]) - world.Position(chain[k - 1])).norm(), spacing, 1e-3);
}

TEST(Dynamics3dGripping, LoopsAreNotClosed)
{
  Dynamics3dTestWorld world;
  const double spacing = 2 * FootbotShape::kRadius + 0.002;
  const auto left = world.AddFootbot({5, 5, 0});
  const auto right = world.AddFootbot({5 + spacing, 5, 0}, kPi);
  world.Command("footbot_gripper", left, {1});
  world.Command("footbot_gripper", right, {1});
  world.Run(3);
  EXPECT_EQ(world.Attribute(left, "gripped"), 1 + right);
  EXPECT_EQ(world.Attribute(right, "gripped"), 0);
}

TEST(Dynamics3dGripping, AHandbotLiftsABookAndCarriesItUpItsRope)
{
  Dynamics3dTestWorld world("ceiling", "true");
  const auto handbot = world.AddHandbot({5, 5, 0});
  // A book of 0.4 kg on a stand, between the two hands.
  const auto book = world.AddBlock({5.27, 5, 0.1}, {0.03, 0.16, 0.2}, 0.4);
  world.Command("handbot_hands", handbot, {1, 1});
  world.Command("handbot_rope", handbot, {1, 0});
  world.Run(10);
  EXPECT_EQ(world.Attribute(handbot, "gripped", 0), 1 + book);
  EXPECT_EQ(world.Attribute(handbot, "gripped", 1), 1 + book);
  ASSERT_EQ(world.Attribute(handbot, "rope_attached"), 1);

  const Vector3 held = world.Space().GetPose(handbot).Inverse().Apply(world.Position(book));
  world.Command("handbot_rope", handbot, {1, -0.1});
  world.Run(100);
  // The robot takes in a metre of rope at 0.1 m/s.
  EXPECT_NEAR(world.Attribute(handbot, "rope_length"), 3 - 0.16 - 1, 0.01);
  EXPECT_NEAR(world.Position(handbot).z(), 1, 0.05);
  const Vector3 carried = world.Space().GetPose(handbot).Inverse().Apply(world.Position(book));
  EXPECT_LT((carried - held).norm(), 0.01);

  world.Command("handbot_hands", handbot, {0, 0});
  world.Run(20);
  EXPECT_LT(world.Position(book).z(), 0.2);
  EXPECT_GT(world.Position(handbot).z(), 0.9);
}

// Arms stay as they are, and the book in the hands; the rope stays where it was, so it ends.
TEST(Dynamics3dGripping, AHandbotThatIsMovedTakesItsBookAlong)
{
  for (const bool restored : {false, true})
  {
    Dynamics3dTestWorld world;
    const auto handbot = world.AddHandbot({5, 5, 0});
    const auto book = world.AddBlock({5.27, 5, 0.1}, {0.03, 0.16, 0.2}, 0.4);
    world.Command("handbot_hands", handbot, {1, 1});
    world.Run(10);
    ASSERT_EQ(world.Attribute(handbot, "gripped", 1), 1 + book);
    if (restored) world.ReplaceEngineBySavedState();
    const auto in_hands = [&] { return world.Space().GetPose(handbot).Inverse().Compose(world.Space().GetPose(book)); };
    const Pose before = in_hands();
    const Pose there{Vector3(2, 7, world.Position(handbot).z()), QuaternionFromYaw(3.1)};
    const std::vector<Pose> poses = world.Space().Structure().GetCompound(handbot).PosesAt(handbot, there);
    world.Space().SetPose(handbot, poses[0]);
    world.Space().SetPose(book, poses[1]);
    world.engine->EntityMoved(handbot);
    world.engine->EntityMoved(book);
    world.Tick();
    for (const int hand : {0, 1}) EXPECT_EQ(world.Attribute(handbot, "gripped", hand), 1 + book);
    EXPECT_LT((in_hands().position - before.position).norm(), 1e-3);
    EXPECT_LT((world.Position(handbot) - there.position).norm(), 1e-3);
    world.Run(30);
    EXPECT_LT((in_hands().position - before.position).norm(), 2e-3);
    EXPECT_LT((world.Position(handbot) - there.position).norm(), 2e-3);
  }
}

TEST(Dynamics3dGripping, AHandbotHangsOnAShelfByItsHandsAlone)
{
  Dynamics3dTestWorld world("ceiling", "true", "ground", "false");
  const auto handbot = world.AddHandbot({5, 5, 1});
  const auto shelf = world.AddWall({5.36, 5, 1.1}, {0.2, 1, 0.02});
  world.Command("handbot_hands", handbot, {1, 1});
  world.Run(1);
  EXPECT_EQ(world.Attribute(handbot, "gripped", 0), 1 + shelf);
  EXPECT_EQ(world.Attribute(handbot, "gripped", 1), 1 + shelf);
  world.Run(20);
  const Vector3 hanging = world.Position(handbot);
  EXPECT_NEAR(hanging.z(), 1, 0.01);
  world.Run(80);
  EXPECT_LT((world.Position(handbot) - hanging).norm(), 1e-3);
  world.Command("handbot_hands", handbot, {0, 0});
  world.Run(20);
  EXPECT_LT(world.Position(handbot).z(), -5);
}

// The head turns one hand up and the other down. A robot that holds on with the upper hand and turns its head the other
// way rises by twice the height of that hand above the head. Then it grips with the other hand, which is now up. The
// rope carries the weight, which is more than a wrist can hold.
TEST(Dynamics3dGripping, AHandbotClimbsAShelfHandOverHandOnItsRope)
{
  Dynamics3dTestWorld world("ceiling", "true");
  const auto handbot = world.AddHandbot({5, 5, 0});
  const auto shelf = world.AddWall({5.29, 5, 1}, {0.04, 0.4, 2});
  world.Start();
  const double turn = kPi / 3;  // angle of the head to each side
  const double rate = 0.5;
  const double rise = 2 * dynamics3d::HandbotShape::kShoulder * Sin(turn);
  const auto turn_head = [&](double speed, double angle)
  {
    world.Command("handbot_arms", handbot, {speed, 0, 0, -speed, -speed});
    world.Run(static_cast<int>(angle / rate * 10));
    world.Command("handbot_arms", handbot, {0, 0, 0, 0, 0});
  };
  const auto run_winch = [&](double speed) { world.Command("handbot_rope", handbot, {1, speed}); };

  run_winch(0);
  turn_head(rate, turn);
  for (int step = 0; step < 8; ++step)
  {
    const bool left = step % 2 == 0;
    world.Command("handbot_hands", handbot, {left ? 1.0 : 0.0, left ? 0.0 : 1.0});
    world.Run(3);
    ASSERT_EQ(world.Attribute(handbot, "gripped", left ? 0 : 1), 1 + shelf) << "step " << step;
    run_winch(-rise / (2 * turn / rate));
    turn_head(left ? -rate : rate, 2 * turn);
    run_winch(0);
    world.Command("handbot_hands", handbot, {1, 1});
    world.Run(3);
    for (const int hand : {0, 1}) ASSERT_EQ(world.Attribute(handbot, "gripped", hand), 1 + shelf) << "step " << step;
    EXPECT_NEAR(world.Position(handbot).z(), (step + 1) * rise, 0.02);
    EXPECT_LT(world.Tilt(handbot), DegreesToRadians(15));
  }
}

TEST(Dynamics3dGripping, ArmsHeadAndWristsMoveWithinTheirLimits)
{
  Dynamics3dTestWorld world;
  const auto handbot = world.AddHandbot({5, 5, 0});
  world.Command("handbot_arms", handbot, {0.4, 0.5, 0.25, 0.3, 0.1});
  world.Run(10);
  EXPECT_NEAR(world.Attribute(handbot, "head_angle"), 0.4, 0.02);
  EXPECT_NEAR(world.Attribute(handbot, "arm", 0), 0.5, 0.02);
  EXPECT_NEAR(world.Attribute(handbot, "arm", 1), 0.25, 0.02);
  EXPECT_NEAR(world.Attribute(handbot, "wrist", 0), 0.3, 1e-6);
  world.Run(60);
  EXPECT_NEAR(world.Attribute(handbot, "arm", 0), 1.0472, 0.02);
  EXPECT_NEAR(world.Attribute(handbot, "arm", 1), 1.0472, 0.02);
  EXPECT_NEAR(world.Attribute(handbot, "wrist", 0), kPi / 2, 1e-3);
  EXPECT_LT(world.Tilt(handbot), DegreesToRadians(3));
}

TEST(Dynamics3dGripping, ARopePullsButDoesNotPush)
{
  Dynamics3dTestWorld world("ceiling", "true");
  const auto handbot = world.AddHandbot({5, 5, 0});
  world.Command("handbot_rope", handbot, {1, 0.15});
  world.Run(20);
  // The rope is slack: the robot stands on the ground with its full weight.
  EXPECT_NEAR(world.Position(handbot).z(), 0, 2e-3);
  EXPECT_LT(world.Tilt(handbot), DegreesToRadians(1));
  EXPECT_NEAR(world.Attribute(handbot, "rope_length"), 2.84 + 0.3, 0.01);
}

TEST(Dynamics3dGripping, ARopeIsLetOutToItsLengthAndNoFurther)
{
  Dynamics3dTestWorld world("ceiling", "true");
  const auto handbot = world.AddHandbot({5, 5, 0});
  world.Command("handbot_rope", handbot, {1, 0.15});
  world.Run(200);
  EXPECT_EQ(world.Attribute(handbot, "rope_length"), 5);
}

// An arm that opens turns the robot the other way. The fans stop the turn.
TEST(Dynamics3dGripping, FansEndTheTurnsOfAHandbotOnItsRope)
{
  Dynamics3dTestWorld world("ceiling", "true");
  const auto handbot = world.AddHandbot({5, 5, 0}, 1);
  world.Command("handbot_rope", handbot, {1, -0.15});
  world.Run(20);
  const auto farthest_off = [&](int ticks)
  {
    double off = 0;
    for (int tick = 0; tick < ticks; ++tick)
    {
      world.Tick();
      off = std::max(off, std::abs(WrapAngle(world.Yaw(handbot) - 1)));
    }
    return off;
  };
  world.Command("handbot_arms", handbot, {0, 1, 0, 0, 0});
  const double turned = farthest_off(10);
  EXPECT_GT(turned, 0.01);
  world.Command("handbot_arms", handbot, {0, 0, 0, 0, 0});
  world.Run(40);
  EXPECT_LT(farthest_off(30), 0.1 * turned);
}

TEST(Dynamics3dGripping, AnEyebotAttachesToTheCeilingAndNowhereElse)
{
  Dynamics3dTestWorld world("ceiling", "true");
  const auto eyebot = world.AddEyebot({5, 5, 1});
  world.Command("eyebot_attach", eyebot, {1});
  world.Run(10);
  EXPECT_EQ(world.Attribute(eyebot, "attached"), 0);
  world.Command("eyebot_propellers", eyebot, {0, 0, 0.3, 0});
  world.Run(60);
  EXPECT_EQ(world.Attribute(eyebot, "attached"), 1);
  const Vector3 there = world.Position(eyebot);
  EXPECT_NEAR(there.z() + 0.566, 3, 0.04);
  world.Run(20);
  EXPECT_LT((world.Position(eyebot) - there).norm(), 1e-3);
  world.Command("eyebot_attach", eyebot, {0});
  world.Command("eyebot_propellers", eyebot, {0, 0, -0.3, 0});
  world.Run(30);
  EXPECT_EQ(world.Attribute(eyebot, "attached"), 0);
  EXPECT_LT(world.Position(eyebot).z(), there.z() - 0.5);
}

}  // namespace
}  // namespace swarmanoid

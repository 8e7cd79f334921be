#include "engine_worker/engines/kinematics2d/kinematic_world.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/math/elementary.h"
#include "common/math/random.h"

namespace swarmanoid::kinematics2d
{
namespace
{

constexpr double kTick = 0.1;
constexpr Bounds kArea{-2, -2, 2, 2};

CollisionModel Wall(double x, double y, double length_x, double length_y)
{
  const double dx = length_x / 2;
  const double dy = length_y / 2;
  const std::array<Vector2, 4> corners{Vector2(x + dx, y - dy), Vector2(x + dx, y + dy), Vector2(x - dx, y + dy),
                                       Vector2(x - dx, y - dy)};
  return MakeModel({}, {MakePolygon(corners)});
}

// Returns the deepest overlap of any two bodies and of any body with a wall.
double DeepestOverlap(const KinematicWorld& world)
{
  double deepest = 0;
  for (std::uint32_t a = 0; a < world.BodyCount(); ++a)
  {
    deepest = std::max(deepest, world.StaticOverlapForTest(a));
    for (std::uint32_t b = a + 1; b < world.BodyCount(); ++b) deepest = std::max(deepest, world.OverlapForTest(a, b));
  }
  return deepest;
}

TEST(KinematicWorld, HeadOnDiscsExchangeTheRestOfTheirWays)
{
  // The gap is 0.02 m. At 0.2 and 0.1 m/s they meet after 2/3 of the tick; then each has the other's velocity.
  KinematicWorld world;
  const auto disc = world.AddModel(CircleModel(0.1));
  const auto a = world.AddBody(disc, {-0.11, 0, RotorOf(0)});
  const auto b = world.AddBody(disc, {0.11, 0, RotorOf(kPi)});
  world.Start(kArea);
  world.SetTwist(a, {0.2, 0, 0});
  world.SetTwist(b, {0.1, 0, 0});
  world.Advance(kTick, 1);
  const double meets = 0.02 / 0.3;
  const double rest = kTick - meets;
  EXPECT_NEAR(world.Poses().x[a], -0.11 + 0.2 * meets - 0.1 * rest, 1e-12);
  EXPECT_NEAR(world.Poses().x[b], 0.11 - 0.1 * meets + 0.2 * rest, 1e-12);
  EXPECT_NEAR(world.Poses().y[a], 0, 1e-15);
}

TEST(KinematicWorld, WithoutElasticityDiscsStayInTouch)
{
  KinematicWorld world(0);
  const auto disc = world.AddModel(CircleModel(0.1));
  const auto a = world.AddBody(disc, {-0.105, 0, RotorOf(0)});
  const auto b = world.AddBody(disc, {0.105, 0, RotorOf(kPi)});
  world.Start(kArea);
  world.SetTwist(a, {0.2, 0, 0});
  world.SetTwist(b, {0.2, 0, 0});
  world.Advance(kTick, 1);
  EXPECT_NEAR(world.Poses().x[b] - world.Poses().x[a], 0.2, 1e-12);
  EXPECT_NEAR(world.Poses().x[b] + world.Poses().x[a], 0, 1e-15);
}

TEST(KinematicWorld, ACollisionKeepsTheSumOfAllWays)
{
  // The first-order form of momentum: pushes are equal and opposite.
  KinematicWorld world;
  const auto footbot = world.AddModel(FootbotModel());
  const auto a = world.AddBody(footbot, {0, 0, RotorOf(0.3)});
  const auto b = world.AddBody(footbot, {0.205, 0.02, RotorOf(2.9)});
  world.Start(kArea);
  const Twist twist{0.25, 0, 0.4};
  world.SetTwist(a, twist);
  world.SetTwist(b, twist);
  const Pose2 free_a = Advanced(world.PoseOf(a), twist, kTick);
  const Pose2 free_b = Advanced(world.PoseOf(b), twist, kTick);
  world.Advance(kTick, 1);
  EXPECT_GT(world.Statistics().contacts, 0U);
  EXPECT_GT(std::abs(world.Poses().x[a] - free_a.x), 1e-3);
  EXPECT_NEAR(world.Poses().x[a] + world.Poses().x[b], free_a.x + free_b.x, 1e-14);
  EXPECT_NEAR(world.Poses().y[a] + world.Poses().y[b], free_a.y + free_b.y, 1e-14);
  EXPECT_LT(DeepestOverlap(world), 4e-4);
}

TEST(KinematicWorld, AWallReflectsTheWayIntoItAndLeavesTheWayAlongIt)
{
  KinematicWorld world;
  const auto a = world.AddBody(world.AddModel(CircleModel(0.1)), {0.89, 0, RotorOf(0.5)});
  world.AddStatic(Wall(1.05, 0, 0.1, 2));
  world.Start(kArea);
  world.SetTwist(a, {0.3, 0, 0});
  world.Advance(kTick, 1);
  const double into = 0.89 + 0.03 * std::cos(0.5) - 0.9;
  EXPECT_NEAR(world.Poses().x[a], 0.9 - into, 1e-12);
  EXPECT_NEAR(world.Poses().y[a], 0.03 * std::sin(0.5), 1e-12);
}

TEST(KinematicWorld, AWallWithFrictionSlowsTheWayAlongItByItsPartOfTheWayIntoIt)
{
  for (const double elasticity : {0.0, 1.0})
    for (const double friction : {0.0, 0.07, 0.3})
      for (const double degrees : {30.0, 45.0, 75.0})
      {
        KinematicWorld world(elasticity);
        CollisionModel disc = CircleModel(0.085);
        disc.friction = 0.49;
        CollisionModel wall = Wall(0.5, 0, 1, 18);
        wall.friction = friction * friction / 0.49;
        const double angle = DegreesToRadians(degrees);  // from the wall
        world.AddBody(world.AddModel(disc), {-0.085, -5, RotorOf(kPi / 2 - angle)});
        world.AddStatic(wall);
        world.Start(kArea);
        world.SetTwist(0, {0.1, 0, 0});
        for (int tick = 0; tick < 400; ++tick) world.Advance(kTick, 1);
        // A body that bounces is free in every second step, so that friction takes at most half of its way.
        const double into = 0.1 * std::sin(angle);
        const double along = 0.1 * std::cos(angle);
        const double least = along * elasticity / 2;
        EXPECT_NEAR((world.Poses().y[0] + 5) / 40, std::max(along - friction * into, least), 2e-4)
            << elasticity << ' ' << friction << ' ' << degrees;
        EXPECT_LE(world.Poses().x[0], -0.085 + world.AllowedOverlapForTest());
      }
}

TEST(KinematicWorld, StillBodiesStayWhereTheyAreToTheLastBit)
{
  KinematicWorld world;
  const auto footbot = world.AddModel(FootbotModel());
  RandomStream random(1, 0, 0, 0);
  for (int k = 0; k < 50; ++k)
    world.AddBody(footbot, {0.21 * (k % 10), 0.21 * (k / 10), RotorOf(random.Uniform(-kPi, kPi))});
  world.Start({0, 0, 2, 2});
  world.Advance(kTick, 1);
  const PoseStore before = world.Poses();
  for (int tick = 0; tick < 100; ++tick) world.Advance(kTick, 1);
  EXPECT_EQ(before.x, world.Poses().x);
  EXPECT_EQ(before.y, world.Poses().y);
  EXPECT_EQ(before.z, world.Poses().z);
}

TEST(KinematicWorld, NothingPassesThroughThinWallsOrOthersAtTenTimesTheUsualSpeed)
{
  // At 3 m/s a robot moves 0.3 m a tick, against a sheet of 1 cm and against an oncoming robot of the same speed.
  // Ahead and sideways are the same.
  for (const bool sideways : {false, true})
    for (int start = 0; start < 20; ++start)
    {
      const double turned = sideways ? -kPi / 2 : 0;
      KinematicWorld world;
      const auto footbot = world.AddModel(FootbotModel());
      const double from = -0.5 - 0.013 * start;
      const auto a = world.AddBody(footbot, {from, 0.004 * start, RotorOf(turned)});
      const auto c = world.AddBody(footbot, {from, 1, RotorOf(turned)});
      const auto d = world.AddBody(footbot, {0.6, 1, RotorOf(kPi + turned)});
      world.AddStatic(Wall(0, 0, 0.01, 0.6));
      world.Start(kArea);
      for (const auto body : {a, c, d}) world.SetTwist(body, {sideways ? 0.0 : 3.0, sideways ? 3.0 : 0.0, 0});
      for (int tick = 0; tick < 20; ++tick)
      {
        world.Advance(kTick, 1);
        ASSERT_LT(world.Poses().x[a], 0) << start << " " << tick;
        ASSERT_LT(world.Poses().x[c], world.Poses().x[d]) << start << " " << tick;
      }
      EXPECT_GT(world.Poses().x[a], -0.3) << "it did move";
    }
}

TEST(KinematicWorld, AThousandRobotsPushedIntoACornerStayApartAndFinite)
{
  KinematicWorld world;
  const auto footbot = world.AddModel(FootbotModel());
  RandomStream random(7, 0, 0, 0);
  for (int k = 0; k < 1000; ++k)
    world.AddBody(footbot, {0.25 + 0.24 * (k % 32), 0.25 + 0.24 * (k / 32), RotorOf(random.Uniform(-kPi, kPi))});
  world.AddStatic(Wall(-0.05, 4, 0.1, 12));
  world.AddStatic(Wall(4, -0.05, 12, 0.1));
  world.Start({0, 0, 8, 8});
  for (int tick = 0; tick < 100; ++tick)
  {
    const PoseStore before = world.Poses();
    for (std::uint32_t k = 0; k < 1000; ++k)
    {
      // The robot drives at full speed towards the corner, turning a little all the time.
      const Rotor heading = world.PoseOf(k).heading;
      const double angle = AngleOf(Conjugate(heading) * RotorOf(Atan2(-world.Poses().y[k], -world.Poses().x[k])));
      world.SetTwist(k, {0.3 * Cos(angle), 0.3 * Sin(angle), random.Uniform(-1, 1)});
    }
    world.Advance(kTick, 1);
    // Energy does not grow: no body is thrown further than a collision at full speed explains. The sum of squared ways
    // is not larger than for bodies without collisions.
    double energy = 0;
    for (std::uint32_t k = 0; k < 1000; ++k)
    {
      const double dx = world.Poses().x[k] - before.x[k];
      const double dy = world.Poses().y[k] - before.y[k];
      ASSERT_LT(std::sqrt(dx * dx + dy * dy), 0.1);
      energy += dx * dx + dy * dy;
    }
    ASSERT_LE(energy, 1000 * 0.03 * 0.03 * (1 + 1e-9));
  }
  double reach = 0;
  for (std::uint32_t k = 0; k < 1000; ++k) reach = std::max(reach, world.Poses().x[k] + world.Poses().y[k]);
  EXPECT_LT(DeepestOverlap(world), 0.01 * kFootbotRadius);
  EXPECT_LT(reach, 15);
}

TEST(KinematicWorld, OverlappingBodiesPartAndThenRest)
{
  KinematicWorld world;
  const auto disc = world.AddModel(CircleModel(0.1));
  for (int k = 0; k < 8; ++k) world.AddBody(disc, {0.05 * k, 0, RotorOf(0)});
  world.AddBody(disc, {0, 0, RotorOf(0)});
  world.Start(kArea);
  for (int tick = 0; tick < 400; ++tick) world.Advance(kTick, 1);
  EXPECT_LT(DeepestOverlap(world), 1e-3);
  const PoseStore before = world.Poses();
  world.Advance(kTick, 1);
  for (std::uint32_t k = 0; k < 9; ++k) EXPECT_NEAR(world.Poses().x[k], before.x[k], 1e-4);
}

TEST(KinematicWorld, AFollowerPushesAndIsNotPushed)
{
  KinematicWorld world;
  const auto disc = world.AddModel(CircleModel(0.1));
  const auto follower = world.AddBody(disc, {0, 0, RotorOf(0)}, true);
  const auto pushed = world.AddBody(disc, {0.25, 0, RotorOf(0)});
  world.Start(kArea);
  for (int tick = 1; tick <= 20; ++tick)
  {
    world.Follow(follower, world.PoseOf(follower), {0.03 * tick, 0, RotorOf(0)}, true);
    world.Advance(kTick, 1);
    EXPECT_EQ(world.Poses().x[follower], 0.03 * tick);
    EXPECT_GT(world.Poses().x[pushed] - world.Poses().x[follower], 0.2 - 1e-4);
  }
  // A body that is lifted out of the plane touches no other body.
  const double before = world.Poses().x[pushed];
  world.Follow(follower, world.PoseOf(follower), {before, 0, RotorOf(0)}, false);
  world.Advance(kTick, 1);
  EXPECT_EQ(world.Poses().x[pushed], before);
}

TEST(KinematicWorld, MoreStepsATickGiveTheSameFreeMotion)
{
  KinematicWorld one, ten;
  for (KinematicWorld* world : {&one, &ten})
  {
    world->AddBody(world->AddModel(FootbotModel()), {0, 0, RotorOf(0)});
    world->Start(kArea);
    world->SetTwist(0, {0.3, 0, 4});
  }
  one.Advance(kTick, 1);
  ten.Advance(kTick, 10);
  EXPECT_EQ(ten.Statistics().substeps, 10);
  EXPECT_NEAR(one.Poses().x[0], ten.Poses().x[0], 1e-15);
  EXPECT_NEAR(one.Poses().z[0], ten.Poses().z[0], 1e-15);
}

TEST(KinematicWorld, ASpeedBeyondAllSenseIsRefused)
{
  KinematicWorld world;
  world.AddBody(world.AddModel(FootbotModel()), {0, 0, RotorOf(0)});
  world.Start(kArea);
  world.SetTwist(0, {1e6, 0, 0});
  EXPECT_THROW(world.Advance(kTick, 1), std::runtime_error);
}

// There are 3,600 robots, a prey that two of them grip, and a follower, all driven into a corner. `now_and_then`:
// threads that share some of the ticks.
KinematicWorld CornerPile(unsigned threads, WorkerPool* now_and_then = nullptr)
{
  KinematicWorld world;
  const auto footbot = world.AddModel(FootbotModel());
  RandomStream random(9, 0, 0, 0);
  for (int k = 0; k < 3600; ++k)
    world.AddBody(footbot, {0.2 + 0.21 * (k % 60), 0.2 + 0.21 * (k / 60), RotorOf(random.Uniform(-kPi, kPi))});
  const auto prey = world.AddBody(world.AddModel(CircleModel(0.1)), {13.2, 6, RotorOf(0)});
  const auto left = world.AddBody(footbot, {13.2, 6.21, RotorOf(0)});
  const auto right = world.AddBody(footbot, {13.2, 5.79, RotorOf(0)});
  const auto follower = world.AddBody(footbot, {13.2, 8, RotorOf(0)}, true);
  world.AddStatic(Wall(-0.05, 7, 0.1, 16));
  world.AddStatic(Wall(7, -0.05, 16, 0.1));
  world.KeepTravel();
  world.Start({0, 0, 14, 14}, threads, now_and_then);
  world.AddGrip(left, prey);
  world.AddGrip(right, prey);
  for (int tick = 0; tick < 40; ++tick)
  {
    for (std::uint32_t k = 0; k < world.BodyCount(); ++k)
    {
      const double heading = AngleOf(world.PoseOf(k).heading);
      const double turn = WrapAngle(-0.75 * kPi - heading);
      world.SetTwist(k, {0.25, 0, 2 * turn});
      world.SetTurretRate(k, 0.1 * (k % 7));
    }
    world.Follow(follower, world.PoseOf(follower), {13.2 - 0.02 * tick, 8, RotorOf(0)}, true);
    if (now_and_then != nullptr) now_and_then->Share(tick % 3 == 1);
    world.Advance(kTick, 1);
  }
  return world;
}

TEST(KinematicWorld, ThreadsChangeNoBit)
{
  const KinematicWorld one = CornerPile(1);
  EXPECT_GT(one.Statistics().contacts, 3000U) << "enough for all threads";
  EXPECT_GT(one.Statistics().held_back, 0U);
  WorkerPool three(3);
  for (const unsigned threads : {2U, 3U, 4U})
  {
    const KinematicWorld several = CornerPile(threads, threads == 3 ? &three : nullptr);
    ByteWriter expected, state;
    one.SaveState(expected);
    several.SaveState(state);
    EXPECT_EQ(expected.Bytes(), state.Bytes()) << threads;
    EXPECT_EQ(one.Statistics().contacts, several.Statistics().contacts);
    for (std::uint32_t k = 0; k < one.BodyCount(); ++k)
    {
      ASSERT_EQ(one.TravelForward(k), several.TravelForward(k)) << k;
      ASSERT_EQ(one.TravelTurn(k), several.TravelTurn(k)) << k;
    }
  }
}

TEST(KinematicWorld, WhoIsNotPresentTouchesNobody)
{
  KinematicWorld world;
  const auto disc = world.AddModel(CircleModel(0.1));
  const auto a = world.AddBody(disc, {-0.15, 0, RotorOf(0)});
  const auto b = world.AddBody(disc, {0.15, 0, RotorOf(0)});
  world.Start(kArea);
  world.SetPresent(b, false);
  world.SetTwist(a, {0.3, 0, 0});
  for (int tick = 0; tick < 10; ++tick) world.Advance(kTick, 1);
  EXPECT_NEAR(world.Poses().x[a], 0.15, 1e-9) << "it drives through the place of the other one";
  EXPECT_EQ(world.Poses().x[b], 0.15);
  world.SetTwist(a, {0, 0, 0});
  world.SetPresent(b, true);
  for (int tick = 0; tick < 100; ++tick) world.Advance(kTick, 1);
  EXPECT_LT(DeepestOverlap(world), 1e-3) << "they part when it has come back";
}

}  // namespace
}  // namespace swarmanoid::kinematics2d

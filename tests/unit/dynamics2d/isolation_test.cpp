// Bodies that meet nobody within a tick are left out of the solver: who they are, and that it makes no difference.
#include "engine_worker/engines/dynamics2d/isolation.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "common/math/random.h"
#include "dynamics2d_test_world.h"

namespace swarmanoid
{
namespace
{

using dynamics2d::Isolation;
using dynamics2d::MovingCircle;
using dynamics2d::MovingOutline;
using dynamics2d::Nearness;
using dynamics2d::StaticOutline;

// The distance of a point from a square, by another way than the product's: in the frame of the square.
double DistanceFromSquare(const Vector2& middle, double half, double angle, const Vector2& point)
{
  const Vector2 offset = point - middle;
  const double x = std::abs(std::cos(angle) * offset.x() + std::sin(angle) * offset.y()) - half;
  const double y = std::abs(std::cos(angle) * offset.y() - std::sin(angle) * offset.x()) - half;
  return x > 0 && y > 0 ? std::sqrt(x * x + y * y) : std::max(x, y);
}

TEST(Isolation, IsWhatComparingEachWithEachFinds)
{
  int count[3] = {};
  for (std::uint32_t trial = 0; trial < 1000; ++trial)
  {
    RandomStream random(5, trial, 0, 0);
    const double size = random.Uniform(1, 12);
    const auto bodies = static_cast<std::size_t>(random.Uniform(1, 80));
    std::vector<MovingOutline> outlines(bodies);
    const bool has_large = random.Uniform(0, 1) < 0.5;
    for (MovingOutline& outline : outlines)
    {
      MovingCircle& whole = outline.whole;
      whole = {random.Uniform(0, size), random.Uniform(0, size), random.Uniform(0.05, 0.12), random.Uniform(0, 0.1)};
      if (has_large && random.Uniform(0, 1) < 0.1) whole.radius = random.Uniform(0.5, 1.5);
      outline.present = random.Uniform(0, 1) < 0.9;
      outline.part_count = random.Uniform(0, 1) < 0.5 ? 2 : 0;
    }
    struct Square
    {
      Vector2 middle;
      double half, angle;
    };
    std::vector<Square> squares;
    std::vector<StaticOutline> statics;
    for (int i = 0; i < 5; ++i)
    {
      const Square& square = squares.emplace_back(
          Square{{random.Uniform(0, size), random.Uniform(0, size)}, random.Uniform(0.02, 1), random.Uniform(-3, 3)});
      StaticOutline& outline = statics.emplace_back();
      for (int corner = 0; corner < 4; ++corner)
      {
        const double at = square.angle + kPi / 4 + corner * kPi / 2;
        outline.corners.emplace_back(square.middle +
                                     std::sqrt(2.0) * square.half * Vector2(std::cos(at), std::sin(at)));
      }
    }
    const MovingCircle pillar{random.Uniform(0, size), random.Uniform(0, size), 0.3, 0};
    statics.push_back({{{pillar.x, pillar.y}}, pillar.radius});

    Isolation isolation;
    isolation.Configure(outlines, statics, 0.1);
    // Elsewhere than they were when the cells were made, also outside of all cells.
    for (MovingOutline& outline : outlines)
    {
      MovingCircle& whole = outline.whole;
      whole.x += random.Uniform(-1, 1);
      whole.y += random.Uniform(-1, 1);
      // Parts that stay inside.
      const double angle = random.Uniform(-3, 3);
      const double inner = 0.7 * whole.radius;
      outline.parts = {
          {{whole.x, whole.y, inner, whole.way / 2},
           {whole.x + inner * std::cos(angle), whole.y + inner * std::sin(angle), whole.radius - inner, whole.way}}};
    }
    const double margin = random.Uniform(0, 0.05);
    std::vector<Nearness> found;
    isolation.Find(outlines, margin, found);
    for (std::size_t a = 0; a < bodies; ++a)
    {
      if (!outlines[a].present) continue;
      double gap = 1e9;
      for (const MovingCircle& part : outlines[a].Parts())
      {
        const auto note = [&](double distance) { gap = std::min(gap, distance - part.radius - part.way); };
        note(std::hypot(pillar.x - part.x, pillar.y - part.y) - pillar.radius);
        for (const Square& square : squares)
          note(DistanceFromSquare(square.middle, square.half, square.angle, {part.x, part.y}));
        for (std::size_t b = 0; b < bodies; ++b)
          if (b != a && outlines[b].present)
            for (const MovingCircle& other : outlines[b].Parts())
              note(std::hypot(other.x - part.x, other.y - part.y) - other.radius - other.way);
      }
      if (std::min(std::abs(gap - margin), std::abs(gap - margin - Isolation::kBand)) < 1e-9) continue;
      const Nearness expected = gap < margin                      ? Nearness::kNear
                                : gap < margin + Isolation::kBand ? Nearness::kClose
                                                                  : Nearness::kFar;
      ASSERT_EQ(found[a], expected) << "trial " << trial << ", body " << a << ", gap " << gap;
      ++count[static_cast<int>(expected)];
    }
  }
  EXPECT_GT(*std::ranges::min_element(count), 100) << "all three occur";
}

TEST(Isolation, NobodyIsFarWhereSomebodyIsTooFast)
{
  std::vector<MovingOutline> outlines(2);
  outlines[0].whole = {0, 0, 0.1, 0};
  outlines[1].whole = {50, 0, 0.1, 0.3};
  Isolation isolation;
  isolation.Configure(outlines, {}, 0.1);
  std::vector<Nearness> found;
  isolation.Find(outlines, 0.02, found);
  EXPECT_EQ(found[0], Nearness::kNear);
  outlines[1].whole.way = 0.1;
  isolation.Find(outlines, 0.02, found);
  EXPECT_EQ(found[0], Nearness::kFar);
}

// Two worlds that differ only in somebody far away who is so fast that the solver moves everybody.
class Pair
{
public:
  explicit Pair(const std::function<void(Dynamics2dTestWorld&)>& add)
  {
    for (const bool fast : {false, true})
    {
      Dynamics2dTestWorld& world = fast ? solved : isolated;
      world.Set("ground_friction", "0.3");
      add(world);
      const auto far_away = world.AddPrey(-80, 80, 1);
      world.AddCommands("footbot_wheels", 2);
      world.AddCommands("footbot_turret", 1);
      world.AddSensors("footbot_encoders", 2);
      world.AddSensors("footbot_accelerometer", 3);
      world.Start();
      keep_fast_ = [this, far_away] { solved.engine->SetVelocity(far_away, {0, 3, 0}); };
    }
  }
  void Tick()
  {
    keep_fast_();
    isolated.Tick();
    solved.Tick();
  }

  Dynamics2dTestWorld isolated, solved;

private:
  std::function<void()> keep_fast_;
};

TEST(Dynamics2d, AnIsolatedRobotAndItsTurretMoveAsTheSolverWouldMoveThem)
{
  std::uint32_t robot = 0;
  Pair worlds([&](Dynamics2dTestWorld& world) { robot = world.AddFootbot(2, 2, 0.4); });
  RandomStream random(9, 0, 0, 0);
  for (int tick = 0; tick < 400; ++tick)
  {
    // Also harder than its wheels can follow within a tick.
    if (tick % 10 == 0)
    {
      const double left = random.Uniform(-0.8, 0.8);
      const double right = random.Uniform(-0.8, 0.8);
      for (Dynamics2dTestWorld* world : {&worlds.isolated, &worlds.solved})
      {
        world->Drive(robot, left, right);
        world->Command("footbot_turret", robot, {left});
      }
    }
    worlds.Tick();
    ASSERT_NE(worlds.isolated.engine->StatusText().find(", 2 of 2 bodies isolated"), std::string::npos);
    ASSERT_NE(worlds.solved.engine->StatusText().find(", 0 of 2 bodies isolated"), std::string::npos);
    EXPECT_LT((worlds.isolated.Position(robot) - worlds.solved.Position(robot)).norm(), 2e-5) << tick;
    EXPECT_NEAR(WrapAngle(worlds.isolated.Yaw(robot) - worlds.solved.Yaw(robot)), 0, 2e-5) << tick;
    EXPECT_EQ(worlds.isolated.Attribute(robot, "turret_angle"), worlds.solved.Attribute(robot, "turret_angle")) << tick;
    for (int i = 0; i < 2; ++i)
      EXPECT_NEAR(worlds.isolated.Sensor("footbot_encoders", robot, i),
                  worlds.solved.Sensor("footbot_encoders", robot, i), 1e-6);
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(worlds.isolated.Sensor("footbot_accelerometer", robot, i),
                  worlds.solved.Sensor("footbot_accelerometer", robot, i), 1e-4);
  }
}

TEST(Dynamics2d, AnIsolatedPreySlidesAndSpinsAsTheSolverWouldHaveIt)
{
  std::uint32_t prey = 0;
  Pair worlds([&](Dynamics2dTestWorld& world) { prey = world.AddPrey(2, 2, 1.5); });
  for (Dynamics2dTestWorld* world : {&worlds.isolated, &worlds.solved})
    world->engine->SetVelocity(prey, {0.8, -0.3, 6});
  for (int tick = 0; tick < 30; ++tick)
  {
    worlds.Tick();
    EXPECT_LT((worlds.isolated.Position(prey) - worlds.solved.Position(prey)).norm(), 1e-6) << tick;
    EXPECT_NEAR(WrapAngle(worlds.isolated.Yaw(prey) - worlds.solved.Yaw(prey)), 0, 1e-6) << tick;
  }
  EXPECT_GT((worlds.isolated.Position(prey) - Vector3(2, 2, 0)).norm(), 0.1);
}

// A prey that nobody could reach by itself within the tick is hit by one that was hit.
TEST(Dynamics2d, WhoIsPushedFarWithinATickMeetsThoseWhoWereIsolated)
{
  Dynamics2dTestWorld world;
  world.Set("restitution", "1");
  world.Set("ground_friction", "0");
  const auto heavy = world.AddPrey(1, 1, 50);
  const auto light = world.AddPrey(1.205, 1, 0.1);
  const auto third = world.AddPrey(1.46, 1, 0.1);
  world.Start();
  world.engine->SetVelocity(heavy, {0.9, 0, 0});
  world.Tick();
  // The first hits the second, which goes twice as fast and meets the third within the tick.
  EXPECT_GT(world.Position(third).x() - world.Position(light).x(), 0.2 - 0.05);
  world.Run(2);
  EXPECT_GT(world.Position(third).x(), 1.5);
  EXPECT_GT(world.Position(third).x() - world.Position(light).x(), 0.2 - 2e-3);
}

TEST(Dynamics2d, AnIsolatedRobotGripsWhatIsPutBeforeIt)
{
  Dynamics2dTestWorld world;
  const auto robot = world.AddFootbot(2, 2);
  const auto prey = world.AddPrey(5, 5, 1);
  world.AddCommands("footbot_wheels", 2);
  world.AddCommands("footbot_gripper", 1);
  world.Start();
  world.Command("footbot_gripper", robot, {1});
  world.Run(3);
  EXPECT_EQ(world.Attribute(robot, "gripped"), 0);
  world.Space().SetPose(prey, {Vector3(2.202, 2, 0), Quaternion::Identity()});
  world.engine->EntityMoved(prey);
  world.Tick();
  EXPECT_EQ(world.Attribute(robot, "gripped"), 1.0 + prey);
}

// Robots that become isolated and meet again, among walls and a mirror: a restored world has the same bits.
TEST(Dynamics2d, ARestoredEngineContinuesWithTheSameBitsWithIsolatedBodies)
{
  const auto make = [](Dynamics2dTestWorld& world, std::uint32_t& mirror)
  {
    for (int i = 0; i < 25; ++i) world.AddFootbot(1 + 0.6 * (i % 5), 1 + 0.6 * (i / 5), 0.7 * i);
    for (int i = 0; i < 4; ++i) world.AddPrey(1.3 + 0.6 * i, 1.3, 0.5, 0.08);
    mirror = world.AddFootbot(0.5, 0.5);
    world.MakeMirror(mirror);
    world.AddWall({4, 2, 0.2}, {0.1, 4, 0.4}, 0.1);
    world.AddWall({0.5, 2, 0.2}, {0.1, 4, 0.4}, -0.1);
    world.AddCommands("footbot_wheels", 2);
    world.Start();
  };
  const auto step = [](Dynamics2dTestWorld& world, std::uint32_t mirror)
  {
    const std::uint64_t tick = world.Space().GetTick();
    for (std::uint32_t robot = 0; robot < 25; ++robot)
    {
      RandomStream random(3, robot, 0, static_cast<std::uint32_t>(tick / 15));
      world.Drive(robot, random.Uniform(-0.1, 0.3), random.Uniform(-0.1, 0.3));
    }
    const double along = 0.01 * static_cast<double>(tick);
    world.Space().SetPose(mirror, {Vector3(0.8 + along, 0.8 + along, 0), QuaternionFromYaw(along)});
    world.Tick();
  };
  Dynamics2dTestWorld continuing, restored;
  std::uint32_t mirror = 0;
  make(continuing, mirror);
  make(restored, mirror);
  std::vector<std::string> seen;
  for (int tick = 0; tick < 150; ++tick)
  {
    if (tick % 25 == 0)
    {
      continuing.engine->Canonicalise();
      restored.Space().SetTick(continuing.Space().GetTick());
      for (std::uint32_t i = 0; i < continuing.Space().Size(); ++i)
        restored.Space().SetPose(i, continuing.Space().GetPose(i));
      ByteWriter state;
      continuing.engine->SaveState(state);
      restored.engine = restored.MakeEngine();
      ByteReader reader(state.Bytes());
      restored.engine->LoadState(reader);
    }
    step(continuing, mirror);
    step(restored, mirror);
    ASSERT_EQ(continuing.Space().Hash(), restored.Space().Hash()) << tick;
    const std::string text = continuing.engine->StatusText();
    if (std::ranges::find(seen, text) == seen.end()) seen.push_back(text);
  }
  EXPECT_GT(seen.size(), 10U) << "bodies change sides";
}

}  // namespace
}  // namespace swarmanoid

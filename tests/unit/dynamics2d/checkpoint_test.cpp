// A checkpoint is exact: the run that stopped and continued has the same bits as the one that never did.
#include <cmath>

#include "common/math/random.h"
#include "dynamics2d_test_world.h"

namespace swarmanoid
{
namespace
{

// Thirty robots are in a small pen with preys, a wall and a mirror; they drive, grip, turn turrets and let go.
class Crowd : public Dynamics2dTestWorld
{
public:
  explicit Crowd(std::uint64_t seed) : seed_(seed)
  {
    for (int i = 0; i < 30; ++i) robots_.push_back(AddFootbot(1 + 0.23 * (i % 6), 1 + 0.23 * (i / 6), 0.7 * i));
    for (int i = 0; i < 6; ++i) AddPrey(1 + 0.23 * i, 2.2, 0.5 + 0.3 * i, 0.08);
    mirror_ = AddFootbot(0.5, 0.5);
    MakeMirror(mirror_);
    AddWall({2.6, 1.5, 0.2}, {0.1, 3, 0.4}, 0.1);
    AddWall({0.7, 2.4, 0.2}, {0.1, 3, 0.4}, -0.2);
    UseTurrets();
    Start();
  }

  // Commands are a function of the tick, as a controller host would send them again.
  void Step()
  {
    const std::uint64_t tick = Space().GetTick();
    for (const auto robot : robots_)
    {
      RandomStream random(seed_, robot, 0, static_cast<std::uint32_t>(tick / 7));
      Drive(robot, random.Uniform(-0.1, 0.3), random.Uniform(-0.1, 0.3));
      Command("footbot_gripper", robot, {random.Uniform(0, 1) < 0.7 ? 1.0 : 0.0});
      Command("footbot_turret", robot, {random.Uniform(0, 1) < 0.5 ? 0.0 : random.Uniform(-2, 2)});
    }
    const double along = 0.01 * static_cast<double>(tick);
    Space().SetPose(mirror_, {Vector3(0.5 + along, 0.5 + along, 0), QuaternionFromYaw(along)});
    Tick();
  }
  int Grips()
  {
    int count = 0;
    for (const auto robot : robots_) count += Attribute(robot, "gripped") > 0 ? 1 : 0;
    return count;
  }
  std::vector<char> Saved() const
  {
    ByteWriter state;
    engine->SaveState(state);
    return state.Bytes();
  }

private:
  std::uint64_t seed_;
  std::vector<std::uint32_t> robots_;
  std::uint32_t mirror_ = 0;
};

TEST(Dynamics2d, ARestoredEngineContinuesWithTheSameBitsWithGripsAndContacts)
{
  RandomStream random(3, 0, 0, 0);
  int most_grips = 0;
  for (int trial = 0; trial < 12; ++trial)
  {
    const auto seed = static_cast<std::uint64_t>(trial);
    Crowd continuing(seed);
    const int before = 1 + static_cast<int>(random.Uniform(0, 60));
    for (int i = 0; i < before; ++i) continuing.Step();
    most_grips = std::max(most_grips, continuing.Grips());
    continuing.engine->Canonicalise();
    const std::vector<char> saved = continuing.Saved();

    Crowd restored(seed);
    restored.Space().SetTick(continuing.Space().GetTick());
    for (std::uint32_t i = 0; i < continuing.Space().Size(); ++i)
      restored.Space().SetPose(i, continuing.Space().GetPose(i));
    for (std::uint32_t slot = 0; slot < continuing.Space().Attributes().size(); ++slot)
      restored.Space().SetAttribute(slot, continuing.Space().Attributes()[slot]);
    ByteReader reader(saved);
    restored.engine->LoadState(reader);
    EXPECT_TRUE(reader.AtEnd());
    EXPECT_EQ(restored.Saved(), saved);

    const int after = 1 + static_cast<int>(random.Uniform(0, 40));
    for (int i = 0; i < after; ++i)
    {
      continuing.Step();
      restored.Step();
      ASSERT_EQ(continuing.Space().Hash(), restored.Space().Hash())
          << "trial " << trial << ", tick " << before << " + " << i;
    }
    EXPECT_EQ(continuing.Saved(), restored.Saved());
  }
  EXPECT_GE(most_grips, 5) << "the crowd grips";
}

TEST(Dynamics2d, TwoRunsHaveTheSameBits)
{
  Crowd a(1);
  Crowd b(1);
  for (int i = 0; i < 60; ++i)
  {
    a.Step();
    b.Step();
  }
  EXPECT_EQ(a.Space().Hash(), b.Space().Hash());
  EXPECT_EQ(a.Saved(), b.Saved());
}

TEST(Dynamics2d, CanonicaliseMovesNothing)
{
  Crowd crowd(2);
  for (int i = 0; i < 40; ++i) crowd.Step();
  crowd.engine->Canonicalise();
  const std::vector<char> once = crowd.Saved();
  crowd.engine->Canonicalise();
  EXPECT_EQ(crowd.Saved(), once);
}

TEST(Dynamics2d, AStateOfAnotherExperimentIsRefused)
{
  Crowd crowd(1);
  Dynamics2dTestWorld other;
  other.AddFootbot(1, 1);
  other.Start();
  const std::vector<char> saved = crowd.Saved();
  ByteReader reader(saved);
  EXPECT_THROW(other.engine->LoadState(reader), std::runtime_error);
}

TEST(Dynamics2d, SpinningForeverKeepsItsPrecision)
{
  Dynamics2dTestWorld world;
  const auto robot = world.AddFootbot(1, 1);
  world.Drive(robot, -0.3, 0.3);
  world.Run(2);
  for (int i = 0; i < 100; ++i)
  {
    world.Run(100);
    world.engine->Canonicalise();
  }
  const double before = world.Yaw(robot);
  world.Run(1);
  EXPECT_NEAR(WrapAngle(world.Yaw(robot) - before), 0.6 / 0.14 * 0.1, 1e-4);
}

}  // namespace
}  // namespace swarmanoid

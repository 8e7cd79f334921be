// A fresh engine continues from a saved state with the same bits.
#include <cstring>

#include "common/math/random.h"
#include "dynamics3d_test_world.h"
#include "tests/unit/engines/saved_state_bytes.h"

namespace swarmanoid
{
namespace
{

// Footbots that grip, drag and release preys and each other, a handbot with book and rope, an eyebot, and blocks to
// bump into. All commands depend on seed and tick alone.
class BusyWorld : public Dynamics3dTestWorld
{
public:
  explicit BusyWorld(std::uint64_t seed, const char* iterations = "8", int footbots = 9) : seed_(seed)
  {
    Set("ceiling", "true");
    Set("arena_walls", "true");
    Set("iterations", iterations);
    experiment.arena_size = {3, 3, 3};
    for (int k = 0; k < footbots; ++k)
      footbots_.push_back(AddFootbot({0.5 + 0.25 * (k % 3), 0.5 + 0.25 * (k / 3), 0}, 0.7 * k));
    for (int k = 0; k < 3; ++k) AddPrey({0.63 + 0.25 * k, 1.3, 0}, 0.3, 0.08);
    AddBlock({1.75, 0.7, 0.05}, {0.1, 0.1, 0.1}, 0.2);
    AddWall({1.0, 1.6, 0.2}, {1, 0.1, 0.4});
    handbot_ = AddHandbot({2, 2, 0});
    for (const double z : {0.05, 0.15}) AddBlock({0.2, 2.8, z}, {0.1, 0.1, 0.1}, 0.2);
    AddBlock({2.27, 2, 0.1}, {0.03, 0.16, 0.2}, 0.4);
    eyebot_ = AddEyebot({2, 0.8, 1});
    mirror_ = AddFootbot({1.5, 0.75, 0});
    MakeMirror(mirror_);
    UseTurrets();
    Start();
  }

  void Advance()
  {
    const auto tick = static_cast<std::uint32_t>(Space().GetTick());
    for (const auto footbot : footbots_)
    {
      RandomStream random(seed_, footbot, 0, tick / 4);
      Drive(footbot, random.Uniform(-0.3, 0.3), random.Uniform(-0.3, 0.3));
      Command("footbot_gripper", footbot, {random.Uniform() < 0.7 ? 1.0 : 0.0});
      Command("footbot_turret", footbot, {random.Uniform(-1, 1)});
    }
    RandomStream random(seed_, handbot_, 0, tick / 20);
    Command("handbot_hands", handbot_, {random.Uniform() < 0.8 ? 1.0 : 0.0, 1});
    Command("handbot_rope", handbot_, {random.Uniform() < 0.9 ? 1.0 : 0.0, random.Uniform(-0.15, 0.1)});
    Command("handbot_arms", handbot_,
            {random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1), 0});
    Command("eyebot_propellers", eyebot_, {0.1, 0.05, tick > 40 ? 0.5 : 0.1, 0.3});
    Command("eyebot_attach", eyebot_, {tick % 100 < 80 ? 1.0 : 0.0});
    Tick();
    // Another engine drives it to and fro through the crowd.
    const double x = 1.5 - 0.01 * (tick % 200 < 100 ? tick % 100 : 100 - tick % 100);
    Space().SetPose(mirror_, {Vector3(x, 1.2 - 0.3 * x, 0), QuaternionFromYaw(0.1 * tick)});
  }

  std::uint32_t Mirror() const { return mirror_; }
  int Grips()
  {
    int grips = 0;
    for (const auto footbot : footbots_) grips += Attribute(footbot, "gripped") != 0;
    return grips;
  }

private:
  std::uint64_t seed_;
  std::vector<std::uint32_t> footbots_;
  std::uint32_t handbot_ = 0;
  std::uint32_t eyebot_ = 0;
  std::uint32_t mirror_ = 0;
};

std::vector<std::uint64_t> HashesOfRun(std::uint64_t seed, int ticks, const std::vector<int>& restarts,
                                       const char* iterations = "8")
{
  BusyWorld world(seed, iterations);
  std::vector<std::uint64_t> hashes;
  int grips = 0;
  int sleepers = 0;
  for (int tick = 0; tick < ticks; ++tick)
  {
    if (std::find(restarts.begin(), restarts.end(), tick) != restarts.end()) world.ReplaceEngineBySavedState();
    world.Advance();
    grips += world.Grips();
    sleepers += world.engine->WorldForTest().SleeperCount() > 0 ? 1 : 0;
    hashes.push_back(world.Space().Hash());
  }
  EXPECT_GT(grips, ticks / 2) << "the run was to have grips";
  EXPECT_GT(sleepers, ticks / 4) << "the run was to have objects at rest";
  return hashes;
}

TEST(Dynamics3dCheckpoint, ARestoredRunHasTheSameHashAtEveryTick)
{
  for (const std::uint64_t seed : {1U, 2U, 3U})
  {
    RandomStream random(seed, 0, 1, 0);
    std::vector<int> restarts;
    for (int k = 0; k < 12; ++k) restarts.push_back(static_cast<int>(random.Below(120)));
    EXPECT_EQ(HashesOfRun(seed, 120, {}), HashesOfRun(seed, 120, restarts));
  }
}

// The fans keep the heading at which the rope was shot: it is none that a fresh engine would keep.
TEST(Dynamics3dCheckpoint, AHandbotOnItsRopeKeepsItsHeadingWhenRestored)
{
  const auto hashes = [](bool restarts)
  {
    Dynamics3dTestWorld world("ceiling", "true");
    const auto handbot = world.AddHandbot({5, 5, 0}, 1);
    world.Command("handbot_rope", handbot, {1, -0.15});
    std::vector<std::uint64_t> found;
    for (int tick = 0; tick < 40; ++tick)
    {
      if (restarts && tick == 10) world.ReplaceEngineBySavedState();
      world.Tick();
      found.push_back(world.Space().Hash());
    }
    EXPECT_GT(world.Position(handbot).z(), 0.4);
    EXPECT_NEAR(world.Yaw(handbot), 1, 0.01);
    return found;
  };
  EXPECT_EQ(hashes(true), hashes(false));
}

// Tests every field of a checkpoint, including those that keep their start values in most runs.
TEST(Dynamics3dCheckpoint, EachByteOfASavedStateIsTakenBack)
{
  BusyWorld world(1, "8", 2);
  for (int tick = 0; tick < 60; ++tick) world.Advance();
  world.engine->Canonicalise();
  ByteWriter state;
  world.engine->SaveState(state);
  EXPECT_EQ(LostBytes(state.Bytes(), [&](const auto& changed) { return SavedAgain(*world.engine, changed); }),
            std::vector<std::size_t>{});
}

TEST(Dynamics3dCheckpoint, ManyIterationsAreRepeatableToo)
{
  EXPECT_EQ(HashesOfRun(4, 60, {}, "20"), HashesOfRun(4, 60, {7, 21, 22, 40}, "20"));
}

TEST(Dynamics3dCheckpoint, SavingAndLoadingIntoARunningEngineChangesNothing)
{
  BusyWorld world(5);
  for (int tick = 0; tick < 40; ++tick) world.Advance();
  ByteWriter before;
  world.engine->SaveState(before);
  ByteReader reader(before.Bytes());
  world.engine->LoadState(reader);
  world.engine->Canonicalise();
  ByteWriter after;
  world.engine->SaveState(after);
  EXPECT_EQ(before.Bytes(), after.Bytes());
}

// Driving, gripping, climbing and bumping for 100,000 steps of the solver: nothing leaves the walls, sinks or is flung.
TEST(Dynamics3dStability, ABusyWorldKeepsItsBoundsFor100000Steps)
{
  BusyWorld world(6, "8", 3);
  std::vector<Vector3> before;
  for (std::size_t k = 0; k < world.Space().Size(); ++k) before.push_back(world.Space().GetPose(k).position);
  double travelled = 0;
  for (int tick = 0; tick < 5000; ++tick)
  {
    world.Advance();
    for (std::uint32_t k = 0; k < world.Space().Size(); ++k)
    {
      if (!world.Space().GetEntity(k).IsMovable() || k == world.Mirror()) continue;
      const Vector3 p = world.Position(k);
      const double way = (p - before[k]).head<2>().norm();  // a released body falls as fast as gravity allows
      ASSERT_LT(way, 0.4) << "e" << k << " at tick " << tick;
      ASSERT_GT(p.z(), -0.02) << "e" << k << " at tick " << tick;
      ASSERT_LT(p.z(), 3) << "e" << k << " at tick " << tick;
      for (const int axis : {0, 1})
      {
        ASSERT_GT(p[axis], 0) << "e" << k << " at tick " << tick;
        ASSERT_LT(p[axis], 3) << "e" << k << " at tick " << tick;
      }
      travelled += way;
      before[k] = p;
    }
  }
  EXPECT_GT(travelled, 100) << "metres, of all";
}

TEST(Dynamics3dCheckpoint, AStateOfAnotherExperimentIsRefused)
{
  BusyWorld busy(1);
  ByteWriter state;
  busy.engine->SaveState(state);
  Dynamics3dTestWorld other;
  other.AddFootbot({1, 1, 0});
  other.Start();
  ByteReader reader(state.Bytes());
  EXPECT_THROW(other.engine->LoadState(reader), std::runtime_error);
}

}  // namespace
}  // namespace swarmanoid

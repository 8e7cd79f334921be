// Contact groups are solved by themselves: threads and other groups change no bit, and bodies of two groups that come
// together within a tick meet.
#include "engine_worker/engines/dynamics3d/ode_world.h"
#include "engine_worker/engines/dynamics3d/shuffle.h"
#include "swarm_of_rigid_bodies.h"

namespace swarmanoid
{
namespace
{

TEST(Dynamics3dGroups, AnyNumberOfThreadsGivesTheSameBits)
{
  struct Case
  {
    double pitch;
    Ground ground;
    const char* iterations;
  };
  for (const Case& scene :
       {Case{0.18, Ground::kPlane, "8"}, Case{0.3, Ground::kPlane, "8"}, Case{0.6, Ground::kPlane, "8"},
        Case{0.3, Ground::kPlane, "20"}, Case{0.4, Ground::kHills, "8"}, Case{0.4, Ground::kCells, "8"}})
  {
    RigidSwarm one("1", scene.pitch, scene.ground, scene.iterations);
    RigidSwarm two("2", scene.pitch, scene.ground, scene.iterations);
    RigidSwarm three("3", scene.pitch, scene.ground, scene.iterations);
    std::size_t most_groups = 0;
    for (int tick = 0; tick < 16; ++tick)
    {
      for (RigidSwarm* swarm : {&one, &two, &three}) swarm->Step();
      ASSERT_EQ(one.Space().Hash(), two.Space().Hash()) << scene.pitch << ", tick " << tick;
      ASSERT_EQ(one.Space().Hash(), three.Space().Hash()) << scene.pitch << ", tick " << tick;
      ASSERT_EQ(one.engine->StatusText(), three.engine->StatusText());
      most_groups = std::max(most_groups, one.engine->GroupCount());
    }
    EXPECT_EQ(one.Saved(), two.Saved());
    EXPECT_EQ(one.Saved(), three.Saved());
    EXPECT_GT(most_groups, 2U);
  }
}

// The bodies beside a wall have the same poses, bit by bit, whatever happens 20 m away: there others push, and a block
// is so fast that its steps are cut. The numbers of all bodies differ, and so do those of the worlds.
TEST(Dynamics3dGroups, AGroupMovesTheSameWhateverOtherGroupsDo)
{
  for (const char* solve_all : {"false", "true"})
  {
    // Faster bodies than 2 m/s end all free motion.
    const double speed = std::string(solve_all) == "true" ? 20 : 1.9;
    const auto make = [&](Dynamics3dTestWorld& world, int others)
    {
      world.experiment.arena_size = {60, 60, 3};
      for (int i = 0; i < others; ++i) world.AddFootbot({25 + 0.2 * (i % 5), 25 + 0.2 * (i / 5), 0}, i);
      std::vector<std::uint32_t> group;
      for (int i = 0; i < 12; ++i)
        group.push_back(world.AddFootbot({1 + 0.22 * (i % 4), 1 + 0.22 * (i / 4), 0}, 0.7 * i));
      group.push_back(world.AddPrey({1.1, 1.9, 0}, 1, 0.08));
      group.push_back(world.AddBlock({1.6, 1.9, 0.1}, {0.2, 0.1, 0.2}, 1));
      world.AddWall({1, 0.8, 0.2}, {3, 0.1, 0.4}, 0.02);
      if (others > 0) world.AddWall({30, 25, 0.5}, {0.01, 2, 1});
      const auto fast = others > 0 ? world.AddBlock({29.7, 25, 0.5}, {0.1, 0.1, 0.1}, 0.3) : 0;
      world.UseTurrets();
      world.Start();
      if (others > 0)
        dBodySetLinearVel(world.engine->WorldForTest().Body(world.engine->ModelForTest(fast)->MainBody()), speed, 0, 0);
      return group;
    };
    Dynamics3dTestWorld alone("solve_all", solve_all), among_others("solve_all", solve_all);
    const std::vector<std::uint32_t> group = make(alone, 0);
    const std::vector<std::uint32_t> same = make(among_others, 20);
    for (std::uint64_t tick = 0; tick < 100; ++tick)
    {
      for (std::size_t i = 0; i < 12; ++i)
      {
        DriveAtRandom(alone, group[i], i, tick);
        DriveAtRandom(among_others, same[i], i, tick);
      }
      for (std::uint32_t other = 0; other < 20; ++other) DriveAtRandom(among_others, other, 100 + other, tick);
      alone.Tick();
      among_others.Tick();
      if (tick == 0 && speed > 2)
      {
        EXPECT_EQ(alone.engine->MostParts(), 1);
        EXPECT_GT(among_others.engine->MostParts(), 1);
      }
      for (std::size_t i = 0; i < group.size(); ++i)
      {
        ASSERT_EQ(alone.Position(group[i]), among_others.Position(same[i])) << "body " << i << ", tick " << tick;
        ASSERT_EQ(alone.Orientation(group[i]).coeffs(), among_others.Orientation(same[i]).coeffs());
      }
    }
  }
}

// A heavy prey hits a light one, which leaves its group much faster than either went and meets a second group.
TEST(Dynamics3dGroups, ABodyThatIsPushedOutOfItsGroupMeetsAnotherGroup)
{
  Dynamics3dTestWorld world("restitution", "1", "friction", "0");
  const auto heavy = world.AddPrey({1, 1, 0}, 50);
  const auto light = world.AddPrey({1.205, 1, 0}, 0.1);
  const auto third = world.AddPrey({1.48, 1, 0}, 0.1);
  const auto beside_third = world.AddPrey({1.48, 1.205, 0}, 0.1);
  world.Start();
  world.Tick();
  EXPECT_EQ(world.engine->GroupCount(), 2U);
  dBodySetLinearVel(world.engine->WorldForTest().Body(world.engine->ModelForTest(heavy)->MainBody()), 0.9, 0, 0);
  world.Run(3);
  EXPECT_GT(world.Position(third).x(), 1.5);
  EXPECT_GT(world.Position(third).x() - world.Position(light).x(), 0.2 - 2e-3);
  EXPECT_NEAR(world.Position(beside_third).x(), 1.48, 0.05);
}

TEST(Dynamics3dGroups, AloneMeansNoGroup)
{
  Dynamics3dTestWorld empty("threads", "3");
  empty.Start();
  empty.Run(3);
  EXPECT_EQ(empty.engine->GroupCount(), 0U);

  Dynamics3dTestWorld one("threads", "3");
  const auto robot = one.AddFootbot({1, 1, 0});
  one.AddWall({1.2, 1, 0.2}, {0.1, 1, 0.4});
  one.Drive(robot, 0.3, 0.3);
  one.Run(20);
  EXPECT_EQ(one.engine->GroupCount(), 0U);
  EXPECT_NEAR(one.Position(robot).x(), 1.15 - 0.085, 2e-3);
}

TEST(Dynamics3dGroups, EachThreadHasItsOwnOrderOfConstraints)
{
  dynamics3d::InitialiseOde();
  EXPECT_TRUE(dynamics3d::IsShuffleOurs());
}

}  // namespace
}  // namespace swarmanoid

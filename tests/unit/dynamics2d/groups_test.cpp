// Contact groups are solved by themselves: threads and other groups change no bit, and bodies of two groups that come
// together within a tick meet.
#include <cmath>

#include "swarm.h"

namespace swarmanoid
{
namespace
{

TEST(Dynamics2d, AnyNumberOfThreadsGivesTheSameBits)
{
  for (const double pitch : {0.22, 0.3, 0.5})
  {
    Swarm one("1", pitch);
    Swarm two("2", pitch);
    Swarm three("3", pitch);
    for (int tick = 0; tick < 130; ++tick)
    {
      for (Swarm* swarm : {&one, &two, &three}) swarm->Step();
      ASSERT_EQ(one.Space().Hash(), two.Space().Hash()) << pitch << ", tick " << tick;
      ASSERT_EQ(one.Space().Hash(), three.Space().Hash()) << pitch << ", tick " << tick;
      ASSERT_EQ(one.engine->StatusText(), three.engine->StatusText());
    }
    EXPECT_EQ(one.Saved(), two.Saved());
    EXPECT_EQ(one.Saved(), three.Saved());
  }
}

// Enough robots for all parts of a tick to be shared.
TEST(Dynamics2d, ThreadsShareALargeSparseSwarmWithTheSameBits)
{
  const auto make = [](Dynamics2dTestWorld& world)
  {
    world.experiment.arena_size = {40, 40, 3};
    for (int i = 0; i < 400; ++i) world.AddFootbot(1 + 0.4 * (i % 20), 1 + 0.4 * (i / 20), 0.7 * i);
    world.Start();
  };
  Dynamics2dTestWorld one("threads", "1");
  Dynamics2dTestWorld three("threads", "3");
  make(one);
  make(three);
  for (std::uint32_t tick = 0; tick < 60; ++tick)
  {
    for (Dynamics2dTestWorld* world : {&one, &three})
    {
      for (std::uint32_t robot = 0; robot < 400; ++robot) DriveAtRandom(*world, robot, robot, tick, false);
      world->Tick();
    }
    ASSERT_EQ(one.Space().Hash(), three.Space().Hash()) << tick;
  }
}

// The group beside a wall has the same poses, bit by bit, whatever happens 20 m away.
TEST(Dynamics2d, AGroupMovesTheSameWhateverOtherGroupsDo)
{
  const auto make = [](Dynamics2dTestWorld& world, int others)
  {
    world.experiment.arena_size = {60, 60, 3};
    std::vector<std::uint32_t> group;
    for (int i = 0; i < 12; ++i) group.push_back(world.AddFootbot(1 + 0.22 * (i % 4), 1 + 0.22 * (i / 4), 0.7 * i));
    group.push_back(world.AddPrey(1.1, 1.9, 1, 0.08));
    group.push_back(world.AddBlock({1.6, 1.9, 0.1}, {0.2, 0.1, 0.2}, 1));
    world.AddWall({1, 0.8, 0.2}, {3, 0.1, 0.4}, 0.02);
    for (int i = 0; i < others; ++i) world.AddFootbot(25 + 0.2 * (i % 5), 25 + 0.2 * (i / 5), i);
    if (others > 0) world.AddWall({25, 24.8, 0.2}, {3, 0.1, 0.4}, 0.02);
    world.UseTurrets();
    world.Start();
    return group;
  };
  Dynamics2dTestWorld alone, among_others;
  const std::vector<std::uint32_t> group = make(alone, 0);
  const std::vector<std::uint32_t> same = make(among_others, 20);
  for (int tick = 0; tick < 150; ++tick)
  {
    for (std::size_t i = 0; i < 12; ++i)
    {
      DriveAtRandom(alone, group[i], i, static_cast<std::uint64_t>(tick));
      DriveAtRandom(among_others, same[i], i, static_cast<std::uint64_t>(tick));
    }
    for (std::uint32_t other = 0; other < 20; ++other)
      DriveAtRandom(among_others, static_cast<std::uint32_t>(same.size()) + 1 + other, 100 + other,
                    static_cast<std::uint64_t>(tick));
    alone.Tick();
    among_others.Tick();
    for (std::size_t i = 0; i < group.size(); ++i)
    {
      ASSERT_EQ(alone.Position(group[i]), among_others.Position(same[i])) << "body " << i << ", tick " << tick;
      ASSERT_EQ(alone.Orientation(group[i]).coeffs(), among_others.Orientation(same[i]).coeffs());
    }
  }
}

// A heavy prey hits a light one, which leaves its group much faster than either went and meets a second group.
TEST(Dynamics2d, ABodyThatIsPushedOutOfItsGroupMeetsAnotherGroup)
{
  Dynamics2dTestWorld world("restitution", "1", "ground_friction", "0");
  const auto heavy = world.AddPrey(1, 1, 50);
  const auto light = world.AddPrey(1.205, 1, 0.1);
  const auto third = world.AddPrey(1.46, 1, 0.1);
  const auto beside_third = world.AddPrey(1.46, 1.205, 0.1);
  world.Start();
  world.engine->SetVelocity(heavy, {0.9, 0, 0});
  world.Tick();
  EXPECT_GT(world.Position(third).x() - world.Position(light).x(), 0.2 - 0.05);
  world.Run(2);
  EXPECT_GT(world.Position(third).x(), 1.5);
  EXPECT_GT(world.Position(third).x() - world.Position(light).x(), 0.2 - 2e-3);
  EXPECT_NEAR(world.Position(beside_third).x(), 1.46, 0.05);
}

// Ten robots pull a prey. Robots that pass make members of the group come and go at nearly every tick; the grips keep
// what the solver remembers about them.
TEST(Dynamics2d, AChainThatPullsIsNotShakenByRobotsThatPass)
{
  const auto pull = [](bool passers)
  {
    Dynamics2dTestWorld world;
    std::vector<std::uint32_t> chain;
    for (int i = 0; i < 10; ++i) chain.push_back(world.AddFootbot(3 - 0.187 * i, 3, kPi));
    const auto prey = world.AddPrey(3.203, 3, 12, 0.1);
    std::vector<std::uint32_t> passing;
    for (int i = 0; passers && i < 24; ++i)
      passing.push_back(world.AddFootbot(0.2 + 0.25 * (i % 12), i < 12 ? 2.78 : 3.22));
    for (const std::uint32_t robot : chain) world.Command("footbot_gripper", robot, {1});
    for (const std::uint32_t robot : passing) world.Drive(robot, 0.3, 0.3);
    static_cast<void>(prey);
    world.Run(2);
    double widest = 0;
    for (int tick = 0; tick < 60; ++tick)
    {
      for (const std::uint32_t robot : chain) world.Drive(robot, 0.1, 0.1);
      world.Tick();
      for (std::size_t i = 1; i < chain.size(); ++i)
        widest = std::max(widest, std::abs((world.Position(chain[i]) - world.Position(chain[i - 1])).norm() - 0.187));
    }
    return widest;
  };
  const double undisturbed = pull(false);
  const double disturbed = pull(true);
  EXPECT_LT(undisturbed, 1e-3);
  EXPECT_LT(disturbed, 1.1 * undisturbed + 1e-5);
}

// A handbot's hold is a joint of the group, and a restored engine has it.
TEST(Dynamics2d, ARestoredEngineStillHasWhatAHandbotHolds)
{
  const auto make = [](Dynamics2dTestWorld& world)
  {
    const auto handbot = world.Add(EntityKind::kHandbot, {2, 2, 0}, Quaternion::Identity(), {0.2, 0.3, 0.4});
    world.EngineTestWorld::AddPrey({2.05 + 0.256, 2 + 0.05, 0.0}, 0.3, 0.05, 0.3);
    const auto robot = world.AddFootbot(2.6, 2.05, kPi);
    world.Start();
    world.Command("handbot_hands", handbot, {1, 1});
    world.Drive(robot, 0.2, 0.2);
    return handbot;
  };
  Dynamics2dTestWorld continuing, restored;
  const auto handbot = make(continuing);
  make(restored);
  continuing.Run(20);
  ASSERT_GT(continuing.Attribute(handbot, "gripped", 0) + continuing.Attribute(handbot, "gripped", 1), 0);
  continuing.engine->Canonicalise();
  ByteWriter state;
  continuing.engine->SaveState(state);
  restored.Space().SetTick(continuing.Space().GetTick());
  for (std::uint32_t i = 0; i < continuing.Space().Size(); ++i)
    restored.Space().SetPose(i, continuing.Space().GetPose(i));
  for (std::uint32_t slot = 0; slot < continuing.Space().Attributes().size(); ++slot)
    restored.Space().SetAttribute(slot, continuing.Space().Attributes()[slot]);
  ByteReader reader(state.Bytes());
  restored.engine->LoadState(reader);
  for (int tick = 0; tick < 40; ++tick)
  {
    continuing.Tick();
    restored.Tick();
    ASSERT_EQ(continuing.Space().Hash(), restored.Space().Hash()) << tick;
  }
}

}  // namespace
}  // namespace swarmanoid

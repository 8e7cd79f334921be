// A plane that is cut into regions goes as the whole plane does, bit by bit, wherever the cuts are.
#include <gtest/gtest.h>

#include "tests/unit/kinematics2d/region_story.h"
#include "tests/world/message_of.h"

namespace swarmanoid::kinematics2d
{
namespace
{

void ExpectSame(const Scene& scene, const Story& story, unsigned regions, const Cuts& cuts)
{
  const Outcome outcome = Retell(scene, story, regions, cuts);
  EXPECT_EQ(outcome.error, "");
  EXPECT_EQ(outcome.differences, 0U) << outcome.first;
}

// Columns of blocks from left to right, in about equal numbers.
std::vector<std::uint8_t> Strips(unsigned regions, std::uint32_t columns, std::uint32_t blocks)
{
  std::vector<std::uint8_t> cut(blocks);
  for (std::uint32_t k = 0; k < blocks; ++k) cut[k] = static_cast<std::uint8_t>(k % columns * regions / columns);
  return cut;
}

std::vector<std::uint8_t> Quadrants(std::uint32_t columns, std::uint32_t blocks)
{
  const std::uint32_t rows = blocks / columns;
  std::vector<std::uint8_t> cut(blocks);
  for (std::uint32_t k = 0; k < blocks; ++k)
    cut[k] = static_cast<std::uint8_t>((k / columns * 2 / rows) * 2 + k % columns * 2 / columns);
  return cut;
}

// Each block may belong to any region.
std::vector<std::uint8_t> Scattered(unsigned regions, std::uint32_t blocks, std::uint64_t seed)
{
  RandomStream random(seed, 5, 0, 0);
  std::vector<std::uint8_t> cut(blocks);
  for (std::uint8_t& region : cut) region = static_cast<std::uint8_t>(random.Uniform(0, regions));
  return cut;
}

TEST(KinematicRegions, ACrowdWithGripsMirrorsAndWallsGoesAsInOneWorldWhereverItIsCut)
{
  const Scene scene;
  const Story story = Tell(scene, 0, 150);
  EXPECT_GT(story.most_grips, 20U);
  EXPECT_GT(story.most.substeps, 1);
  EXPECT_GT(story.most.held_back, 5U);
  ExpectSame(scene, story, 1, [](auto, auto blocks, auto) { return std::vector<std::uint8_t>(blocks, 0); });
  ExpectSame(scene, story, 2, [](auto columns, auto blocks, auto) { return Strips(2, columns, blocks); });
  ExpectSame(scene, story, 4, [](auto columns, auto blocks, auto) { return Quadrants(columns, blocks); });
  ExpectSame(scene, story, 3, [](auto, auto blocks, auto) { return Scattered(3, blocks, 7); });
}

TEST(KinematicRegions, CutsMayMoveWhileACrowdIsPacked)
{
  Scene scene;
  scene.side = 12;
  scene.density = 20;
  scene.seed = 2;
  // The world starts from a saved state, as a replacement of a worker does.
  const Story story = Tell(scene, 30, 60);
  EXPECT_GT(story.most.held_back, 100U);
  const auto slide = [](auto columns, auto blocks, std::uint64_t tick)
  {
    std::vector<std::uint8_t> cut(blocks);
    for (std::uint32_t k = 0; k < blocks; ++k) cut[k] = k % columns < tick / 10 % (columns + 1) ? 0 : 1;
    return cut;
  };
  ExpectSame(scene, story, 2, slide);
  ExpectSame(scene, story, 4, [](auto, auto blocks, auto tick) { return Scattered(4, blocks, tick / 5); });
}

TEST(KinematicRegions, RandomWorldsGoAsInOneWhereverTheCutsJumpInEachTick)
{
  for (std::uint64_t seed = 10; seed < 16; ++seed)
  {
    SCOPED_TRACE(seed);
    RandomStream random(seed, 6, 0, 0);
    Scene scene;
    scene.seed = seed;
    scene.side = random.Uniform(6, 11);
    scene.density = random.Uniform(4, 20);
    scene.speed = random.Uniform(0.05, 1);
    scene.has_grips = seed % 2 == 0;
    scene.has_followers = seed % 3 != 0;
    const auto regions = static_cast<unsigned>(random.Uniform(2, 6));
    ExpectSame(scene, Tell(scene, 0, 40), regions,
               [&](auto, auto blocks, auto tick) { return Scattered(regions, blocks, seed + tick); });
  }
}

// Regions hold a body for long, and meanwhile other regions push, limit and compute it.
TEST(KinematicRegions, RandomWorldsGoAsInOneWhereCutsStay)
{
  for (std::uint64_t seed = 20; seed < 28; ++seed)
  {
    SCOPED_TRACE(seed);
    RandomStream random(seed, 8, 0, 0);
    Scene scene;
    scene.seed = seed;
    scene.side = random.Uniform(6, 11);
    scene.density = random.Uniform(1, 20);
    scene.speed = random.Uniform(0.02, 1);
    scene.has_grips = seed % 4 == 0;
    scene.has_followers = seed % 3 == 0;
    scene.has_large = seed % 2 == 0;
    scene.has_changes = seed % 8 < 5;
    const auto regions = static_cast<unsigned>(random.Uniform(2, 6));
    ExpectSame(scene, Tell(scene, 0, 80), regions,
               [&](auto, auto blocks, auto) { return Scattered(regions, blocks, seed); });
  }
}

TEST(KinematicRegions, ARegionHoldsItsBodiesAndAFewCellsAroundThem)
{
  Scene scene;
  scene.density = 6;
  scene.has_grips = false;
  const Story story = Tell(scene, 0, 20);
  const Cuts quadrants = [](auto columns, auto blocks, auto) { return Quadrants(columns, blocks); };
  const Outcome one = Retell(scene, story, 4, quadrants, 1);
  EXPECT_EQ(one.differences, 0U) << one.first;
  EXPECT_LT(one.most_held, scene.Bodies() * 45 / 100) << "of the largest quadrant";
  // More than needed changes nothing.
  const Outcome two = Retell(scene, story, 4, quadrants, 2);
  EXPECT_EQ(two.differences, 0U) << two.first;
  EXPECT_GT(two.most_held, one.most_held);
  EXPECT_LT(two.most_held, scene.Bodies() * 60 / 100);
  // Less is not enough.
  const Outcome none = Retell(scene, story, 4, quadrants, 0);
  EXPECT_TRUE(none.differences > 0 || !none.error.empty());
}

TEST(KinematicRegions, CutsThatAreNoneAreRefused)
{
  const auto refusal = [](const Cuts& cuts)
  {
    Scene scene;
    scene.side = 8;
    return Retell(scene, Tell(scene, 0, 1), 2, cuts).error;
  };
  EXPECT_NE(refusal([](auto, auto blocks, auto) { return std::vector<std::uint8_t>(blocks, 2); })
                .find("there is no region 2"),
            std::string::npos);
  EXPECT_NE(refusal([](auto, auto blocks, auto) { return std::vector<std::uint8_t>(blocks + 1, 0); })
                .find("there must be a region for each of its"),
            std::string::npos);
}

TEST(KinematicRegions, AnotherOneMayTakeThePlaceOfARegionAtAnyTick)
{
  Scene scene;
  scene.side = 9;
  scene.density = 12;
  scene.seed = 3;
  const Story story = Tell(scene, 20, 40);
  EXPECT_GT(story.most_grips, 5U);
  const Outcome outcome = Retell(
      scene, story, 3, [](auto, auto blocks, auto tick) { return Scattered(3, blocks, tick / 7); }, 1,
      [](std::uint64_t tick) { return tick % 3 == 1 ? std::optional(static_cast<unsigned>(tick % 3)) : std::nullopt; });
  EXPECT_EQ(outcome.error, "");
  EXPECT_EQ(outcome.differences, 0U) << outcome.first;
}

// The walls are as many as in the map of a building, more than fit a message of a task.
TEST(KinematicRegions, AnyNumberOfWallsIsToldPieceByPiece)
{
  Scene scene;
  scene.side = 20;
  scene.density = 1;
  scene.has_grips = scene.has_followers = scene.has_large = false;
  const auto build = [&]
  {
    return Build(scene,
                 [](KinematicWorld& world)
                 {
                   for (int k = 0; k < 4000; ++k)
                   {
                     const double x = 0.3 * (k % 64) - 9.5;
                     const double y = 0.3 * (k / 64) - 9.5;
                     world.AddStatic(Box(x, y, x + 0.02, y + 0.02));
                   }
                 });
  };
  KinematicWorld one = build();
  KinematicWorld split = build();
  HubTeam team(3);
  split.Split(team);
  split.MoveCuts(Strips(3, split.BlockColumns(), split.BlockCount()));
  // The region is replaced after a part of its state was sent.
  team.ReplaceAt(3, 1);
  for (std::uint64_t tick = 0; tick < 20; ++tick)
  {
    for (KinematicWorld* world : {&one, &split})
    {
      for (std::uint32_t body = 0; body < scene.Bodies(); ++body) Command(scene, *world, body, tick);
      world->Advance(kTick, 1);
    }
    for (std::uint32_t body = 0; body < scene.Bodies(); ++body)
      ASSERT_TRUE(SameBits(one.PoseOf(body).x, split.PoseOf(body).x) &&
                  SameBits(one.PoseOf(body).y, split.PoseOf(body).y))
          << body << " at tick " << tick;
  }
  EXPECT_GE(team.Works(), 20U + 5) << "it has all gone into one message";
  EXPECT_GT(one.Statistics().contacts, 10U);
}

TEST(KinematicRegions, ASpeedBeyondAllSenseIsRefusedAsInOneWorld)
{
  Scene scene;
  const auto refusal = [](KinematicWorld& world) -> std::string
  {
    world.SetTwist(0, {1e6, 0, 0});
    return test::MessageOf<std::runtime_error>([&] { world.Advance(kTick, 1); });
  };
  KinematicWorld one = Build(scene);
  KinematicWorld split = Build(scene);
  HubTeam team(2);
  split.Split(team);
  split.MoveCuts(Strips(2, split.BlockColumns(), split.BlockCount()));
  EXPECT_EQ(refusal(split), refusal(one));
  EXPECT_NE(refusal(one).find("is told to move 100000"), std::string::npos);
}

TEST(KinematicRegions, WhatIsNoTaskIsRefused)
{
  Scene scene;
  scene.side = 4;
  HubTeam team(1);
  KinematicWorld split = Build(scene);
  split.Split(team);
  split.Advance(kTick, 1);
  std::vector<std::vector<char>> results(1);
  const auto refused = [&](const std::function<void(ByteWriter&)>& write)
  {
    try
    {
      team.Work(
          false, [&](bool, std::span<ByteWriter> tasks) { write(tasks[0]); }, results, [] {});
      return false;
    }
    catch (const std::runtime_error&)
    {
      return true;
    }
  };
  EXPECT_TRUE(refused([](ByteWriter&) {}));
  EXPECT_TRUE(refused(
      [](ByteWriter& noise)
      {
        for (int k = 0; k < 100; ++k) noise.Put<std::uint64_t>(~0ULL - static_cast<unsigned>(k));
      }));
  // The regions have no plan.
  team.Replace(0);
  EXPECT_TRUE(refused([](ByteWriter& task) { task.Put(std::uint64_t{0}); }));
}

}  // namespace
}  // namespace swarmanoid::kinematics2d

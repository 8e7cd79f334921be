// The list gives the pairs that a search at each step finds, in its order.
#include "engine_worker/engines/kinematics2d/verlet_list.h"

#include <gtest/gtest.h>

#include <random>

namespace swarmanoid::kinematics2d
{
namespace
{

constexpr double kMargin = 0.02;
constexpr double kLargestMargin = 0.1;

struct Swarm
{
  explicit Swarm(std::size_t count, double side) : count_(count)
  {
    std::uniform_real_distribution<double> anywhere(0.0, side);
    std::uniform_real_distribution<double> direction(-1, 1);
    poses.Resize(PaddedCount(count));
    for (std::size_t k = 0; k < count; ++k)
    {
      radii.push_back(k % 3 == 0 ? 0.085 : 0.06);
      poses.x[k] = anywhere(random);
      poses.y[k] = anywhere(random);
      direction_x.push_back(direction(random));
      direction_y.push_back(direction(random));
    }
    present.assign(count, 1);
    const Bounds area{0, 0, side, side};
    const std::vector<Bounds> walls{
        {0, 0, side, 0.02}, {0, 0, 0.02, side}, {side / 2, side / 3, side / 2 + 0.3, side / 2}};
    for (BroadPhase* broad : {&searched, &listed})
    {
      broad->Configure(PlaneGrid::For(area, radii, kLargestMargin), radii);
      broad->SetStatics(walls);
    }
  }

  // Each goes straight on, by up to `way` along both axes.
  void Drift(double way)
  {
    for (std::size_t k = 0; k < count_; ++k)
    {
      poses.x[k] += way * direction_x[k];
      poses.y[k] += way * direction_y[k];
    }
  }

  PairList Search(double margin)
  {
    searched.Sort(poses, present);
    PairList found;
    searched.FindPairs(margin, searched.Blocks(), found);
    return found;
  }

  // Whether the list was used; then it must agree.
  bool Compare(VerletList& list, WorkerPool* pool, double margin = kMargin)
  {
    if (!list.Update(listed, listed.Blocks(), poses, present, margin, pool)) return false;
    PairList found;
    list.TakePairs(listed.Blocks(), found);
    const PairList expected = Search(margin);
    EXPECT_EQ(found.ends, expected.ends);
    EXPECT_EQ(found.pairs.size(), expected.pairs.size());
    pairs += found.pairs.size();
    for (std::size_t n = 0; n < std::min(found.pairs.size(), expected.pairs.size()); ++n)
    {
      EXPECT_EQ(found.pairs[n].first, expected.pairs[n].first) << n;
      EXPECT_EQ(found.pairs[n].second, expected.pairs[n].second) << n;
    }
    return true;
  }

  std::mt19937_64 random{7};
  std::size_t count_;
  std::vector<double> radii, direction_x, direction_y;
  PoseStore poses;
  std::vector<std::uint8_t> present;
  BroadPhase searched, listed;
  std::size_t pairs = 0;
};

TEST(VerletList, GivesThePairsOfASearchInItsOrder)
{
  for (const unsigned threads : {1U, 2U, 3U})
    for (const double side : {30.0, 9.0})
    {
      Swarm swarm(1500, side);
      WorkerPool pool(threads);
      VerletList list;
      list.Configure(pool.Parts());
      for (int step = 0; step < 60 && !testing::Test::HasFailure(); ++step)
      {
        // Alone, or with threads, as the process chooses.
        EXPECT_TRUE(swarm.Compare(list, step % 5 == 0 || threads == 1 ? nullptr : &pool));
        swarm.Drift(0.006);
      }
      EXPECT_GT(swarm.pairs, 1000U);
    }
}

TEST(VerletList, SeesWhoIsPutElsewhereComesAndGoes)
{
  Swarm swarm(400, 8);
  VerletList list;
  list.Configure(1);
  for (int step = 0; step < 120 && !testing::Test::HasFailure(); ++step)
  {
    if (step % 10 == 4) swarm.poses.x[static_cast<std::size_t>(step)] = swarm.poses.x[7] + 0.05;
    if (step % 10 == 9) swarm.present[static_cast<std::size_t>(step)] ^= 1;
    EXPECT_TRUE(swarm.Compare(list, nullptr)) << step;
    swarm.Drift(0.002);
  }
}

// A margin that grows with the speed may be more than what the list has left.
TEST(VerletList, FollowsTheMargin)
{
  Swarm swarm(2000, 9);
  VerletList list;
  list.Configure(1);
  for (int step = 0; step < 40 && !testing::Test::HasFailure(); ++step)
  {
    EXPECT_TRUE(swarm.Compare(list, nullptr, step % 7 == 6 ? 0.98 * kLargestMargin : kMargin)) << step;
    swarm.Drift(0.0005);
  }
  EXPECT_FALSE(swarm.Compare(list, nullptr, 1.01 * kLargestMargin));
}

TEST(VerletList, LeavesFastAndLargeBodiesToTheSearch)
{
  Swarm swarm(100, 5);
  VerletList list;
  list.Configure(1);
  int used = 0;
  for (int step = 0; step < 100; ++step)
  {
    used += swarm.Compare(list, nullptr) ? 1 : 0;
    swarm.Drift(0.1);
  }
  EXPECT_LT(used, 10);

  Swarm others(100, 5);
  others.radii[3] = 1;
  others.listed.Configure(PlaneGrid::For({0, 0, 5, 5}, others.radii, kLargestMargin), others.radii);
  EXPECT_FALSE(others.Compare(list, nullptr));
}

}  // namespace
}  // namespace swarmanoid::kinematics2d

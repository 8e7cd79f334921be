#include "engine_worker/engines/kinematics2d/motion_limiter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "common/math/random.h"

namespace swarmanoid::kinematics2d
{
namespace
{

struct Plane
{
  double gap;
  std::array<Approach, 4> approaches;
};

std::vector<Plane> RandomPlanes(std::uint64_t seed, std::uint32_t leaders, int count)
{
  RandomStream random(seed, 0, 0, 0);
  const auto leader = [&] { return static_cast<std::uint32_t>(random.Uniform(0, 1) * leaders) % leaders; };
  std::vector<Plane> planes;
  for (int n = 0; n < count; ++n)
  {
    const std::uint32_t a = leader();
    const std::uint32_t b = (a + 1 + leader() % (leaders - 1)) % leaders;
    const auto rate = [&] { return random.Uniform(0, 1) < 0.3 ? 0 : random.Uniform(-0.02, 0.02); };
    planes.push_back(
        {random.Uniform(0, 1) < 0.3 ? 0 : random.Uniform(0, 0.01),
         {{{WayMotion(a), rate()}, {TurnMotion(a), rate()}, {WayMotion(b), rate()}, {TurnMotion(b), rate()}}}});
  }
  return planes;
}

MotionLimiter Limited(const std::vector<Plane>& planes, std::uint32_t leaders, std::size_t lists)
{
  std::vector<LimitList> found(lists);
  for (std::size_t n = 0; n < planes.size(); ++n) found[n % lists].Add(planes[n].gap, planes[n].approaches);
  MotionLimiter limiter;
  limiter.Configure(leaders);
  for (const LimitList& list : found) limiter.Add(list);
  limiter.Raise();
  return limiter;
}

TEST(MotionLimiter, WhatWasLimitedIsFreeAgainAfterClear)
{
  constexpr std::uint32_t kLeaders = 12;
  MotionLimiter limiter = Limited(RandomPlanes(1, kLeaders, 20), kLeaders, 1);
  ASSERT_FALSE(limiter.Limited().empty());
  limiter.Clear();
  EXPECT_TRUE(limiter.Limited().empty());
  for (std::uint32_t motion = 0; motion < 2 * kLeaders; ++motion) EXPECT_EQ(limiter.PartOf(motion), 1);
  // The next planes are others, and nothing is left of those before.
  const std::vector<Plane> planes = RandomPlanes(2, kLeaders, 5);
  LimitList list;
  for (const Plane& plane : planes) list.Add(plane.gap, plane.approaches);
  limiter.Add(list);
  limiter.Raise();
  const MotionLimiter fresh = Limited(planes, kLeaders, 1);
  for (std::uint32_t motion = 0; motion < 2 * kLeaders; ++motion)
    EXPECT_EQ(limiter.PartOf(motion), fresh.PartOf(motion)) << motion;
}

TEST(MotionLimiter, NoPlaneIsCrossed)
{
  for (std::uint64_t seed = 1; seed <= 200; ++seed)
  {
    constexpr std::uint32_t kLeaders = 12;
    const std::vector<Plane> planes = RandomPlanes(seed, kLeaders, 20);
    const MotionLimiter limiter = Limited(planes, kLeaders, 1);
    for (const Plane& plane : planes)
    {
      double nearer = 0;
      for (const Approach& approach : plane.approaches) nearer += approach.rate * limiter.PartOf(approach.motion);
      EXPECT_LE(nearer, plane.gap + 1e-15) << seed;
    }
    for (std::uint32_t motion = 0; motion < 2 * kLeaders; ++motion)
    {
      EXPECT_GE(limiter.PartOf(motion), 0);
      EXPECT_LE(limiter.PartOf(motion), 1);
    }
  }
}

TEST(MotionLimiter, TheOrderOfPlanesChangesNoBit)
{
  for (std::uint64_t seed = 1; seed <= 50; ++seed)
  {
    constexpr std::uint32_t kLeaders = 12;
    std::vector<Plane> planes = RandomPlanes(seed, kLeaders, 30);
    const MotionLimiter one = Limited(planes, kLeaders, 1);
    std::reverse(planes.begin(), planes.end());
    const MotionLimiter other = Limited(planes, kLeaders, 3);
    for (std::uint32_t motion = 0; motion < 2 * kLeaders; ++motion)
      EXPECT_EQ(one.PartOf(motion), other.PartOf(motion)) << seed;
    std::vector<std::uint32_t> held = one.Limited();
    std::vector<std::uint32_t> held_too = other.Limited();
    std::sort(held.begin(), held.end());
    std::sort(held_too.begin(), held_too.end());
    EXPECT_EQ(held, held_too);
  }
}

TEST(MotionLimiter, TwoThatMeetShareTheGapAndWhoFollowsGoesAsFarAsTheOneAhead)
{
  LimitList limits;
  // Bodies 0 and 1 approach by 10 mm each, 8 mm apart; 2 follows 1, which backs off from it by 5 mm, and touches it.
  EXPECT_TRUE(limits.Add(0.008, {{{WayMotion(0), 0.01}, {}, {WayMotion(1), 0.01}, {}}}));
  EXPECT_TRUE(limits.Add(0, {{{WayMotion(1), -0.005}, {}, {WayMotion(2), 0.01}, {}}}));
  EXPECT_FALSE(limits.Add(0.03, {{{WayMotion(2), 0.01}, {TurnMotion(2), 0.01}, {WayMotion(3), 0.01}, {}}}));
  MotionLimiter limiter;
  limiter.Configure(4);
  limiter.Add(limits);
  limiter.Raise();
  EXPECT_DOUBLE_EQ(limiter.PartOf(WayMotion(0)), 0.4);
  EXPECT_DOUBLE_EQ(limiter.PartOf(WayMotion(1)), 0.4);
  EXPECT_DOUBLE_EQ(limiter.PartOf(WayMotion(2)), 0.2);
  EXPECT_EQ(limiter.PartOf(TurnMotion(2)), 1);
  EXPECT_EQ(limiter.Limited().size(), 3U);
  limiter.Clear();
  EXPECT_EQ(limiter.PartOf(WayMotion(0)), 1);
  EXPECT_TRUE(limiter.Limited().empty());
}

}  // namespace
}  // namespace swarmanoid::kinematics2d

// The silence of others counts only while this process could hear them.
#include <gtest/gtest.h>

#include "common/bus/listening_clock.h"

namespace swarmanoid
{
namespace
{

using namespace std::chrono_literals;
using Time = ListeningClock::Clock::time_point;

TEST(ListeningClock, CountsAllTimeOfAProcessThatRuns)
{
  ListeningClock clock;
  const auto start = clock.At(Time{});
  for (int k = 1; k <= 100; ++k)
    EXPECT_EQ(clock.At(Time{} + k * ListeningClock::kPeriod) - start, k * ListeningClock::kPeriod);
}

// At a load of 60 on two cores, the thread runs once in a while, for a moment.
TEST(ListeningClock, CountsNoTimeInWhichTheProcessDidNotRun)
{
  ListeningClock clock;
  const auto start = clock.At(Time{});
  for (int k = 1; k <= 10; ++k) EXPECT_EQ(clock.At(Time{} + k * 3s) - start, k * ListeningClock::kMostBetween);
}

// A silence of 2 s has room for four announcements of half a second, also if each of its looks comes 30 periods late.
TEST(ListeningClock, ASilenceLastsAsManyLooksHoweverLateTheyAre)
{
  for (const auto late : {0ms, 100ms, 1500ms})
  {
    ListeningClock clock;
    const auto start = clock.At(Time{});
    int looks = 0;
    for (Time now{}; clock.At(now) - start < 2s; ++looks) now += ListeningClock::kPeriod + late;
    EXPECT_GE(looks, 20) << late.count();
  }
}

TEST(ListeningClock, NeverGoesBack)
{
  ListeningClock clock;
  const auto before = clock.At(Time{} + 10s);
  EXPECT_EQ(clock.At(Time{} + 9s), before);
  EXPECT_EQ(clock.At(Time{} + 10s), before);
  EXPECT_EQ(clock.At(Time{} + 10s + 20ms), before + 20ms);
}

}  // namespace
}  // namespace swarmanoid

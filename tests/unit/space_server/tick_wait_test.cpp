// TickWait, with a clock of the test.
#include "space_server/tick_wait.h"

#include <gtest/gtest.h>

namespace swarmanoid
{
namespace
{

using namespace std::chrono_literals;

class TickWaitTest : public testing::Test
{
protected:
  TickWaitTest() { wait_.Begin(Now(0ms)); }

  static TickWait::Clock::time_point Now(std::chrono::milliseconds time)
  {
    return TickWait::Clock::time_point(1h + time);
  }

  TickWait wait_;
};

TEST_F(TickWaitTest, TheIntervalBetweenRepetitionsDoublesUpToASecond)
{
  std::vector<int> repeats_ms;
  for (int ms = 0; ms <= 4000; ms += 50)
    if (wait_.TakeRepeat(Now(std::chrono::milliseconds(ms)))) repeats_ms.push_back(ms);
  EXPECT_EQ(repeats_ms, (std::vector{100, 300, 700, 1500, 2500, 3500}));
}

TEST_F(TickWaitTest, ARepetitionForAnotherReasonShortensTheInterval)
{
  EXPECT_TRUE(wait_.TakeRepeat(Now(3s)));
  wait_.Repeated(Now(3050ms));
  EXPECT_FALSE(wait_.TakeRepeat(Now(3149ms)));
  EXPECT_TRUE(wait_.TakeRepeat(Now(3150ms)));
}

TEST_F(TickWaitTest, AStallIsReportedAfterTwoSecondsAndThenEachSecond)
{
  EXPECT_EQ(wait_.TakeStall(Now(1999ms)), std::nullopt);
  EXPECT_EQ(wait_.TakeStall(Now(2s)), 2s);
  EXPECT_EQ(wait_.TakeStall(Now(2999ms)), std::nullopt);
  EXPECT_EQ(wait_.TakeStall(Now(3500ms)), 3500ms);
  EXPECT_EQ(wait_.TakeStall(Now(4s)), std::nullopt);
}

TEST_F(TickWaitTest, TheNextTickIsNoStall)
{
  EXPECT_EQ(wait_.TakeStall(Now(5s)), 5s);
  wait_.Begin(Now(6s));
  EXPECT_EQ(wait_.Waited(Now(7s)), 1s);
  EXPECT_EQ(wait_.TakeStall(Now(7s)), std::nullopt);
  EXPECT_EQ(wait_.TakeStall(Now(8s)), 2s);
}

}  // namespace
}  // namespace swarmanoid

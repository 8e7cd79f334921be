// Tests PaceMeter, on a clock of the test.
#include "space_server/pace_meter.h"

#include <gtest/gtest.h>

namespace swarmanoid
{
namespace
{

using std::chrono::milliseconds;

class PaceMeterTest : public testing::Test
{
protected:
  // Ticks that take so long each.
  void Run(int ticks, milliseconds each)
  {
    for (int k = 0; k < ticks; ++k) meter_.Observe(++tick_, now_ += each);
  }

  PaceMeter meter_{0.1};
  PaceMeter::Clock::time_point now_{};
  std::uint64_t tick_ = 0;
};

TEST_F(PaceMeterTest, IsTheRateOfTheTicks)
{
  EXPECT_EQ(meter_.RealTimeFactor(), 0);
  meter_.Observe(tick_, now_);
  Run(100, milliseconds(20));
  EXPECT_NEAR(meter_.TicksPerSecond(), 50, 1e-9);
  EXPECT_NEAR(meter_.RealTimeFactor(), 5, 1e-9);
}

TEST_F(PaceMeterTest, FollowsAChangeWithinSeconds)
{
  meter_.Observe(tick_, now_);
  Run(100, milliseconds(20));
  Run(10, milliseconds(100));
  // A second later: what is left of the old pace is 1 / e.
  EXPECT_NEAR(meter_.TicksPerSecond(), 10 + 40 * std::exp(-1), 0.5);
  Run(50, milliseconds(100));
  EXPECT_NEAR(meter_.TicksPerSecond(), 10, 0.2);
}

TEST_F(PaceMeterTest, APauseDoesNotCount)
{
  meter_.Observe(tick_, now_);
  Run(100, milliseconds(20));
  meter_.Rest(tick_, now_);
  now_ += std::chrono::seconds(3600);
  meter_.Observe(tick_, now_);
  Run(20, milliseconds(20));
  EXPECT_NEAR(meter_.TicksPerSecond(), 50, 1e-9);
}

TEST_F(PaceMeterTest, MeasuresAtMostTenTimesASecond)
{
  meter_.Observe(tick_, now_);
  int measured = 0;
  for (int k = 0; k < 1000; ++k) measured += meter_.Observe(++tick_, now_ += milliseconds(1));
  EXPECT_EQ(measured, 10);
}

}  // namespace
}  // namespace swarmanoid

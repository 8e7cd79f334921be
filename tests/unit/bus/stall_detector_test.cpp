// Tests StallDetector, with a clock of the test.
#include "common/bus/membership/stall_detector.h"

#include <gtest/gtest.h>

namespace swarmanoid
{
namespace
{

using namespace std::chrono_literals;

class StallDetectorTest : public testing::Test
{
protected:
  std::optional<std::string> After(std::chrono::milliseconds passed, std::uint64_t tick, const std::string& state)
  {
    now_ += passed;
    return detector_.Observe(tick, state, now_);
  }

  StallDetector detector_;
  StallDetector::Clock::time_point now_{1h};
};

TEST_F(StallDetectorTest, TellsWhatHasLastedASecond)
{
  EXPECT_EQ(After(0ms, 5, "waits for the engine"), std::nullopt);
  EXPECT_EQ(After(999ms, 5, "waits for the engine"), std::nullopt);
  EXPECT_EQ(After(1ms, 5, "waits for the engine"), "waits for the engine");
  EXPECT_EQ(After(10s, 5, "waits for the engine"), "waits for the engine");
}

TEST_F(StallDetectorTest, BeginsAnewWithEachTickAndState)
{
  EXPECT_EQ(After(0ms, 5, "a"), std::nullopt);
  EXPECT_EQ(After(900ms, 6, "a"), std::nullopt);
  EXPECT_EQ(After(900ms, 6, "b"), std::nullopt);
  EXPECT_EQ(After(999ms, 6, "b"), std::nullopt);
  EXPECT_EQ(After(1ms, 6, "b"), "b");
  EXPECT_EQ(After(0ms, 7, "b"), std::nullopt);
}

TEST_F(StallDetectorTest, SaysNothingOfNothing)
{
  EXPECT_EQ(After(0ms, 5, ""), std::nullopt);
  EXPECT_EQ(After(1h, 5, ""), std::nullopt);
}

}  // namespace
}  // namespace swarmanoid

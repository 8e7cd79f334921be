#include "real_robot/drivers/ros2/ros2_messages.h"

#include <gtest/gtest.h>

namespace swarmanoid::ros2
{
namespace
{

TEST(Ros2Messages, ATimeStampHasWholeSecondsAndNanoseconds)
{
  for (const auto& [seconds, whole, rest] : {std::tuple(0.0, 0, 0U), std::tuple(0.1, 0, 100'000'000U),
                                             std::tuple(12.000000001, 12, 1U), std::tuple(3.9999999999, 4, 0U)})
  {
    EXPECT_EQ(TimeOf(seconds).sec(), whole) << seconds;
    EXPECT_EQ(TimeOf(seconds).nanosec(), rest) << seconds;
  }
}

}  // namespace
}  // namespace swarmanoid::ros2

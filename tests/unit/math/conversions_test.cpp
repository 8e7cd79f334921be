// Conversions to a narrower type and back change a number at -O3 as well as without optimisation.
#include <gtest/gtest.h>

#include <array>

#include "tests/libraries/conversions.h"

namespace swarmanoid
{
namespace
{

TEST(Conversions, ADoubleThatPassesThroughFloatIsRounded)
{
  const std::array<double, 2> x = {0.1, 1.0 / 3};
  std::array<float, 2> rounded;
  std::array<double, 2> back;
  test::ThroughFloat(x.data(), rounded.data(), back.data());
  // These are the floats next to 1/10 and 1/3, exactly.
  EXPECT_EQ(back[0], 13421773.0 / 134217728);
  EXPECT_EQ(back[1], 11184811.0 / 33554432);
}

TEST(Conversions, ADoubleThatPassesThroughIntLosesItsFraction)
{
  const std::array<double, 2> x = {2.75, -2.75};
  std::array<double, 2> back;
  test::ThroughInt(x.data(), back.data());
  EXPECT_EQ(back[0], 2);
  EXPECT_EQ(back[1], -2);
}

}  // namespace
}  // namespace swarmanoid

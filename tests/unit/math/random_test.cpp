#include "common/math/random.h"

#include <gtest/gtest.h>

#include <cmath>

namespace swarmanoid
{
namespace
{

// The known answers that the authors of Philox publish with their Random123 library (philox 4x32, 10 rounds).
TEST(Random, PhiloxGivesItsPublishedAnswers)
{
  using Block = std::array<std::uint32_t, 4>;
  EXPECT_EQ(Philox4x32({0, 0, 0, 0}, {0, 0}), (Block{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  EXPECT_EQ(Philox4x32({0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff}, {0xffffffff, 0xffffffff}),
            (Block{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(Philox4x32({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
            (Block{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(Random, StreamsDifferInEachPartOfTheirName)
{
  const auto first = [](std::uint64_t seed, std::uint32_t entity, std::uint32_t device, std::uint32_t tick)
  { return RandomStream(seed, entity, device, tick).Bits(); };
  const std::uint32_t reference = first(1, 2, 3, 4);
  EXPECT_EQ(first(1, 2, 3, 4), reference);
  EXPECT_NE(first(2, 2, 3, 4), reference);
  EXPECT_NE(first(1ULL << 32, 2, 3, 4), first(0, 2, 3, 4));
  EXPECT_NE(first(1, 3, 3, 4), reference);
  EXPECT_NE(first(1, 2, 4, 4), reference);
  EXPECT_NE(first(1, 2, 3, 5), reference);
}

TEST(Random, UniformAndGaussianHaveTheirMoments)
{
  RandomStream random(42, 0, 0, 0);
  constexpr int kDraws = 400000;
  double sum = 0;
  double squares = 0;
  double gaussian_sum = 0;
  double gaussian_squares = 0;
  for (int i = 0; i < kDraws; ++i)
  {
    const double u = random.Uniform();
    ASSERT_GE(u, 0);
    ASSERT_LT(u, 1);
    sum += u;
    squares += u * u;
    const double g = random.Gaussian(3, 2);
    gaussian_sum += g;
    gaussian_squares += (g - 3) * (g - 3);
  }
  EXPECT_NEAR(sum / kDraws, 0.5, 0.002);
  EXPECT_NEAR(squares / kDraws, 1.0 / 3, 0.002);
  EXPECT_NEAR(gaussian_sum / kDraws, 3, 0.02);
  EXPECT_NEAR(gaussian_squares / kDraws, 4, 0.05);
}

TEST(Random, BelowReachesAllValuesEvenly)
{
  RandomStream random(7, 0, 0, 0);
  std::array<int, 6> counts{};
  for (int i = 0; i < 60000; ++i) ++counts.at(random.Below(6));
  for (const int count : counts) EXPECT_NEAR(count, 10000, 400);
}

}  // namespace
}  // namespace swarmanoid

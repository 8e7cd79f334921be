#include "common/math/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <type_traits>
#include <vector>

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
  const auto first = [](std::uint64_t seed, std::uint64_t entity, std::uint64_t purpose, std::uint64_t tick,
                        std::uint64_t other) { return RandomStream(seed, entity, purpose, tick, other).Bits(); };
  const std::uint32_t reference = first(1, 2, 3, 4, 5);
  EXPECT_EQ(first(1, 2, 3, 4, 5), reference);
  constexpr std::uint64_t kHigh = 1ULL << 32;
  for (const std::uint64_t other : {7 + 0 * kHigh, 1 + kHigh, 2 + kHigh, 3 + kHigh, 4 + kHigh, 5 + kHigh})
  {
    EXPECT_NE(first(other, 2, 3, 4, 5), reference);
    EXPECT_NE(first(1, other, 3, 4, 5), reference);
    EXPECT_NE(first(1, 2, other, 4, 5), reference);
    EXPECT_NE(first(1, 2, 3, other, 5), reference);
    EXPECT_NE(first(1, 2, 3, 4, other), reference);
  }
}

// The names are typical: a swarm of numbered ids, parts of them, some devices, ticks in a row. Among 2 * 10^6 draws of
// 64 bits, two are equal by chance with probability 10^-7.
TEST(Random, NearNamesNeverDrawTheSame)
{
  std::vector<std::uint64_t> drawn;
  const auto draw = [&drawn](RandomStream random)
  {
    const std::uint64_t high = random.Bits();
    drawn.push_back(high << 32 | random.Bits());
  };
  std::vector<std::uint64_t> names;
  for (int i = 0; i < 100; ++i) names.push_back(StreamName("fb_" + std::to_string(i)));
  for (const char* device : {"sensor range_and_bearing", "actuator range_and_bearing", "controller ControlStep"})
    for (std::size_t i = 0; i < names.size(); ++i)
    {
      const StreamKey key(1, names[i], StreamName(device));
      for (std::uint64_t tick = 0; tick < 20; ++tick)
      {
        draw({key, tick});
        for (const std::uint64_t partner : names) draw({key, tick, partner});
        for (std::uint64_t part = 0; part < 16; ++part) draw({key, tick, StreamPart(names[0], part)});
        for (std::uint64_t part = 0; part < 16; ++part) draw({key, tick, StreamPart(0, part)});
      }
    }
  const std::size_t all = drawn.size();
  std::sort(drawn.begin(), drawn.end());
  drawn.erase(std::unique(drawn.begin(), drawn.end()), drawn.end());
  EXPECT_EQ(drawn.size(), all);
}

TEST(Random, NamesOfIdsAreStable)
{
  EXPECT_EQ(StreamName(""), MixedBits(14695981039346656037ULL));
  EXPECT_EQ(StreamName("fb_0"), StreamName(std::string("fb_") + "0"));
  EXPECT_NE(StreamName("fb_0"), StreamName("fb_1"));
  // FNV-1a itself has collisions; files with two such ids are refused.
  EXPECT_EQ(StreamName("7mohtcOFVz"), StreamName("c1E51sSEyx"));
}

// A copy would draw the same numbers again.
static_assert(!std::is_copy_constructible_v<RandomStream> && !std::is_copy_assignable_v<RandomStream>);

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

// The largest distance between the distribution of many draws and a given one; Kolmogorov: above 1.95 / sqrt(n) by
// chance in one of a thousand seeds. The seed is fixed: this cannot fail by chance.
template <class Draw, class Distribution>
double KolmogorovDistance(Draw draw, Distribution distribution)
{
  constexpr std::size_t kDraws = 200000;
  std::vector<double> drawn(kDraws);
  for (double& value : drawn) value = draw();
  std::sort(drawn.begin(), drawn.end());
  double distance = 0;
  for (std::size_t i = 0; i < kDraws; ++i)
  {
    const double expected = distribution(drawn[i]);
    distance = std::max({distance, std::abs(expected - static_cast<double>(i) / kDraws),
                         std::abs(expected - static_cast<double>(i + 1) / kDraws)});
  }
  return distance * std::sqrt(kDraws);
}

double Phi(double x) { return 0.5 * std::erfc(-x / std::sqrt(2)); }

TEST(Random, DrawsHaveTheirDistributions)
{
  RandomStream random(5, 0, 0, 0);
  EXPECT_LT(KolmogorovDistance([&] { return random.Uniform(); }, [](double x) { return x; }), 1.95);
  EXPECT_LT(KolmogorovDistance([&] { return random.Centred(); }, [](double x) { return x + 0.5; }), 1.95);
  EXPECT_LT(KolmogorovDistance([&] { return random.Gaussian(3, 2); }, [](double x) { return Phi((x - 3) / 2); }), 1.95);
  for (const double range : {0.02, 1.0, 3.0, 30.0})
    EXPECT_LT(KolmogorovDistance([&] { return random.TruncatedGaussian(3, 2, range); },
                                 [=](double x)
                                 {
                                   const double low = Phi(-range / 2);
                                   return (Phi((x - 3) / 2) - low) / (1 - 2 * low);
                                 }),
              1.95)
        << range;
}

TEST(Random, UniformOfARangeHasItsDistribution)
{
  RandomStream random(8, 0, 0, 0);
  for (const auto& [low, high] : {std::pair(-2.0, 3.0), std::pair(0.25, 0.5), std::pair(-9.0, -4.0)})
    EXPECT_LT(KolmogorovDistance([&, low = low, high = high] { return random.Uniform(low, high); },
                                 [low = low, high = high](double x) { return (x - low) / (high - low); }),
              1.95)
        << low << " " << high;
}

// Each range holds no other double than its ends. Rounding would give the upper one for half of the draws.
TEST(Random, UniformOfARangeReachesItsLowerEndAndNeverItsUpperOne)
{
  RandomStream random(9, 0, 0, 0);
  for (const double low : {1.0, -1.0, 1e6})
  {
    const double high = std::nextafter(low, 1e9);
    for (int i = 0; i < 1000; ++i) ASSERT_EQ(random.Uniform(low, high), low) << low << ", draw " << i;
  }
  EXPECT_EQ(random.Uniform(3, 3), 3) << "an empty range";
}

TEST(Random, UniformHas53BitsThatKnowNothingOfEachOther)
{
  constexpr int kDraws = 4000;
  constexpr double kFarOff = 5 * 0.5 * 63.25;  // five standard deviations
  RandomStream random(1, 2, 3, 4);
  std::vector<std::uint64_t> draws;
  for (int k = 0; k < kDraws; ++k) draws.push_back(static_cast<std::uint64_t>(random.Uniform() * 0x1.0p53));
  for (unsigned a = 0; a < 53; ++a)
    for (unsigned b = a; b < 53; ++b)
    {
      // A bit by itself, or whether two are alike.
      int count = 0;
      for (const std::uint64_t bits : draws) count += static_cast<int>(((bits >> a) ^ (a == b ? 0 : bits >> b)) & 1);
      EXPECT_NEAR(count, kDraws / 2, kFarOff) << a << " " << b;
    }
}

TEST(Random, TruncatedStaysWithinItsRange)
{
  RandomStream random(6, 0, 0, 0);
  for (int i = 0; i < 20000; ++i)
  {
    const double range = i % 2 == 0 ? 1e-9 : 2.0;
    const double value = random.TruncatedGaussian(0, 1, range);
    ASSERT_TRUE(value >= -range && value <= range) << value;
  }
  EXPECT_EQ(random.TruncatedGaussian(3, 0, 1), 3);
  EXPECT_EQ(random.TruncatedGaussian(3, 1, 0), 3);
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

#include "common/math/lanes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "common/math/random.h"

namespace swarmanoid
{
namespace
{

constexpr float kFloatInfinity = std::numeric_limits<float>::infinity();
constexpr float kFloatNotANumber = std::numeric_limits<float>::quiet_NaN();

std::vector<float> Numbers()
{
  RandomStream random(2, 0, 0, 0);
  std::vector<float> numbers{0, -0.0F, 1, -1, kFloatInfinity, -kFloatInfinity, kFloatNotANumber, 1e-30F};
  while (numbers.size() < 512) numbers.push_back(static_cast<float>(random.Uniform(-1000, 1000)));
  return numbers;
}

// Compares the lanes bit by bit, since -0 and NaN count.
template <class Lanes, class Number>
void ExpectLanes(Lanes lanes, const Number& number)
{
  for (std::size_t i = 0; i < sizeof lanes / sizeof lanes[0]; ++i)
  {
    const auto expected = number(i);
    const decltype(expected + 0) held = lanes[i];
    EXPECT_EQ(std::memcmp(&held, &expected, sizeof held), 0) << i << ": " << held << ", not " << expected;
  }
}

TEST(Lanes, ComputeWhatEachNumberWould)
{
  const std::vector<float> numbers = Numbers();
  const std::vector<double> doubles(numbers.begin(), numbers.end());
  // Lanes can be loaded from any address.
  for (std::size_t k = 1; k + kLanes < numbers.size(); ++k)
  {
    const FloatLanes a = LoadLanes(&numbers[k]), b = LoadLanes(&numbers[k - 1]);
    ExpectLanes(a, [&](std::size_t i) { return numbers[k + i]; });
    ExpectLanes(Minimum(a, b), [&](std::size_t i) { return a[i] < b[i] ? a[i] : b[i]; });
    ExpectLanes(Maximum(a, b), [&](std::size_t i) { return a[i] > b[i] ? a[i] : b[i]; });
    const FloatLanes size = Magnitude(a);
    for (int i = 0; i < kLanes; ++i) EXPECT_TRUE(std::isnan(a[i]) || size[i] == std::fabs(a[i]));
    const DoubleLanes c = LoadLanes(&doubles[k]), d = LoadLanes(&doubles[k - 1]);
    ExpectLanes(Minimum(c, d), [&](std::size_t i) { return c[i] < d[i] ? c[i] : d[i]; });
    ExpectLanes(Maximum(c, d), [&](std::size_t i) { return c[i] > d[i] ? c[i] : d[i]; });
    ExpectLanes(Everywhere(doubles[k]), [&](std::size_t) { return doubles[k]; });
    ExpectLanes(Everywhere(numbers[k]), [&](std::size_t) { return numbers[k]; });
    EXPECT_EQ(LaneMask(a < b) & 1U, numbers[k] < numbers[k - 1] ? 1U : 0U);
    EXPECT_EQ(LaneMask(c < d) & 1U, numbers[k] < numbers[k - 1] ? 1U : 0U);
  }
  for (std::size_t k = 8; k + kLanes < numbers.size(); ++k)
  {
    const FloatLanes a = LoadLanes(&numbers[k]);
    const DoubleLanes c = LoadLanes(&doubles[k]);
    ExpectLanes(SquareRoot(Magnitude(a)), [&](std::size_t i) { return std::sqrt(std::fabs(numbers[k + i])); });
    ExpectLanes(SquareRoot(c * c), [&](std::size_t i) { return std::sqrt(doubles[k + i] * doubles[k + i]); });
    ExpectLanes(Truncated(a), [&](std::size_t i) { return static_cast<std::int32_t>(numbers[k + i]); });
    ExpectLanes(Truncated(c), [&](std::size_t i) { return static_cast<std::int32_t>(doubles[k + i]); });
    ExpectLanes(Differences(&doubles[k], doubles[3]),
                [&](std::size_t i) { return static_cast<float>(doubles[k + i] - doubles[3]); });
    EXPECT_EQ(Lowest(a), *std::min_element(&numbers[k], &numbers[k] + kLanes));
    EXPECT_EQ(Highest(a), *std::max_element(&numbers[k], &numbers[k] + kLanes));
    ExpectLanes(LowestOfFour(a),
                [&](std::size_t i) { return *std::min_element(&numbers[k] + i / 4 * 4, &numbers[k] + i / 4 * 4 + 4); });
  }
}

TEST(Lanes, TakeWhatComesFirstOfWhatIsNotANumber)
{
  EXPECT_EQ(Maximum(Everywhere(kFloatNotANumber), FloatLanes{})[0], 0);
  EXPECT_EQ(Minimum(Everywhere(static_cast<double>(kFloatNotANumber)), Everywhere(7.0))[0], 7);
}

TEST(Lanes, AreNumberedFromTheLowestBit)
{
  ExpectLanes(LaneNumbers(), [](std::size_t i) { return static_cast<std::int32_t>(i); });
  ExpectLanes(InLanes([](std::size_t i) { return static_cast<double>(i); }),
              [](std::size_t i) { return static_cast<double>(i); });
  for (unsigned count = 0; count <= kLanes + 2; ++count)
    EXPECT_EQ(LaneMask(FirstLanes(count)), (1U << std::min<unsigned>(count, kLanes)) - 1);
  for (int lane = 0; lane < kDoubleLanes; ++lane)
  {
    LongLanes one{};
    one[lane] = -1;
    EXPECT_EQ(LaneMask(one), 1U << lane);
  }
  std::vector<unsigned> bits;
  ForEachBit(0b10010010U, [&](unsigned bit) { bits.push_back(bit); });
  EXPECT_THAT(bits, testing::ElementsAre(1, 4, 7));
}

// All masks there are.
TEST(Selection, StoresTheChosenLanesOneAfterAnother)
{
  std::vector<float> floats;
  std::vector<std::int32_t> ints;
  std::vector<double> doubles;
  for (int i = 0; i < kLanes; ++i)
  {
    floats.push_back(static_cast<float>(i) + 0.5F);
    ints.push_back(100 + i);
    doubles.push_back(i + 0.25);
  }
  for (unsigned mask = 0; mask < 1U << kLanes; ++mask)
  {
    const Selection selection(mask);
    std::vector<float> stored_floats(2 * kLanes);
    std::vector<std::int32_t> stored_ints(2 * kLanes);
    std::vector<double> stored_doubles(2 * kLanes);
    selection.Store(LoadLanes(floats.data()), stored_floats.data());
    selection.Store(LoadLanes(ints.data()), stored_ints.data());
    selection.Store(doubles.data(), stored_doubles.data());
    unsigned count = 0;
    ForEachBit(mask,
               [&](unsigned lane)
               {
                 EXPECT_EQ(stored_floats[count], floats[lane]);
                 EXPECT_EQ(stored_ints[count], ints[lane]);
                 EXPECT_EQ(stored_doubles[count], doubles[lane]);
                 ++count;
               });
    EXPECT_EQ(selection.Count(), count);
  }
}

}  // namespace
}  // namespace swarmanoid

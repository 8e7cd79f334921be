// Tests confidence intervals against closed forms and tables of Student's t.
#include "studies/tables/statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "common/math/elementary.h"

namespace swarmanoid
{
namespace
{

TEST(StudyStatistics, StudentsTIsThatOfTables)
{
  // With one and two degrees of freedom, closed forms exist. The others are in any table of two-sided 5 %.
  EXPECT_NEAR(StudentsT(1), std::tan(0.475 * kPi), 1e-9);
  EXPECT_NEAR(StudentsT(2), 0.95 * std::sqrt(2 / (1 - 0.95 * 0.95)), 1e-9);
  for (const auto& [freedom, quantile] : {std::pair{3, 3.1824}, {4, 2.7764}, {9, 2.2622}, {29, 2.0452}, {100, 1.9840}})
    EXPECT_NEAR(StudentsT(static_cast<std::size_t>(freedom)), quantile, 1e-4) << freedom;
  EXPECT_NEAR(StudentsT(1'000'000), 1.95996, 1e-5);
}

TEST(StudyStatistics, AnIntervalIsTTimesTheStandardError)
{
  const MeanInterval interval = MeanIntervalOf({1, 2, 3, 4, 5});
  EXPECT_DOUBLE_EQ(interval.mean, 3);
  EXPECT_NEAR(interval.half, 2.7764 * std::sqrt(2.5 / 5), 1e-4);
  EXPECT_TRUE(std::isinf(MeanIntervalOf({7}).half));
}

// The reference values are scipy 1.10.1's friedmanchisquare and wilcoxon, and its t.ppf in Conover's equation.
TEST(StudyStatistics, FriedmansTestIsThatOfScipy)
{
  const FriedmanTest test =
      FriedmanTestOf({{1, 2, 3, 4}, {2, 1, 3, 4}, {1, 2, 4, 3}, {1, 3, 2, 4}, {2, 2, 3, 5}, {1, 1, 1, 2}}, 0.05);
  EXPECT_EQ(test.rank_sums, (std::vector{8.5, 11.5, 17.0, 23.0}));
  EXPECT_NEAR(test.p, 0.003912713985102536, 1e-12);
  EXPECT_NEAR(test.critical_difference, 5.073864792887362, 1e-9);
  EXPECT_EQ(FriedmanTestOf({{3, 3}, {7, 7}}, 0.05).p, 1);
}

TEST(StudyStatistics, WilcoxonsTestIsThatOfScipy)
{
  EXPECT_NEAR(WilcoxonP({1.1, -0.4, 2.3, 0.7, -0.1, 1.9, 3.0, 0.2}), 0.0546875, 1e-12);
  EXPECT_EQ(WilcoxonP({}), 1);
  EXPECT_EQ(WilcoxonP({0, 0}), 1);
  EXPECT_EQ(WilcoxonP({1, 2, 3, 4, 5}), 0.0625);
  const std::vector<double> many = {
      1.924,  -0.312, -0.228, -0.773, 1.165,  -2.002, 2.045,  -0.461, 0.619,  0.051,  1.762,  -1.76,  -0.022, -0.084,
      1.434,  -0.8,   0.128,  -0.578, 0.342,  0.883,  -0.801, 1.445,  1.202,  0.802,  1.201,  -0.384, 0.177,  -0.636,
      0.032,  0.83,   -0.392, -0.097, -0.387, -0.545, -0.371, 0.287,  -0.817, 0.534,  1.96,   1.042,  0.108,  -0.588,
      -0.447, 1.992,  0.351,  -0.337, 0.491,  2.4,    0.42,   0.917,  0.6,    -0.052, -0.843, -0.049, 0.091,  0.887,
      1.139,  1.231,  0.586,  1.185,  -0.454, 1.553,  0.813,  0.002,  0.789,  0.224,  1.432,  1.82,   2.486,  -1.096};
  EXPECT_NEAR(WilcoxonP(many), 0.0040605175885695954, 1e-12);
}

TEST(StudyStatistics, WilcoxonsTestCountsAllSignsOfEqualDifferences)
{
  const std::vector<double> differences = {1, 1, -2, 3, 3, 3, -1, 5};
  const std::vector<double> ranks = RanksOf({1, 1, 2, 3, 3, 3, 1, 5});
  EXPECT_EQ(ranks, (std::vector<double>{2, 2, 4, 6, 6, 6, 2, 8}));
  int as_far = 0;
  for (unsigned signs = 0; signs < 256; ++signs)
  {
    double positive = 0;
    for (unsigned i = 0; i < 8; ++i)
      if ((signs >> i & 1U) != 0) positive += ranks[i];
    if (std::min(positive, 36 - positive) <= 6) ++as_far;
  }
  EXPECT_NEAR(WilcoxonP(differences), as_far / 256.0, 1e-12);
}

TEST(StudyStatistics, AMeanHasTheDigitsOfItsInterval)
{
  EXPECT_EQ(IntervalText({0.723893, 0.0152}), "0.724 ± 0.015");
  EXPECT_EQ(IntervalText({306.7, 163}), "310 ± 160");
  EXPECT_EQ(IntervalText({-7.433, 13.1}), "-7 ± 13");
  EXPECT_EQ(IntervalText({-0.4, 13.1}), "0 ± 13");
  EXPECT_EQ(IntervalText({-120, 13100}), "0 ± 13000");
  EXPECT_EQ(IntervalText({7, std::numeric_limits<double>::infinity()}), "7 ± inf");
}

}  // namespace
}  // namespace swarmanoid

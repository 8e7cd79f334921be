// Tests confidence intervals against closed forms and tables of Student's t.
#include "studies/tables/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

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

TEST(StudyStatistics, AMeanHasTheDigitsOfItsInterval)
{
  EXPECT_EQ(IntervalText({0.723893, 0.0152}), "0.724 ± 0.015");
  EXPECT_EQ(IntervalText({306.7, 163}), "310 ± 160");
  EXPECT_EQ(IntervalText({-7.433, 13.1}), "-7 ± 13");
  EXPECT_EQ(IntervalText({7, std::numeric_limits<double>::infinity()}), "7 ± inf");
}

}  // namespace
}  // namespace swarmanoid

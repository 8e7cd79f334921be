// Confidence intervals, against closed forms and tables of Student's t.
#include "studies/statistics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/math/elementary.h"

namespace swarmanoid
{
namespace
{

TEST(StudyStatistics, StudentsTIsThatOfTables)
{
  // With one and two degrees of freedom there are closed forms. The others stand in any table of two-sided 5 %.
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

}  // namespace
}  // namespace swarmanoid

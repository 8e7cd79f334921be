#include "common/math/elementary.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "common/math/random.h"

namespace swarmanoid
{
namespace
{

// The largest error of f against the C library over random arguments, in units of `scale(x)`.
double WorstError(const std::function<double(double)>& f, const std::function<double(double)>& reference, double low,
                  double high, bool relative)
{
  RandomStream random(1, 2, 3, 4);
  double worst = 0;
  for (int i = 0; i < 200000; ++i)
  {
    const double x = random.Uniform(low, high);
    const double expected = reference(x);
    const double error = std::abs(f(x) - expected) / (relative ? std::abs(expected) : 1.0);
    worst = std::max(worst, error);
  }
  return worst;
}

TEST(Elementary, SineAndCosineAreAsPreciseAsDoublesAre)
{
  EXPECT_LT(WorstError([](double x) { return Sin(x); }, [](double x) { return std::sin(x); }, -100, 100, false), 3e-16);
  EXPECT_LT(WorstError([](double x) { return Cos(x); }, [](double x) { return std::cos(x); }, -100, 100, false), 3e-16);
  EXPECT_LT(WorstError([](double x) { return Sin(x); }, [](double x) { return std::sin(x); }, -1e5, 1e5, false), 1e-15);
}

TEST(Elementary, ArcFunctionsInvertTheCircle)
{
  RandomStream random(5, 6, 7, 8);
  for (int i = 0; i < 100000; ++i)
  {
    const double y = random.Uniform(-10, 10);
    const double x = random.Uniform(-10, 10);
    ASSERT_NEAR(Atan2(y, x), std::atan2(y, x), 1e-15);
    const double s = random.Uniform(-1, 1);
    ASSERT_NEAR(Asin(s), std::asin(s), 1e-15);
    ASSERT_NEAR(Acos(s), std::acos(s), 1e-15);
  }
  EXPECT_EQ(Atan2(0, 0), 0);
  EXPECT_EQ(Atan2(1, 0), kPi / 2);
  EXPECT_EQ(Atan2(0, -1), kPi);
  EXPECT_EQ(Asin(2), kPi / 2);
  EXPECT_EQ(Acos(-2), kPi);
}

TEST(Elementary, ExponentialAndLogarithmAgreeWithTheLibrary)
{
  EXPECT_LT(WorstError([](double x) { return Exp(x); }, [](double x) { return std::exp(x); }, -700, 700, true), 1e-15);
  EXPECT_LT(WorstError([](double x) { return Log(x); }, [](double x) { return std::log(x); }, 2, 1e6, true), 1e-15);
  EXPECT_LT(WorstError([](double x) { return Log(x); }, [](double x) { return std::log(x); }, 1e-6, 2, false), 2e-15);
  EXPECT_EQ(Exp(0), 1);
  EXPECT_EQ(Log(1), 0);
  EXPECT_EQ(Exp(-800), 0);
  EXPECT_TRUE(std::isinf(Exp(800)));
  EXPECT_NEAR(Log(5e-310), std::log(5e-310), 1e-12);
}

TEST(Elementary, WrapAngleStaysWithinHalfATurn)
{
  for (double x = -50; x < 50; x += 0.37)
  {
    EXPECT_LE(std::abs(WrapAngle(x)), kPi + 1e-12);
    EXPECT_NEAR(std::sin(WrapAngle(x)), std::sin(x), 1e-12);
  }
}

}  // namespace
}  // namespace swarmanoid

#include "common/math/normal.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace swarmanoid
{
namespace
{

TEST(Normal, QuantileInvertsTheDistribution)
{
  for (int i = 1; i < 4000; ++i)
  {
    const double mass = (i - 2000) / 4000.0;
    const double x = NormalQuantile(mass);
    ASSERT_NEAR(0.5 * std::erf(x / std::sqrt(2)), mass, 2e-16 + 4e-16 * std::abs(mass));
    ASSERT_EQ(NormalQuantile(-mass), -x);
  }
  EXPECT_EQ(NormalQuantile(0), 0);
  // Far out, where 1/2 - mass keeps its digits: down to the least that a stream draws.
  for (int bits = 4; bits <= 54; ++bits)
  {
    const double tail = std::ldexp(1.0, -bits);
    const double x = NormalQuantile(0.5 - tail);
    ASSERT_NEAR(0.5 * std::erfc(x / std::sqrt(2)) / tail, 1, 1e-13) << bits;
  }
  EXPECT_NEAR(NormalQuantile(0.475), 1.959963984540054, 1e-14);
}

TEST(Normal, MassIsTheIntegralOfTheDensity)
{
  for (double x = 1e-6; x < 12; x *= 1.07) ASSERT_NEAR(NormalMass(x) / (0.5 * std::erf(x / std::sqrt(2))), 1, 1e-14);
  EXPECT_EQ(NormalMass(0), 0);
  EXPECT_EQ(NormalMass(40), 0.5);
  EXPECT_NEAR(NormalMass(1e-200) * std::sqrt(8 * std::atan(1)) / 1e-200, 1, 1e-14);
}

TEST(Normal, ManyQuantilesAreThoseOfOneByOne)
{
  std::vector<double> masses;
  for (int i = -999; i < 1000; ++i) masses.push_back(i / 2000.0);
  for (int i = 0; i < 20000; ++i) masses.push_back((i % 2 == 0 ? 1 : -1) * (0.5 - 0.075 * std::pow(0.999, i)));
  for (const double tail : {0x1p-54, 1e-12, 0.075, 0.0750000001}) masses.insert(masses.end(), {0.5 - tail, tail - 0.5});
  std::vector<double> quantiles = masses;
  NormalQuantiles(quantiles);
  for (std::size_t i = 0; i < masses.size(); ++i) ASSERT_EQ(quantiles[i], NormalQuantile(masses[i]));
}

}  // namespace
}  // namespace swarmanoid

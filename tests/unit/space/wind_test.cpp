#include "common/space/wind.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace swarmanoid
{
namespace
{

Experiment WindyExperiment(const Vector3& velocity, double gusts = 0, double height = 6.096, std::uint64_t seed = 1)
{
  Experiment experiment;
  experiment.seed = seed;
  experiment.wind = WindConfiguration{velocity, gusts, height};
  return experiment;
}

TEST(Wind, IsCalmIfNoneIsDeclaredAndConstantWithoutGusts)
{
  const Wind calm{Experiment{}};
  EXPECT_FALSE(calm.IsDeclared());
  EXPECT_EQ(calm.At({1, 2, 3}, 4), Vector3::Zero());
  const Wind wind(WindyExperiment({1, -2, 0.5}));
  EXPECT_TRUE(wind.IsDeclared());
  EXPECT_EQ(wind.At({1, 2, 3}, 4), Vector3(1, -2, 0.5));
  EXPECT_EQ(wind.At({100, 0, 0}, 4e4), Vector3(1, -2, 0.5));
}

// At 20 feet and at the bounds, by MIL-F-8785C in feet: L = h / (0.177 + 0.000823 h)^1.2, and s = 0.1 W / (…)^0.4.
TEST(Wind, HasDrydensDeviationsAndLengthsOfLowAltitudes)
{
  const DrydenGusts gusts = DrydenGusts::At(6.096, 10);
  EXPECT_NEAR(gusts.upward_m_s, 1, 1e-12);
  EXPECT_NEAR(gusts.across_m_s, 1.9292, 1e-4);
  EXPECT_NEAR(gusts.upward_m, 6.096, 1e-12);
  EXPECT_NEAR(gusts.across_m, 43.77, 0.01);
  EXPECT_NEAR(DrydenGusts::At(0, 10).upward_m, 3.048, 1e-12) << "the formulas hold from 10 feet on";
  EXPECT_NEAR(DrydenGusts::At(304.8, 10).across_m, 304.8, 1e-9) << "isotropic at 1000 feet";
  EXPECT_NEAR(DrydenGusts::At(304.8, 10).across_m_s, 1, 1e-9);
}

// Returns the means over time and seeds of the products of each component with itself, `lag_m` metres of the wind
// later.
Vector3 Correlations(double lag_m)
{
  const Vector3 mean(2, 0, 0);
  Vector3 sum = Vector3::Zero();
  int count = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
  {
    const Wind wind(WindyExperiment(mean, 10, 6.096, seed));
    for (int k = 0; k < 400; ++k, ++count)
    {
      const double time = 31.7 * k;
      const Vector3 now = wind.At({0, 0, 1}, time) - mean;
      sum += now.cwiseProduct(wind.At({0, 0, 1}, time + lag_m / mean.x()) - mean);
    }
  }
  return sum / count;
}

TEST(Wind, HasGustsOfDrydensVariance)
{
  const DrydenGusts gusts = DrydenGusts::At(6.096, 10);
  const Vector3 variances = Correlations(0);
  EXPECT_NEAR(variances.x() / (gusts.across_m_s * gusts.across_m_s), 1, 0.05);
  EXPECT_NEAR(variances.y() / (gusts.across_m_s * gusts.across_m_s), 1, 0.05);
  EXPECT_NEAR(variances.z() / (gusts.upward_m_s * gusts.upward_m_s), 1, 0.05);
}

// The spectra are those of exp(-r / L) along the wind, and (1 - r / 2 L) exp(-r / L) across it.
TEST(Wind, HasGustsWhoseCorrelationFallsWithDrydensLengths)
{
  const DrydenGusts gusts = DrydenGusts::At(6.096, 10);
  const double half = 0.5;  // lengths
  const Vector3 horizontal = Correlations(half * gusts.across_m) / (gusts.across_m_s * gusts.across_m_s);
  EXPECT_NEAR(horizontal.x(), std::exp(-half), 0.05);
  EXPECT_NEAR(horizontal.y(), (1 - half / 2) * std::exp(-half), 0.05);
  const Vector3 vertical = Correlations(half * gusts.upward_m) / (gusts.upward_m_s * gusts.upward_m_s);
  EXPECT_NEAR(vertical.z(), (1 - half / 2) * std::exp(-half), 0.05);
}

TEST(Wind, CarriesItsGustsAlong)
{
  const Vector3 velocity(1.5, 2, 0);
  const Wind wind(WindyExperiment(velocity, 5));
  const Vector3 here = wind.At({1, 1, 1}, 10);
  EXPECT_LT((wind.At(Vector3(1, 1, 1) + 7 * velocity, 17) - here).norm(), 1e-9);
  EXPECT_GT((wind.At({1, 1, 1}, 17) - here).norm(), 0.01);
}

TEST(Wind, HasTheSameGustsForTheSameSeedAlone)
{
  const auto gust = [](std::uint64_t seed) { return Wind(WindyExperiment({1, 0, 0}, 5, 3, seed)).At({1, 2, 3}, 40); };
  EXPECT_EQ(gust(3), gust(3));
  EXPECT_NE(gust(3), gust(4));
}

}  // namespace
}  // namespace swarmanoid

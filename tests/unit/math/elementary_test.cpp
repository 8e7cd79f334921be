#include "common/math/elementary.h"

#include <cmath>
#include <vector>

namespace swarmanoid
{
namespace
{

// Arguments of all sizes that a simulation meets, both signs.
std::vector<double> Angles()
{
  std::vector<double> angles;
  for (int k = -20000; k <= 20000; ++k) angles.push_back(k * 0.00731);
  for (double x = 1e-12; x < 1e5; x *= 1.7) angles.insert(angles.end(), {x, -x});
  return angles;
}

TEST(Elementary, SineAndCosineAreAccurate)
{
  for (const double x : Angles())
  {
    const SinCos value = SinCosOf(x);
    EXPECT_NEAR(value.sin, std::sin(x), 3e-16) << "x = " << x;
    EXPECT_NEAR(value.cos, std::cos(x), 3e-16) << "x = " << x;
  }
}

TEST(Elementary, ArcTangentKnowsItsQuadrant)
{
  for (int k = -359; k <= 360; ++k)
  {
    const double angle = k * kPi / 360.0;
    for (const double radius : {1e-9, 1.0, 3e7})
    {
      EXPECT_NEAR(Atan2(radius * std::sin(angle), radius * std::cos(angle)), angle, 5e-16 * (1 + std::abs(angle)))
          << "angle " << k << "/360 pi, radius " << radius;
    }
  }
  EXPECT_EQ(Atan2(0, 0), 0);
  EXPECT_DOUBLE_EQ(Atan2(0, -1), kPi);
  EXPECT_DOUBLE_EQ(Atan2(-1, 0), -kPi / 2);
}

TEST(Elementary, ArcSineAndArcCosineClampTheirArgument)
{
  EXPECT_DOUBLE_EQ(Asin(1.0000001), kPi / 2);
  EXPECT_DOUBLE_EQ(Asin(-1.0000001), -kPi / 2);
  EXPECT_DOUBLE_EQ(Acos(2), 0);
  EXPECT_DOUBLE_EQ(Acos(-2), kPi);
  for (double x = -1; x <= 1; x += 0.001)
  {
    EXPECT_NEAR(Asin(x), std::asin(x), 1e-15);
    EXPECT_NEAR(Acos(x), std::acos(x), 1e-15);
  }
}

TEST(Elementary, LogarithmUndoesTheExponential)
{
  for (double x = -700; x <= 700; x += 0.37)
  {
    EXPECT_NEAR(Exp(x) / std::exp(x), 1, 1e-15) << "x = " << x;
    EXPECT_NEAR(Log(Exp(x)), x, 1e-13 * (1 + std::abs(x))) << "x = " << x;
  }
}

TEST(Elementary, WrappedAnglesPointTheSameWay)
{
  for (const double x : Angles())
  {
    const double wrapped = WrapAngle(x);
    EXPECT_GE(wrapped, -kPi);
    EXPECT_LE(wrapped, kPi);
    EXPECT_NEAR(std::remainder(x - wrapped, 2 * kPi), 0, 1e-14 * (1 + std::abs(x)));
  }
}

}  // namespace
}  // namespace swarmanoid

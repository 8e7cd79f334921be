// The library functions of different processors differ in the last bit, and one bit is enough to part two runs. So each
// function here first reduces its argument to a short interval (for angles as W. J. Cody and W. Waite, "Software Manual
// for the Elementary Functions", 1980, do), and then sums a series by Horner's rule. docs/determinism.md states what
// depends on it.
//
// Invariants: only IEEE additions, subtractions, multiplications, divisions and square roots are used, in the order
// that is written here. The compiler may not contract or reorder them. A form for many numbers at once does the same
// operations as the form for one, so that both give the same bits.
#include "common/math/elementary.h"

#include <bit>
#include <cstdint>

namespace swarmanoid
{
namespace
{

// Adding and subtracting 1.5 * 2^52 rounds to the nearest integer.
constexpr double kRounder = 6755399441055744.0;

// The coefficients are those of the Taylor series up to the order at which the rest is below one ulp on the interval.
double SinPolynomial(double x)
{
  const double z = x * x;
  double p = -7.647163731819816e-13;
  p = p * z + 1.6059043836821613e-10;
  p = p * z - 2.505210838544172e-08;
  p = p * z + 2.7557319223985893e-06;
  p = p * z - 1.984126984126984e-04;
  p = p * z + 8.333333333333333e-03;
  p = p * z - 1.6666666666666666e-01;
  return x + x * z * p;
}

double CosPolynomial(double x)
{
  const double z = x * x;
  double p = 4.779477332387385e-14;
  p = p * z - 1.1470745597729725e-11;
  p = p * z + 2.08767569878681e-09;
  p = p * z - 2.755731922398589e-07;
  p = p * z + 2.48015873015873e-05;
  p = p * z - 1.388888888888889e-03;
  p = p * z + 4.1666666666666664e-02;
  return 1.0 - 0.5 * z + z * z * p;
}

// Computes atan(x) for |x| <= tan(pi/16) by the alternating series up to x^23.
double AtanSeries(double x)
{
  const double z = x * x;
  double p = -1.0 / 23.0;
  p = p * z + 1.0 / 21.0;
  p = p * z - 1.0 / 19.0;
  p = p * z + 1.0 / 17.0;
  p = p * z - 1.0 / 15.0;
  p = p * z + 1.0 / 13.0;
  p = p * z - 1.0 / 11.0;
  p = p * z + 1.0 / 9.0;
  p = p * z - 1.0 / 7.0;
  p = p * z + 1.0 / 5.0;
  p = p * z - 1.0 / 3.0;
  return x + x * z * p;
}

// Computes atan(x) for 0 <= x <= 1, reduced by the angle pi/8 (tan = sqrt(2) - 1) or pi/4.
double AtanUnit(double x)
{
  constexpr double kTan8 = 0.41421356237309503;
  constexpr double kTan16 = 0.198912367379658;
  if (x <= kTan16) return AtanSeries(x);
  if (x <= 0.6681786379192989) return kPi / 8 + AtanSeries((x - kTan8) / (1.0 + x * kTan8));
  return kPi / 4 + AtanSeries((x - 1.0) / (1.0 + x));
}

}  // namespace

SinCos SinCosOf(double x)
{
  // The argument is reduced by pi/2 in three parts (Cody and Waite).
  const double quotient = x * (2.0 / kPi);
  const double n = (quotient + kRounder) - kRounder;
  double r = x - n * 1.5707963267341256;
  r -= n * 6.077100506303966e-11;
  r -= n * 2.0222662487959506e-21;
  const double s = SinPolynomial(r);
  const double c = CosPolynomial(r);
  const auto quadrant = static_cast<std::uint64_t>(static_cast<std::int64_t>(n)) & 3U;
  switch (quadrant)
  {
    case 0:
      return {s, c};
    case 1:
      return {c, -s};
    case 2:
      return {-s, -c};
    default:
      return {-c, s};
  }
}

double Sin(double x) { return SinCosOf(x).sin; }
double Cos(double x) { return SinCosOf(x).cos; }

double Atan2(double y, double x)
{
  const double ax = x < 0 ? -x : x;
  const double ay = y < 0 ? -y : y;
  if (ax == 0 && ay == 0) return 0;
  double angle = ay <= ax ? AtanUnit(ay / ax) : kPi / 2 - AtanUnit(ax / ay);
  if (x < 0) angle = kPi - angle;
  return y < 0 ? -angle : angle;
}

void Atan2Each(std::span<const double> y, std::span<const double> x, std::span<double> angles)
{
  constexpr double kTan8 = 0.41421356237309503;
  // The loop selects instead of branching, so that the compiler computes several angles at once. The steps are those of
  // Atan2.
  for (std::size_t i = 0; i < angles.size(); ++i)
  {
    const double ax = x[i] < 0 ? -x[i] : x[i];
    const double ay = y[i] < 0 ? -y[i] : y[i];
    const double shorter = ay <= ax ? ay : ax;
    const double longer = ay <= ax ? ax : ay;
    const double ratio = shorter / (longer == 0 ? 1 : longer);
    double pivot = ratio <= 0.6681786379192989 ? kTan8 : 1;
    double base = ratio <= 0.6681786379192989 ? kPi / 8 : kPi / 4;
    pivot = ratio <= 0.198912367379658 ? 0 : pivot;
    base = ratio <= 0.198912367379658 ? 0 : base;
    const double unit = base + AtanSeries((ratio - pivot) / (1.0 + ratio * pivot));
    double angle = ay <= ax ? unit : kPi / 2 - unit;
    angle = x[i] < 0 ? kPi - angle : angle;
    angles[i] = y[i] < 0 ? -angle : angle;
  }
}

double Asin(double x)
{
  if (x >= 1) return kPi / 2;
  if (x <= -1) return -kPi / 2;
  return Atan2(x, __builtin_sqrt((1 - x) * (1 + x)));
}

double Acos(double x)
{
  if (x >= 1) return 0;
  if (x <= -1) return kPi;
  return Atan2(__builtin_sqrt((1 - x) * (1 + x)), x);
}

double Exp(double x)
{
  if (x != x) return x;
  if (x > 709.782712893384) return __builtin_inf();
  if (x < -745.1332191019411) return 0;
  // The reduction is x = n ln 2 + r with |r| <= 0.35; exp(r) follows from its series.
  const double n = (x * 1.4426950408889634 + kRounder) - kRounder;
  const double r = (x - n * 6.93147180369123816490e-01) - n * 1.90821492927058770002e-10;
  double p = 1.0;
  for (int k = 14; k >= 1; --k) p = 1.0 + p * (r / k);
  // The scale is applied as two factors, so that the smallest results are reached too.
  const auto exponent = static_cast<int>(n);
  const int half = exponent / 2;
  const auto power = [](int e) { return std::bit_cast<double>(static_cast<std::uint64_t>(e + 1023) << 52); };
  return p * power(half) * power(exponent - half);
}

double Log(double x)
{
  auto bits = std::bit_cast<std::uint64_t>(x);
  int exponent = 0;
  if (bits < (1ULL << 52))  // subnormal
  {
    bits = std::bit_cast<std::uint64_t>(x * 18014398509481984.0);
    exponent = -54;
  }
  exponent += static_cast<int>(bits >> 52) - 1023;
  double mantissa = std::bit_cast<double>((bits & 0xfffffffffffffULL) | 0x3ff0000000000000ULL);
  if (mantissa > 1.4142135623730951)
  {
    mantissa *= 0.5;
    ++exponent;
  }
  // The series is log(m) = 2 atanh(s) with s = (m - 1) / (m + 1), |s| < 0.172.
  const double s = (mantissa - 1.0) / (mantissa + 1.0);
  const double z = s * s;
  double p = 1.0 / 21.0;
  for (int k = 19; k >= 3; k -= 2) p = p * z + 1.0 / k;
  return exponent * 6.93147180369123816490e-01 + (2.0 * s + (2.0 * s * z * p + exponent * 1.90821492927058770002e-10));
}

double WrapAngle(double x)
{
  const double turns = (x * (0.5 / kPi) + kRounder) - kRounder;
  return x - turns * (2 * kPi);
}

}  // namespace swarmanoid

// Elementary functions with the same bits on every processor: polynomials over IEEE add, multiply and divide only. The
// functions of glibc (sin, cos, atan2, exp, log) use other code if the processor has FMA, and differ in the last bit.
// Engines, sensors and all other code whose results reach the state hash use these. All angles are in radians.
#pragma once

#include <span>

namespace swarmanoid
{

inline constexpr double kPi = 3.14159265358979323846;

struct SinCos
{
  double sin;
  double cos;
};

// For |x| up to 1e5 the absolute error is below 3e-16. Larger arguments lose accuracy in proportion to |x|.
SinCos SinCosOf(double x);
double Sin(double x);
double Cos(double x);
// Returns an angle in -pi..pi; Atan2(0, 0) is 0.
double Atan2(double y, double x);
// Computes Atan2 of each pair with the same bits, several at a time.
void Atan2Each(std::span<const double> y, std::span<const double> x, std::span<double> angles);
// Clamps arguments outside -1..1.
double Asin(double x);
double Acos(double x);
double Exp(double x);
// Returns the natural logarithm; x must be positive and finite.
double Log(double x);
// Returns x wrapped to -pi..pi.
double WrapAngle(double x);

inline double DegreesToRadians(double degrees) { return degrees * (kPi / 180.0); }
inline double RadiansToDegrees(double radians) { return radians * (180.0 / kPi); }

}  // namespace swarmanoid

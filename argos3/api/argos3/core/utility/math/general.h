// Elementary functions with the names of ARGoS3.
#pragma once

#include <argos3/core/utility/datatypes/datatypes.h>

#include <utility>

namespace argos
{

template <class T>
constexpr T Abs(const T& value)
{
  return value < T(0) ? T(-value) : value;
}
inline Real Log(Real value) { return std::log(value); }
inline Real Sqrt(Real value) { return std::sqrt(value); }
inline Real Exp(Real value) { return std::exp(value); }

template <class T>
constexpr T Min(const T& a, const T& b)
{
  return a < b ? a : b;
}
template <class T>
constexpr T& Min(T& a, T& b)
{
  return a < b ? a : b;
}
template <class T>
constexpr T Max(const T& a, const T& b)
{
  return a > b ? a : b;
}
template <class T>
constexpr T& Max(T& a, T& b)
{
  return a > b ? a : b;
}
// Returns -1, 0 or 1.
template <class T>
constexpr SInt32 Sign(const T& value)
{
  return value > T(0) ? 1 : value < T(0) ? -1 : 0;
}
template <class T>
constexpr T Square(const T& value)
{
  return value * value;
}
// A negative number is truncated and decremented, as in ARGoS3, so the result for a negative whole number is one less.
inline SInt32 Floor(Real value)
{
  const auto whole = static_cast<SInt32>(value);
  return value >= 0 ? whole : whole - 1;
}
inline SInt32 Ceil(Real value)
{
  const auto whole = static_cast<SInt32>(value);
  return whole < value ? whole + 1 : whole;
}
inline SInt32 RoundClosestToZero(Real value) { return value > 0 ? Floor(value) : Ceil(value); }
inline SInt32 Round(Real value) { return value > 0 ? Floor(value + 0.5) : Ceil(value - 0.5); }
inline Real Mod(Real a, Real b) { return std::fmod(a, b); }

inline bool DoubleEqAbsolute(Real a, Real b, Real epsilon)
{
  return Abs(a - b) <= epsilon * std::max({1.0, Abs(a), Abs(b)});
}
inline bool DoubleEq(Real a, Real b) { return DoubleEqAbsolute(a, b, 0.0001); }

// Interpolates linearly between points, whose x must ascend. Beyond them it continues the first and the last line.
inline Real Interpolate(Real x, const std::vector<std::pair<Real, Real>>& points)
{
  std::size_t last = 1;
  while (last + 1 < points.size() && points.at(last).first < x) ++last;
  const auto& [x0, y0] = points.at(last - 1);
  const auto& [x1, y1] = points.at(last);
  return y0 + (x - x0) * (y1 - y0) / (x1 - x0);
}

}  // namespace argos

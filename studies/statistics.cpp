#include "studies/statistics.h"

#include <cmath>
#include <limits>

#include "common/math/elementary.h"

namespace swarmanoid
{

double StudentsT(std::size_t freedom)
{
  constexpr double kBoth = 0.05;  // outside, on both sides
  constexpr double kNormal = -1.959963984540054;
  if (freedom == 1) return std::tan(kPi / 2 * (1 - kBoth));
  if (freedom == 2) return std::sqrt(2 / (kBoth * (2 - kBoth)) - 2);
  const auto n = static_cast<double>(freedom);
  const double a = 1 / (n - 0.5);
  const double b = 48 / (a * a);
  double c = ((20700 * a / b - 98) * a - 16) * a + 96.36;
  const double d = ((94.5 / (b + c) - 3) / b + 1) * std::sqrt(a * kPi / 2) * n;
  double y = std::pow(d * kBoth, 2 / n);
  if (y > 0.05 + a)
  {
    y = kNormal * kNormal;
    if (freedom < 5) c += 0.3 * (n - 4.5) * (kNormal + 0.6);
    c += (((0.05 * d * kNormal - 5) * kNormal - 7) * kNormal - 2) * kNormal + b;
    y = (((((0.4 * y + 6.3) * y + 36) * y + 94.5) / c - y - 3) / b + 1) * kNormal;
    y = std::expm1(a * y * y);
  }
  else
  {
    y = ((1 / (((n + 6) / (n * y) - 0.089 * d - 0.822) * (n + 2) * 3) + 0.5 / (n + 4)) * y - 1) * (n + 1) / (n + 2) +
        1 / y;
  }
  return std::sqrt(n * y);
}

MeanInterval MeanIntervalOf(const std::vector<double>& values)
{
  MeanInterval found;
  const auto count = static_cast<double>(values.size());
  for (const double value : values) found.mean += value / count;
  found.half = std::numeric_limits<double>::infinity();
  if (values.size() < 2) return found;
  double squares = 0;
  for (const double value : values) squares += (value - found.mean) * (value - found.mean);
  found.half = StudentsT(values.size() - 1) * std::sqrt(squares / (count - 1) / count);
  return found;
}

}  // namespace swarmanoid

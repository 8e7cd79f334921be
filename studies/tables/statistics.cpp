// The confidence interval of a mean is that of Student's t for values of equal normal distribution: mean +- t(0.975, n
// - 1) s / sqrt(n), with the standard deviation s of the sample.
#include "studies/tables/statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>

namespace swarmanoid
{

double StudentsT(std::size_t freedom)
{
  return boost::math::quantile(boost::math::students_t(static_cast<double>(freedom)), 0.975);
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

std::string IntervalText(const MeanInterval& interval)
{
  if (!std::isfinite(interval.half) || interval.half <= 0)
    return fmt::format("{:.4g} ± {:.2g}", interval.mean, interval.half);
  const int decimals = 1 - static_cast<int>(std::floor(std::log10(interval.half)));
  const double unit = std::pow(10.0, std::min(decimals, 0));  // rounds to tens and hundreds
  return fmt::format("{:.{}f} ± {:.{}f}", decimals < 0 ? std::round(interval.mean * unit) / unit : interval.mean,
                     std::max(decimals, 0), decimals < 0 ? std::round(interval.half * unit) / unit : interval.half,
                     std::max(decimals, 0));
}

}  // namespace swarmanoid

#include "studies/statistics.h"

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

}  // namespace swarmanoid

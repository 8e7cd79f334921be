// The exact test of Wilcoxon counts sums of ranks by a convolution over the ranks.
//
// The confidence interval of a mean is that of Student's t for values of equal normal distribution: mean +- t(0.975, n
// - 1) s / sqrt(n), with the standard deviation s of the sample.
#include "studies/tables/statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>
#include <numeric>

namespace swarmanoid
{
namespace
{

constexpr std::size_t kMostExactPairs = 60;

}  // namespace

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

std::vector<double> RanksOf(const std::vector<double>& values)
{
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  std::vector<double> ranks(values.size());
  for (std::size_t first = 0, end = 0; first < order.size(); first = end)
  {
    while (end < order.size() && values[order[end]] == values[order[first]]) ++end;
    for (std::size_t i = first; i < end; ++i) ranks[order[i]] = static_cast<double>(first + end + 1) / 2;
  }
  return ranks;
}

FriedmanTest FriedmanTestOf(const std::vector<std::vector<double>>& blocks, double level)
{
  const auto b = static_cast<double>(blocks.size());
  const auto k = static_cast<double>(blocks.front().size());
  FriedmanTest test;
  test.rank_sums.resize(blocks.front().size());
  double squares = 0;  // of all ranks
  for (const std::vector<double>& block : blocks)
  {
    const std::vector<double> ranks = RanksOf(block);
    for (std::size_t i = 0; i < ranks.size(); ++i)
    {
      test.rank_sums[i] += ranks[i];
      squares += ranks[i] * ranks[i];
    }
  }
  const double mean = b * (k + 1) / 2;  // of the rank sums
  double between = 0, sums = 0;
  for (const double sum : test.rank_sums)
  {
    between += (sum - mean) * (sum - mean);
    sums += sum * sum;
  }
  const double within = squares - b * k * (k + 1) * (k + 1) / 4;
  if (within <= 0) return test;
  const double statistic = (k - 1) * between / within;
  test.p = boost::math::cdf(boost::math::complement(boost::math::chi_squared(k - 1), statistic));
  const double freedom = (b - 1) * (k - 1);
  test.critical_difference = freedom < 1 ? std::numeric_limits<double>::quiet_NaN()
                                         : boost::math::quantile(boost::math::students_t(freedom), 1 - level / 2) *
                                               std::sqrt(std::max(0.0, 2 * (b * squares - sums) / freedom));
  return test;
}

double WilcoxonP(const std::vector<double>& differences)
{
  std::vector<double> sizes;
  std::vector<bool> is_positive;
  for (const double difference : differences)
    if (difference != 0)
    {
      sizes.push_back(std::abs(difference));
      is_positive.push_back(difference > 0);
    }
  if (sizes.empty()) return 1;
  const std::vector<double> ranks = RanksOf(sizes);
  double positive = 0, all = 0, squares = 0;
  for (std::size_t i = 0; i < ranks.size(); ++i)
  {
    positive += is_positive[i] ? ranks[i] : 0;
    all += ranks[i];
    squares += ranks[i] * ranks[i];
  }
  const double smaller = std::min(positive, all - positive);
  if (ranks.size() >= kMostExactPairs)
  {
    const double z = std::min(0.0, (smaller + 0.5 - all / 2) / std::sqrt(squares / 4));
    return std::min(1.0, 2 * boost::math::cdf(boost::math::normal(), z));
  }
  // The probability of each sum of positive ranks, in halves, if all signs are equally probable.
  std::vector<double> probability(static_cast<std::size_t>(2 * all) + 1);
  probability[0] = 1;
  std::size_t most = 0;
  for (const double rank : ranks)
  {
    const auto halves = static_cast<std::size_t>(2 * rank);
    most += halves;
    for (std::size_t sum = most + 1; sum-- > 0;)
      probability[sum] = (probability[sum] + (sum >= halves ? probability[sum - halves] : 0)) / 2;
  }
  const double below =
      std::accumulate(probability.begin(), probability.begin() + static_cast<std::ptrdiff_t>(2 * smaller) + 1, 0.0);
  return std::min(1.0, 2 * below);
}

std::string IntervalText(const MeanInterval& interval)
{
  if (!std::isfinite(interval.half) || interval.half <= 0)
    return fmt::format("{:.4g} ± {:.2g}", interval.mean, interval.half);
  const int decimals = 1 - static_cast<int>(std::floor(std::log10(interval.half)));
  const double unit = std::pow(10.0, decimals);
  const auto text = [&](double value)
  {
    if (std::abs(value) * unit < 0.5) value = 0;                // and not -0
    if (decimals < 0) value = std::round(value * unit) / unit;  // to tens and hundreds
    return fmt::format("{:.{}f}", value, std::max(decimals, 0));
  };
  return text(interval.mean) + " ± " + text(interval.half);
}

}  // namespace swarmanoid

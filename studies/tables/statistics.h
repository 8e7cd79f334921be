// The statistics that decide when a study with --until-ci ends, and which points a race drops.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace swarmanoid
{

// Returns Student's t of 97.5 % for a number of degrees of freedom, from 1 on.
double StudentsT(std::size_t freedom);

struct MeanInterval
{
  double mean = 0;
  double half = 0;  // half of the confidence interval of 95 %; infinite for less than two values
};
MeanInterval MeanIntervalOf(const std::vector<double>& values);
// Returns the ranks of values from 1 on; equal values share the mean of their ranks.
std::vector<double> RanksOf(const std::vector<double>& values);

// Friedman's test whether one of several treatments tends to other values than the others, with equal ranks counted.
struct FriedmanTest
{
  std::vector<double> rank_sums;  // by treatment
  double p = 1;                   // by the chi-squared distribution; 1 if all values are equal
  // Treatments whose rank sums differ by more are different at this level (Conover, "Practical Nonparametric
  // Statistics", 1999, section 5.8). Not a number for one block.
  double critical_difference = 0;
};
// `blocks`: for each block, here a seed, the values of all treatments, two or more. `level`: such as 0.05.
FriedmanTest FriedmanTestOf(const std::vector<std::vector<double>>& blocks, double level);

// Returns the two-sided p of Wilcoxon's signed-rank test of pairs. Pairs without a difference are left out. It is
// exact, also with equal differences: all signs of the given ranks are counted. From 60 pairs on it is the normal
// approximation with a correction for continuity.
double WilcoxonP(const std::vector<double>& differences);

// Returns "0.046 ± 0.025": both to the second digit of the interval.
std::string IntervalText(const MeanInterval& interval);

}  // namespace swarmanoid

// The statistics that decide when a study with --until-ci ends.
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
// Returns "0.046 ± 0.025": both to the second digit of the interval.
std::string IntervalText(const MeanInterval& interval);

}  // namespace swarmanoid

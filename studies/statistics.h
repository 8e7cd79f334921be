// What the end of a study with --until-ci is decided by.
#pragma once

#include <cstddef>
#include <vector>

namespace swarmanoid
{

// Student's t of 97.5 % for a number of degrees of freedom, from 1 on.
double StudentsT(std::size_t freedom);

struct MeanInterval
{
  double mean = 0;
  double half = 0;  // of its confidence interval of 95 %; infinite for less than two values
};
MeanInterval MeanIntervalOf(const std::vector<double>& values);

}  // namespace swarmanoid

// An estimate of the time and the disk space that a study needs, from short runs of a few of its points.
#pragma once

#include <string>

#include "studies/design/design.h"

namespace swarmanoid
{

struct StudyEstimate
{
  std::string failure;        // why there is no estimate; empty: there is one
  double seconds_of_run = 0;  // of one process or one cluster
  double bytes_of_run = 0;    // in the folder of the study
};

// Executes the first ticks of points that differ as much as possible. It takes some seconds at most, unless an
// experiment needs longer to begin.
StudyEstimate EstimateOf(const Study& study, const Design& design);

// Returns "3.1 MB" for a number of bytes.
std::string RoughSize(double bytes);

}  // namespace swarmanoid

// A study with a <search> for the best values of its factors. Each place that the algorithm asks for is a point of the
// study, stored in its database. So a killed search asks again from the beginning, and continues where the answers end.
#pragma once

#include "studies/design/study.h"
#include "studies/tables/study_store.h"

namespace swarmanoid
{

struct SearchOptions
{
  unsigned jobs = 0;  // runs at a time; 0: one for each core, or one cluster
  unsigned retries = 0;
  bool quiet = false;
};

// Returns the exit code.
int RunSearch(const SearchOptions& options, const Study& study, StudyStore& store);
// Throws ConfigurationError if the search cannot begin.
void CheckSearch(const Study& study);
// Writes the plan of the search to standard output.
void DescribeSearch(const Study& study);

}  // namespace swarmanoid

// A study with a <search>: which values of its factors are the best. Every value that the algorithm asks for is a point
// of the study, kept in its database, so that a search that was killed asks again from its beginning and goes on where
// the answers end.
#pragma once

#include "studies/design.h"
#include "studies/study_store.h"

namespace swarmanoid
{

struct SearchOptions
{
  unsigned jobs = 0;  // runs at a time; 0: as many as cores, or one cluster
  unsigned retries = 0;
  bool quiet = false;
};

// Returns the exit code.
int RunSearch(const SearchOptions& options, const Study& study, const Design& design, StudyStore& store);
// Throws ConfigurationError if it cannot begin.
void CheckSearch(const Study& study);
// What it would do, on standard output.
void DescribeSearch(const Study& study);

}  // namespace swarmanoid

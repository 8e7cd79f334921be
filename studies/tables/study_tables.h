// Makes the tables in the database of a study, as docs/studies.md describes them, and the first rows of runs.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "studies/design/design.h"
#include "studies/tables/study_database.h"

namespace swarmanoid
{

// The version of the tables, stored as the fact "format".
constexpr int kStoreFormat = 2;

std::string NameInSql(const std::string& name);

// Makes the tables with the facts of the study and, unless it is a search, with all its runs. `folder`: that of the
// study's results, which exists.
void MakeStudyTables(StudyDatabase& database, const Study& study, const Design& design, const std::string& folder);

// Returns the factors in the order of the file.
std::vector<std::string> FactorsIn(StudyDatabase& database);
// Returns the columns of metrics.
std::vector<std::string> MetricColumnsIn(StudyDatabase& database);

// Returns the checksum of all rows of a query and of the previous checksum. SQLite itself has none: it reads a flipped
// bit as another value.
std::string ChecksumOfRows(SqlCommand& rows, const std::string& before);
// The name of the fact with the checksum of the other facts.
inline constexpr const char* kFactsChecksum = "checksum";
std::string ChecksumOfFacts(StudyDatabase& database);

// Returns a command for AddWaitingRuns, for a study with so many factors.
std::unique_ptr<SqlCommand> WaitingRun(StudyDatabase& database, std::size_t factors);
// Adds the runs of a point. `values`: one for each factor.
void AddWaitingRuns(SqlCommand& waiting_run, std::size_t point, const std::vector<ExpressionValue>& values,
                    const std::vector<std::uint64_t>& seeds);

}  // namespace swarmanoid

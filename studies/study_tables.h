// The tables in the database of a study, as docs/studies.md describes them: made, and how rows of runs begin.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "studies/design.h"
#include "studies/study_database.h"

namespace swarmanoid
{

// Of the tables; the fact "format".
constexpr int kStoreFormat = 2;

std::string NameInSql(const std::string& name);

// With the facts of the study and, if it is no search, with all its runs.
void MakeStudyTables(StudyDatabase& database, const Study& study, const Design& design);

// In the order of the file.
std::vector<std::string> FactorsIn(StudyDatabase& database);
// Columns of metrics.
std::vector<std::string> MetricColumnsIn(StudyDatabase& database);

// The checksum of all rows of a query and of the checksum before it. SQLite has none: it reads a flipped bit as another
// value.
std::string ChecksumOfRows(SqlCommand& rows, const std::string& before);
// The name of the fact that has the checksum of the others.
inline constexpr const char* kFactsChecksum = "checksum";
std::string ChecksumOfFacts(StudyDatabase& database);

// A command for AddWaitingRuns, of a study with so many factors.
std::unique_ptr<SqlCommand> WaitingRun(StudyDatabase& database, std::size_t factors);
// The runs of a point. `values`: one for each factor.
void AddWaitingRuns(SqlCommand& waiting_run, std::size_t point, const std::vector<ExpressionValue>& values,
                    const std::vector<std::uint64_t>& seeds);

}  // namespace swarmanoid

// The tables follow from the study: one column for each factor and metric, with the names that users chose, in quotes.
// `runs` has a row for each run from the start, waiting at first, so the database alone tells what is left to do. A
// checksum over the image of each row (type and bits of each column, not its text) shows rows that were changed by hand
// or damaged.
#include "studies/tables/study_tables.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include <fmt/format.h>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include "common/configuration/configuration_tree.h"
#include "common/version/version.h"
#include "studies/design/units.h"
#include "studies/metrics/recorder.h"

namespace swarmanoid
{
namespace
{

void MakeTables(StudyDatabase& database, const Study& study)
{
  std::string factors, metrics, of_results;
  for (const Factor* factor : study.Factors())
  {
    factors += fmt::format(", {} {}", NameInSql(factor->id), factor->is_numeric ? "REAL" : "TEXT");
    of_results += ", r." + NameInSql(factor->id);
  }
  of_results += ", r.seed, s.tick, s.time_s";
  for (const std::string& column : MetricColumns(study))
  {
    metrics += fmt::format(", {} REAL", NameInSql(column));
    of_results += ", s." + NameInSql(column);
  }
  database.Execute("CREATE TABLE study (name TEXT PRIMARY KEY, value TEXT)");
  database.Execute(
      "CREATE TABLE runs (point INTEGER, seed INTEGER, state TEXT, attempts INTEGER, exit INTEGER, hash TEXT, ticks "
      "INTEGER, failure TEXT, wall_s REAL, peak_bytes INTEGER, host TEXT, version TEXT, checksum TEXT" +
      factors + ", PRIMARY KEY (point, seed))");
  database.Execute("CREATE TABLE samples (point INTEGER, seed INTEGER, tick INTEGER, time_s REAL" + metrics +
                   ", PRIMARY KEY (point, seed, tick)) WITHOUT ROWID");
  database.Execute(
      "CREATE TABLE grids (point INTEGER, seed INTEGER, metric TEXT, columns INTEGER, rows INTEGER, cell_m REAL, "
      "visits BLOB, PRIMARY KEY (point, seed, metric))");
  database.Execute(
      "CREATE TABLE ways (point INTEGER, seed INTEGER, entities TEXT, samples INTEGER, places BLOB, PRIMARY KEY "
      "(point, seed))");
  database.Execute(
      "CREATE VIEW results AS SELECT r.point" + of_results +
      ", r.exit, r.hash FROM runs r JOIN samples s ON r.point = s.point AND r.seed = s.seed WHERE r.state = 'done'");
}

void AddFacts(StudyDatabase& database, const Study& study, const Design& design, const std::string& folder)
{
  std::error_code none;
  const auto fact = database.Prepare("INSERT INTO study VALUES (?, ?)");
  for (const auto& [name, value] : std::vector<std::pair<std::string, std::string>>{
           {"format", std::to_string(kStoreFormat)},
           {"name", study.name},
           {"study", study.text},
           {"folder", study.folder},
           {"folder_from_here", std::filesystem::relative(study.folder, folder, none).string()},
           {"experiments", design.ExperimentsHash()},
           {"version", Version()},
           {"revision", GitRevision()},
           {"search", study.search ? study.search->column : ""},
           {"algorithm", study.search ? study.search->algorithm : ""},
           {"goal", study.search && !study.search->maximise ? "min" : "max"},
           {"aggregate", study.search ? study.search->aggregate : ""},
           {"seeds", fmt::format("{}", fmt::join(study.seeds, " "))},
           {"units", nlohmann::json(UnitsOf(study, design)).dump()}})
    fact->Bind(name).Bind(value).Run();
  fact->Bind(std::string(kFactsChecksum)).Bind(ChecksumOfFacts(database)).Run();
}

void AddAllRuns(StudyDatabase& database, const Study& study, const Design& design)
{
  const std::vector<const Factor*> factors = study.Factors();
  const auto run = WaitingRun(database, factors.size());
  std::vector<ExpressionValue> values(factors.size());
  for (std::size_t point = 0; point < design.Points(); ++point)
  {
    const std::vector<const FactorLevel*> levels = design.Levels(point);
    for (std::size_t f = 0; f < factors.size(); ++f)
    {
      if (factors[f]->is_numeric)
        values[f] = *ParseNumber(levels[f]->value);
      else
        values[f] = levels[f]->value;
    }
    AddWaitingRuns(*run, point, values, study.seeds);
  }
}

// Returns the columns of the view of results between two of its fixed columns.
std::vector<std::string> ResultsBetween(StudyDatabase& database, const std::string& first, const std::string& last)
{
  std::vector<std::string> names;
  const auto rows = database.Prepare("SELECT name FROM pragma_table_info('results')");
  while (rows->Step()) names.push_back(rows->Text(0));
  const auto begin = std::find(names.begin(), names.end(), first);
  const auto end = std::find(begin, names.end(), last);
  return begin == end ? std::vector<std::string>{} : std::vector<std::string>(begin + 1, end);
}

}  // namespace

std::string NameInSql(const std::string& name) { return "\"" + name + "\""; }

void MakeStudyTables(StudyDatabase& database, const Study& study, const Design& design, const std::string& folder)
{
  database.Execute("BEGIN");
  MakeTables(database, study);
  AddFacts(database, study, design, folder);
  // A search adds its points itself.
  if (!study.search) AddAllRuns(database, study, design);
  database.Execute("COMMIT");
}

std::vector<std::string> FactorsIn(StudyDatabase& database) { return ResultsBetween(database, "point", "seed"); }

std::vector<std::string> MetricColumnsIn(StudyDatabase& database) { return ResultsBetween(database, "time_s", "exit"); }

std::string ChecksumOfRows(SqlCommand& rows, const std::string& before)
{
  std::uint64_t hash = XXH3_64bits(before.data(), before.size());
  while (rows.Step())
  {
    std::string row;
    for (int column = 0; column < rows.Columns(); ++column) row += rows.Image(column);
    hash = XXH3_64bits_withSeed(row.data(), row.size(), hash);
  }
  return fmt::format("{:016x}", hash);
}

std::string ChecksumOfFacts(StudyDatabase& database)
{
  const auto rows = database.Prepare("SELECT name, value FROM study WHERE name != ? ORDER BY name");
  rows->Bind(std::string(kFactsChecksum));
  return ChecksumOfRows(*rows, {});
}

std::unique_ptr<SqlCommand> WaitingRun(StudyDatabase& database, std::size_t factors)
{
  std::string places;
  for (std::size_t f = 0; f < factors; ++f) places += ", ?";
  return database.Prepare(
      "INSERT INTO runs VALUES (?, ?, 'waiting', 0, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL" + places +
      ")");
}

void AddWaitingRuns(SqlCommand& waiting_run, std::size_t point, const std::vector<ExpressionValue>& values,
                    const std::vector<std::uint64_t>& seeds)
{
  for (const std::uint64_t seed : seeds)
  {
    waiting_run.BindWhole(point).BindWhole(seed);
    for (const ExpressionValue& value : values)
    {
      if (const double* number = std::get_if<double>(&value))
        waiting_run.Bind(*number);
      else
        waiting_run.Bind(std::get<std::string>(value));
    }
    waiting_run.Run();
  }
}

}  // namespace swarmanoid

// The folder of a study on disk. study.sqlite has every run with its state, parameters and results; table.csv is made
// from it. Committed data survives any end of the process. Only one process at a time works on a folder.
// docs/studies.md describes the tables.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "studies/design/design.h"
#include "studies/runs/run_order.h"
#include "studies/tables/study_database.h"

namespace swarmanoid
{

class StudyStore
{
public:
  // Makes a study in a new or empty folder. Throws StudyStoreError.
  static std::unique_ptr<StudyStore> Create(const std::string& folder, const Study& study, const Design& design);
  // Opens an existing study. Throws StudyStoreError if the folder is no study, is damaged, or is in use by another
  // process. Damaged results are dropped, so that these runs wait again, and standard error names them.
  static std::unique_ptr<StudyStore> Open(const std::string& folder);
  // Throws StudyStoreError if the folder is no study, or if its content does not fit a checksum. It changes nothing, so
  // another process may work on the study meanwhile.
  static void RequireWhole(const std::string& folder);
  ~StudyStore();

  const std::string& Folder() const { return folder_; }
  // Returns the fact "study" (the text of its file), "name" or "experiments" (their hash).
  std::string Fact(const std::string& name);
  // Returns the folders where relative paths of the study may start now: first the one that lies to this folder as at
  // the beginning, for a study that was moved together with its experiments, then the one of the beginning.
  std::vector<std::string> StartsOfPaths();

  struct RunState
  {
    RunName name;
    bool is_done = false;
    bool has_failed = false;
    unsigned attempts = 0;
    double wall_s = 0;  // for a finished run
  };
  // Returns the runs in the order of points and seeds.
  std::vector<RunState> Runs();
  bool IsDone(const RunName& name);
  void Add(const RunOutcome& outcome);
  // Adds another run to a point that has some.
  void AddRun(const RunName& name);
  // Adds a point of a search, with its runs. `values`: one for each factor.
  void AddPoint(std::uint32_t point, const std::vector<ExpressionValue>& values,
                const std::vector<std::uint64_t>& seeds);
  // Returns the factors' values of all points that have runs, by number.
  std::vector<std::pair<std::uint32_t, std::vector<ExpressionValue>>> PointValues();
  // Returns the values of all finished runs at their last tick; NaN for none.
  std::map<RunName, double> LastValues(const std::string& column);
  // Returns the values of all finished runs of a point at their last tick, by seed, without runs that have none.
  std::vector<double> LastValues(std::uint32_t point, const std::string& column);
  // Returns the columns of the metrics.
  const std::vector<std::string>& Columns() const { return columns_; }
  // Makes all additions permanent.
  void Commit();
  // Writes table.csv: one row for each run with a result and each measured tick. Equal studies give equal bytes.
  void WriteTable();

private:
  explicit StudyStore(std::string folder);
  std::string PathInFolder(const char* file) const;
  void Lock();
  void MakeDatabase(const Study& study, const Design& design);
  void Connect();
  void ReadColumns();
  void PrepareCommands();
  void Begin();
  void AddSamples(const RunOutcome& outcome);
  // Returns the checksum of all data of a run: its factors, its result and its measurements.
  std::string ChecksumOf(const RunName& name);
  // Throws StudyStoreError if the facts of the study are damaged, or of another version. Reads the columns.
  void RequireGoodFacts();
  // Returns the finished runs whose results do not fit their checksums.
  std::vector<RunName> DamagedRuns();
  void DropDamagedResults();

  std::string folder_;
  int lock_ = -1;
  std::unique_ptr<StudyDatabase> database_;
  bool in_transaction_ = false;
  std::vector<std::string> factors_;
  std::vector<std::string> columns_;  // the metrics' columns
  std::unique_ptr<SqlCommand> update_run_, add_sample_;
};

}  // namespace swarmanoid

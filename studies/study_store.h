// The folder of a study on disk: study.sqlite, which has every run with its state, parameters and results, and
// table.csv, which is made from it. What was committed stays, however the process ends. One process at a time works on
// a folder. docs/studies.md describes the tables.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "studies/design.h"
#include "studies/run_order.h"
#include "studies/study_database.h"

namespace swarmanoid
{

class StudyStore
{
public:
  // A new folder, or an empty one. Throws StudyStoreError.
  static std::unique_ptr<StudyStore> Create(const std::string& folder, const Study& study, const Design& design);
  // One that is there. Throws StudyStoreError if it is no study, is damaged, or somebody else works on it. Results of
  // runs that are damaged are dropped, so that these runs wait again, and standard error names them.
  static std::unique_ptr<StudyStore> Open(const std::string& folder);
  // Throws StudyStoreError if the folder is no study, or if something in it does not fit its checksum. Changes nothing,
  // also while another process works on the study.
  static void RequireWhole(const std::string& folder);
  ~StudyStore();

  const std::string& Folder() const { return folder_; }
  // "study" (the text of its file), "folder" (relative paths start there), "name", "experiments" (their hash).
  std::string Fact(const std::string& name);

  struct RunState
  {
    RunName name;
    bool is_done = false;
    bool has_failed = false;
    unsigned attempts = 0;
    double wall_s = 0;  // of a run that is done
  };
  // In the order of points and seeds.
  std::vector<RunState> Runs();
  bool IsDone(const RunName& name);
  void Add(const RunOutcome& outcome);
  // Another run of a point that has some.
  void AddRun(const RunName& name);
  // A point of a search, with its runs. `values`: one for each factor.
  void AddPoint(std::uint32_t point, const std::vector<ExpressionValue>& values,
                const std::vector<std::uint64_t>& seeds);
  // Of all points that have runs, by number: their factors' values.
  std::vector<std::pair<std::uint32_t, std::vector<ExpressionValue>>> PointValues();
  // Of all runs that are done, at their last tick; NaN for none.
  std::map<RunName, double> LastValues(const std::string& column);
  // Of all runs of a point that are done, at their last tick, by seed; without those that have none.
  std::vector<double> LastValues(std::uint32_t point, const std::string& column);
  // Of the metrics.
  const std::vector<std::string>& Columns() const { return columns_; }
  // What was added stays from now on.
  void Commit();
  // table.csv: one row for each run that has a result and tick that was measured. Equal studies give equal bytes.
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
  // Of all that is kept of a run: its factors, its result and what was measured.
  std::string ChecksumOf(const RunName& name);
  // Throws StudyStoreError if what the database says of the study is damaged, or it is of another version. Reads the
  // columns.
  void RequireGoodFacts();
  // The runs that are done, and whose results do not fit their checksums.
  std::vector<RunName> DamagedRuns();
  void DropDamagedResults();

  std::string folder_;
  int lock_ = -1;
  std::unique_ptr<StudyDatabase> database_;
  bool in_transaction_ = false;
  std::vector<std::string> factors_;
  std::vector<std::string> columns_;  // of metrics
  std::unique_ptr<SqlCommand> update_run_, add_sample_;
};

}  // namespace swarmanoid

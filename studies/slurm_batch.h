// The files of one array of Slurm's tasks, in `slurm/` of the study's folder, which all machines see: what each task
// has to run, and the results, each whole or not at all. The process that writes the study makes and removes them;
// tasks read their orders and write results.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "studies/run_order.h"

namespace swarmanoid
{

class SlurmBatch
{
public:
  // Writes the files of a new batch; not its job yet. Throws std::runtime_error that names the file.
  static SlurmBatch Create(const std::string& study_folder, const std::vector<char>& setup,
                           const std::vector<RunOrder>& orders, std::size_t runs_per_task);
  // Those that are there, in order.
  static std::vector<SlurmBatch> FindAll(const std::string& study_folder);

  const std::string& Job() const { return job_; }
  void SetJob(const std::string& job);
  std::string Script() const { return folder_ + "/run.sh"; }
  std::string LogPattern() const { return folder_ + "/task-%a.log"; }
  // Of each task, the runs without a result.
  std::map<std::size_t, std::vector<RunName>>& Outstanding() { return outstanding_; }
  const std::map<std::size_t, std::vector<RunName>>& Outstanding() const { return outstanding_; }
  // Results that have come since the last call, of runs that had none. A damaged one is the outcome of a failed run.
  std::vector<RunOutcome> TakeResults();
  // Empties the files of the results that were taken: they need not be taken again.
  void RemoveTaken();
  // All files: no run of it is outstanding any more.
  void Remove();
  // The last line of what a task said; empty if it said nothing.
  std::string LastLineOfTask(std::size_t task) const;
  // A copy of what it said, if that is something, into the folder of one of its runs.
  void KeepLogOfTask(std::size_t task, const RunName& name) const;

  // In a task. Both throw std::runtime_error.
  static std::vector<char> ReadSetup(const std::string& folder);
  static std::vector<RunOrder> ReadOrders(const std::string& folder, std::size_t task);
  static void WriteResult(const std::string& folder, const RunOutcome& outcome);
  // Whether there was one already, taken or not: Slurm may start a task twice.
  static bool HasResult(const std::string& folder, const RunName& name);

private:
  bool Settle(const RunName& name);  // false if it had a result before
  explicit SlurmBatch(std::string folder) : folder_(std::move(folder)) {}

  std::string folder_;
  std::string job_;
  std::map<std::size_t, std::vector<RunName>> outstanding_;
  std::set<std::string> taken_;  // paths of results
};

}  // namespace swarmanoid

// The files of one array of Slurm's tasks, in `slurm/` of the study's folder, which all machines see. They contain the
// orders of each task, and complete results. The process that writes the study makes and removes them. Tasks read their
// orders and write results.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "studies/runs/run_order.h"

namespace swarmanoid
{

class SlurmBatch
{
public:
  // Writes the files of a new batch, without its job number. Throws std::runtime_error with the name of the file.
  static SlurmBatch Create(const std::string& study_folder, const std::vector<char>& setup,
                           const std::vector<RunOrder>& orders, std::size_t runs_per_task);
  // Returns the existing batches in order.
  static std::vector<SlurmBatch> FindAll(const std::string& study_folder);

  const std::string& Job() const { return job_; }
  // Stores the number of the submitted job.
  void SetJob(const std::string& job);
  std::string Script() const { return folder_ + "/run.sh"; }
  std::string LogPattern() const { return folder_ + "/task-%a.log"; }
  // Returns, by task, the runs without a result.
  std::map<std::size_t, std::vector<RunName>>& Outstanding() { return outstanding_; }
  const std::map<std::size_t, std::vector<RunName>>& Outstanding() const { return outstanding_; }
  // Returns new results since the last call, for runs that had none. A damaged result becomes the outcome of a failed
  // run.
  std::vector<RunOutcome> TakeResults();
  // Empties the files of the results that were taken, so that they are not taken again.
  void RemoveTaken();
  // Removes all files, when no run of the batch is outstanding.
  void Remove();
  // Returns the last line of a task's log; empty if it has none.
  std::string LastLineOfTask(std::size_t task) const;
  // Copies a non-empty log of the task into the folder of one of its runs.
  void KeepLogOfTask(std::size_t task, const RunName& name) const;

  // These functions are for tasks. Both throw std::runtime_error.
  static std::vector<char> ReadSetup(const std::string& folder);
  static std::vector<RunOrder> ReadOrders(const std::string& folder, std::size_t task);
  static void WriteResult(const std::string& folder, const RunOutcome& outcome);
  // Returns whether a result exists already, taken or not, since Slurm may start a task twice.
  static bool HasResult(const std::string& folder, const RunName& name);

private:
  bool Settle(const RunName& name);  // returns false if it had a result before
  explicit SlurmBatch(std::string folder) : folder_(std::move(folder)) {}

  std::string folder_;
  std::string job_;
  std::map<std::size_t, std::vector<RunName>> outstanding_;
  std::set<std::string> taken_;  // the paths of results
};

}  // namespace swarmanoid

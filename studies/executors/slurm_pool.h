// Runs a study as job arrays of Slurm. Jobs continue when this process ends; another process finds them by the study's
// folder. One thread.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "studies/executors/executor.h"
#include "studies/executors/slurm.h"
#include "studies/executors/slurm_batch.h"
#include "studies/tables/study_store.h"

namespace swarmanoid
{

struct SlurmChoice
{
  std::vector<std::string> options;  // options for sbatch
  unsigned tasks_at_a_time = 0;      // 0: no limit
  unsigned runs_per_task = 0;        // 0: chosen so that there are at most 200 tasks
};

class SlurmPool final : public Executor
{
public:
  // Finds earlier jobs of the study. `setup`: from SetupOf. Throws std::runtime_error.
  SlurmPool(SlurmChoice choice, std::vector<char> setup, std::string study_folder);

  bool HasRoom() const override { return true; }
  void Give(RunOrder order) override;
  bool IsIdle() const override;
  // Submits the runs since the last call. After an interrupt it cancels the jobs.
  std::vector<RunOutcome> Wait(std::chrono::milliseconds longest) override;
  std::vector<RunningRun> Running() const override;
  unsigned Slots() const override;
  void Committed() override;
  std::vector<std::string> TakeNotes() override { return std::exchange(notes_, {}); }

private:
  using Clock = std::chrono::steady_clock;

  struct Job
  {
    SlurmBatch batch;
    std::map<std::size_t, SlurmTask> tasks;
    std::map<std::size_t, Clock::time_point> ended;  // time at which the end was seen
  };

  void Submit();
  bool Ask(Job& job);
  void LoseEnded(Job& job, std::vector<RunOutcome>& outcomes);
  void Cancel(std::vector<RunOutcome>& outcomes);
  void TakeResults(std::vector<RunOutcome>& outcomes);

  SlurmChoice choice_;
  std::vector<char> setup_;
  std::string folder_;
  std::vector<RunOrder> collected_;
  std::vector<Job> jobs_;
  Clock::time_point next_look_, next_question_;
  bool is_silent_ = false;  // Slurm does not answer, and the user was told
  std::vector<std::string> notes_;
};

// Takes the results of the study's jobs before another executor continues it. Throws UsageError if some jobs still run.
void SettleSlurm(StudyStore& store);

}  // namespace swarmanoid

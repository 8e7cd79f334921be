// The runs of a study as job arrays of Slurm. Jobs go on when this process ends; another one finds them by the study's
// folder. One thread.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "studies/executor.h"
#include "studies/slurm.h"
#include "studies/slurm_batch.h"
#include "studies/study_store.h"

namespace swarmanoid
{

struct SlurmChoice
{
  std::vector<std::string> options;  // for sbatch
  unsigned tasks_at_a_time = 0;      // 0: as many as Slurm starts
  unsigned runs_per_task = 0;        // 0: so many that there are 200 tasks at most
};

class SlurmPool final : public Executor
{
public:
  // Finds the jobs of the study that were submitted before. `setup`: as SetupOf says. Throws std::runtime_error.
  SlurmPool(SlurmChoice choice, std::vector<char> setup, std::string study_folder);

  bool HasRoom() const override { return true; }
  void Give(RunOrder order) override;
  bool IsIdle() const override;
  // Submits what was given since the last call. After an interrupt it cancels the jobs.
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
    std::map<std::size_t, Clock::time_point> ended;  // when that was seen
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
  bool is_silent_ = false;  // Slurm, and that was told
  std::vector<std::string> notes_;
};

// Before a study goes on elsewhere: takes what its jobs have computed. Throws UsageError if some go on.
void SettleSlurm(StudyStore& store);

}  // namespace swarmanoid

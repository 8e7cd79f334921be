// The commands of Slurm: sbatch, squeue, scancel. They need no database of accounts.
#pragma once

#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace swarmanoid
{

// A command of Slurm failed. what() is what it said.
class SlurmError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

struct SlurmTask
{
  std::string state;   // as Slurm writes it: "PENDING", "RUNNING", "TIMEOUT"
  std::string nodes;   // that it runs on, or did
  std::string reason;  // why it waits, or ended: "Priority"

  // Whether it has ended for good.
  bool HasEnded() const;
};

// Submits a script as an array of tasks 0 … `tasks` - 1 and returns the job's number. Throws SlurmError.
// `log`: with %a for the number of the task. `at_a_time`: tasks; 0: as many as there is room for.
std::string SubmitArray(const std::string& script, const std::string& log, std::size_t tasks, unsigned at_a_time,
                        const std::vector<std::string>& options);
// The tasks of a job that Slurm still knows: none once it has forgotten them, some minutes after their end. Throws
// SlurmError if Slurm cannot be asked.
std::map<std::size_t, SlurmTask> TasksOf(const std::string& job);
void CancelJob(const std::string& job);

// The words of a text as a shell has them, with quotes. Throws UsageError if a quote is not closed or an option is one
// that the study itself gives.
std::vector<std::string> SlurmOptions(const std::string& text);

}  // namespace swarmanoid

// The commands of Slurm: sbatch, squeue, scancel. They need no accounting database.
#pragma once

#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace swarmanoid
{

// A command of Slurm failed. what() is its message.
class SlurmError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

struct SlurmTask
{
  std::string state;   // in Slurm's words: "PENDING", "RUNNING", "TIMEOUT"
  std::string nodes;   // nodes on which it runs or ran
  std::string reason;  // the reason why it waits or ended: "Priority"

  // Returns whether it has ended for good.
  bool HasEnded() const;
};

// Submits a script as an array of tasks 0 … `tasks` - 1 and returns the job's number. `log`: a path with %a for the
// number of the task. `at_a_time`: simultaneous tasks; 0: no limit. Throws SlurmError.
std::string SubmitArray(const std::string& script, const std::string& log, std::size_t tasks, unsigned at_a_time,
                        const std::vector<std::string>& options);
// Returns the tasks of a job that Slurm still knows: none once it has forgotten them, some minutes after their end.
// Throws SlurmError if Slurm does not answer.
std::map<std::size_t, SlurmTask> TasksOf(const std::string& job);
void CancelJob(const std::string& job);

// Splits a text into words as a shell does, with quotes. Throws UsageError if a quote is not closed, or for an option
// that the study itself sets.
std::vector<std::string> SlurmOptions(const std::string& text);

}  // namespace swarmanoid

// Runs a study from its first run to its table, for `swarmanoid sweep`.
#pragma once

#include <string>
#include <vector>

#include "studies/design/design.h"
#include "studies/design/study.h"

namespace swarmanoid
{

struct SweepOptions
{
  std::string study{};   // the file; to continue, the folder of a study
  std::string output{};  // the folder; empty: a new one under runs/
  bool resume = false;
  bool dry_run = false;
  bool quiet = false;
  unsigned jobs = 0;     // runs or tasks of Slurm at a time; 0: one for each core, one cluster, or Slurm's limit
  unsigned retries = 0;  // for a run that fails
  // A text "COLUMN=5%" gives points more seeds until the confidence interval of the column's mean is that narrow. The
  // second value limits the seeds.
  std::string until_ci{};
  unsigned most_seeds = 1000;
  std::string hosts{};               // file with the machines that run it; empty: this machine
  std::vector<std::string> slurm{};  // options of sbatch, as one text; nothing: without Slurm
  unsigned runs_per_task = 0;        // for Slurm; 0: chosen so that there are at most 200 tasks
  std::string only{};                // a condition over factors and "seed": only these runs are executed
};

// Returns the exit code. Throws UsageError.
int Sweep(const SweepOptions& options);

// Returns the mistakes in the runs, one line each with its position. Each level of each factor is loaded, but not run.
// Loads all plug-ins of the runs.
std::vector<std::string> MistakesInRuns(const Study& study, const Design& design);

}  // namespace swarmanoid

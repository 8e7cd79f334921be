// A study from its first run to its table: what `swarmanoid sweep` does.
#pragma once

#include <string>
#include <vector>

#include "studies/design.h"
#include "studies/study.h"

namespace swarmanoid
{

struct SweepOptions
{
  std::string study;   // the file; to go on, the folder of a study
  std::string output;  // folder; empty: a new one under runs/
  bool resume = false;
  bool dry_run = false;
  bool quiet = false;
  unsigned jobs = 0;     // runs at a time, or tasks of Slurm; 0: as many as cores, or one cluster, or as Slurm starts
  unsigned retries = 0;  // of a run that fails
  // "COLUMN=5%": points get more seeds until the confidence interval of the column's mean is that narrow; and how many
  // at most.
  std::string until_ci;
  unsigned most_seeds = 1000;
  std::string hosts;               // file with the machines that run it; empty: this one
  std::vector<std::string> slurm;  // options of sbatch, as one text; nothing: not by Slurm
  unsigned runs_per_task = 0;      // of Slurm; 0: so many that there are 200 tasks at most
  std::string only;                // a condition over factors and "seed": other runs wait
};

// Returns the exit code. Throws UsageError.
int Sweep(const SweepOptions& options);

// What is wrong with the runs: each level of each factor is tried, without running it. One line a mistake, with its
// place. Loads all plug-ins that they need.
std::vector<std::string> MistakesInRuns(const Study& study, const Design& design);

}  // namespace swarmanoid

// SmokeTest: whether a run of an experiment can start. It makes everything as at tick 0 and drops it. So `swarmanoid
// check` refuses what engines, controllers and experiment functions refuse, and visualisations that are not installed.
// It uses a process of its own, since users' code may crash or never return.
#pragma once

#include <chrono>
#include <string>

#include "common/experiment/experiment.h"

namespace swarmanoid
{

struct Trial
{
  std::string folder;  // for files of experiment functions
  int steps = 0;
  bool visualisations = false;  // makes the renderers, without Init
  bool is_silent = false;       // hides the output and the mistakes
  std::chrono::seconds most = std::chrono::seconds(60);
};
int TryRun(const Experiment& experiment, const Trial& trial);

// Makes the run of tick 0 in a child process, and its renderers unless `visualisations` is false. Returns kExitDone or
// another exit code of common/errors/exit_codes.h, with the mistake on standard error. Output of users' code goes there
// too. Files of experiment functions go into a folder that is removed. Returns when the trial ends, at the latest after
// `most`.
int SmokeTest(const Experiment& experiment, bool visualisations);

}  // namespace swarmanoid

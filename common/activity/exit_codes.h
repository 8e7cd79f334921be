// How every program ends. docs/command.md tells users.
#pragma once

namespace swarmanoid
{

enum ExitCode
{
  kExitDone = 0,
  kExitExperimentFailed = 1,  // the experiment's own failure condition
  kExitUsage = 2,
  kExitInvalidFile = 3,
  kExitProcessFailed = 4,
  kExitHashDiffers = 5,
  kExitOthersFailed = 6,  // of a process of a cluster: the run failed elsewhere
  kExitStuck = 7,         // likewise: one that died holds a lock of the run's shared memory
  kExitCutOff = 8,        // likewise: the space server has gone, as far as it can see
  kExitInterrupted = 130
};

// For the --help of each program.
inline constexpr const char* kExitCodesText =
    "Exit codes: 0 done, 1 the experiment failed by its own measure, 2 usage,\n"
    "3 the experiment file is invalid, 4 a process failed, 5 the hash differs, 130 interrupted.\n";

}  // namespace swarmanoid

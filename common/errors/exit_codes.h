// All programs use these exit codes. docs/command.md documents them for users.
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
  kExitOthersFailed = 6,  // in a process of a cluster: the run failed in another process
  kExitStuck = 7,         // in a process of a cluster: a dead process holds a lock of the run's shared memory
  kExitCutOff = 8,        // in a process of a cluster: the space server does not answer any more
  kExitTooFewSeeds = 9,   // of a study: --until-ci has not reached its width with --most-seeds
  kExitInterrupted = 130
};

// The --help of `swarmanoid run` has this text.
inline constexpr const char* kExitCodesText =
    "Exit codes: 0 done, 1 the experiment failed by its own measure, 2 usage,\n"
    "3 the experiment file is invalid, 4 a process failed, 5 the hash differs, 130 interrupted.\n";

}  // namespace swarmanoid

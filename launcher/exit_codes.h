// How the command ends. docs/command.md tells users.
#pragma once

namespace swarmanoid
{

enum ExitCode
{
  kDone = 0,
  kExperimentFailed = 1,  // the experiment's own failure condition
  kUsage = 2,
  kInvalid = 3,
  kProcessFailed = 4,
  kHashDiffers = 5,
  kInterruptedByUser = 130
};

}  // namespace swarmanoid

// States whether the user trusts the experiments that this process runs. The option --trust or the environment variable
// SWARMANOID_TRUST=1 sets it. An experiment that is not trusted writes files only below the folder of the run. Its Lua
// scripts can neither start programs nor change files. The trust is set before an experiment is loaded; any thread may
// read it.
#pragma once

namespace swarmanoid
{

inline constexpr const char* kTrustFlag = "--trust";
inline constexpr const char* kTrustVariable = "SWARMANOID_TRUST";

// Trusts all experiments of this process, and of the processes that it starts on this machine, from now on.
void TrustExperiments();
bool ExperimentsAreTrusted();

}  // namespace swarmanoid

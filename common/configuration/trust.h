// Whether the user trusts the experiments that this process runs: by the option --trust, or by the environment variable
// SWARMANOID_TRUST, which is 1 then. An experiment that is not trusted writes files below the folder of the run alone,
// and its Lua scripts can neither start programs nor change files. Set before an experiment is loaded; read by any
// thread.
#pragma once

namespace swarmanoid
{

inline constexpr const char* kTrustFlag = "--trust";
inline constexpr const char* kTrustVariable = "SWARMANOID_TRUST";

// Trusts all experiments of this process from now on, and of those that it starts on this machine.
void TrustExperiments();
bool ExperimentsAreTrusted();

}  // namespace swarmanoid

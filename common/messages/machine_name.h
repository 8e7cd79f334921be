// Names of machines that take part in a run. Used by those who offer one, the space server and the launcher.
#pragma once

#include <string>

namespace swarmanoid
{

// The machine that the launcher is on.
inline constexpr const char* kHere = "here";

// What is wrong with the name of a machine that is offered, as "it must be …"; empty if it is right.
std::string MachineNameMistake(const std::string& name);

}  // namespace swarmanoid

// Whether the physics libraries of this system round as everywhere else.
#pragma once

#include <string>
#include <vector>

namespace swarmanoid
{

// Adds the names of the libraries (Box2D, ODE) that were compiled with fused multiply-add, which rounds once instead of
// twice. Experiments with their engines then have other results than on x86-64. Debian's builds for aarch64 are
// compiled in this way (docs/installing.md has the cure). `swarmanoid doctor` finds the function by its name.
extern "C" void FindFusedLibraries(std::vector<std::string>& names);

}  // namespace swarmanoid

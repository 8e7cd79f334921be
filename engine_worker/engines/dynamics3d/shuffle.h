// The order in which ODE shuffles constraints, from the ninth iteration on. ODE's own generator belongs to the whole
// process; each thread has one of ours instead.
#pragma once

#include <cstdint>

namespace swarmanoid::dynamics3d
{

// Sets the seed for the next step of this thread.
void SeedShuffle(std::uint32_t seed);

// Returns whether ODE, which is initialised, uses our generator.
bool IsShuffleOurs();

}  // namespace swarmanoid::dynamics3d

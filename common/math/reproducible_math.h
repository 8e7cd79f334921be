// Where this process takes sin, exp and the like from. Programs that CMake links to a library of ours take them from
// libswarmanoid_reproducible_math (docs/determinism.md); one that is linked otherwise may have libm before it, and the
// bits of ODE and Box2D would then depend on the processor.
#pragma once

namespace swarmanoid
{

// Throws std::runtime_error, with the cure, where this process takes them from elsewhere.
void RequireReproducibleMath();

}  // namespace swarmanoid

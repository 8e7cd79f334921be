// All engines, devices and renderers of the simulator, so that experiments can be read. Called by the programs of the
// roles, the launcher, and whoever reads experiments.
#pragma once

namespace swarmanoid
{

// Idempotent.
void RegisterBuiltins();

}  // namespace swarmanoid

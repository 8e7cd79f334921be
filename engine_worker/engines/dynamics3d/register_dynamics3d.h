// Makes the dynamics3d engine known. Apart from the engine's header, so that others need not see ODE.
#pragma once

namespace swarmanoid
{

// Adds the engine to the registry. Idempotent.
void RegisterDynamics3d();

}  // namespace swarmanoid

// The engines that come with the simulator.
#include "engine_worker/engine_worker.h"
#include "engine_worker/engines/dynamics2d/dynamics2d_engine.h"
#include "engine_worker/engines/dynamics3d/register_dynamics3d.h"
#include "engine_worker/engines/kinematics2d/kinematics2d_engine.h"

namespace swarmanoid
{

void RegisterBuiltinEngines()
{
  RegisterKinematics2d();
  RegisterDynamics2d();
  RegisterDynamics3d();
}

}  // namespace swarmanoid

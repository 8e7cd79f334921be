// The engines that come with the simulator.
#include "engine_worker/engine_worker.h"
#include "engine_worker/engines/kinematics2d/kinematics2d_engine.h"

namespace swarmanoid
{

void RegisterBuiltinEngines() { RegisterKinematics2d(); }

}  // namespace swarmanoid

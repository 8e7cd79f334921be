#include "simulation/register_all.h"

#include "controller_host/device.h"
#include "engine_worker/engine_worker.h"
#include "visualiser/render.h"

namespace swarmanoid
{

void RegisterBuiltins()
{
  RegisterBuiltinEngines();
  RegisterBuiltinDevices();
  RegisterBuiltinRenderers();
}

}  // namespace swarmanoid

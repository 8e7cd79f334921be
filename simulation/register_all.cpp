#include "simulation/register_all.h"

#include "common/experiment/experiment.h"
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

void LoadEnginesOf(const Experiment& experiment)
{
  for (const EngineConfiguration& engine : experiment.engines) LoadBuiltinEngine(engine.tag);
}

}  // namespace swarmanoid

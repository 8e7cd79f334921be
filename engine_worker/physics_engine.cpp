#include "engine_worker/physics_engine.h"

namespace swarmanoid
{

template <>
PluginRegistry<CPhysicsEngine>& PluginRegistry<CPhysicsEngine>::Instance()
{
  static PluginRegistry registry(PluginKind::kEngine);
  return registry;
}

}  // namespace swarmanoid

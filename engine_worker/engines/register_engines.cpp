// The engines that come with the simulator; common/plugin_descriptions describes them.
#include "common/plugin_descriptions/describe_builtins.h"
#include "engine_worker/engine_worker.h"
#include "engine_worker/engines/dynamics2d/dynamics2d_engine.h"
#include "engine_worker/engines/dynamics3d/dynamics3d_engine.h"
#include "engine_worker/engines/kinematics2d/kinematics2d_engine.h"

namespace swarmanoid
{
namespace
{

template <class Engine>
void Bind(const char* label)
{
  PluginRegistry<CPhysicsEngine>::Instance().Bind(label, "", [] { return std::make_unique<Engine>(); });
}

}  // namespace

void RegisterBuiltinEngines()
{
  static const bool registered = []
  {
    DescribeBuiltinEngines();
    Bind<Kinematics2dEngine>("dummy_engine");
    Bind<Kinematics2dEngine>("kinematics2d");
    Bind<CDynamics2dEngine>("dynamics2d");
    Bind<CDynamics3dEngine>("dynamics3d");
    PluginRegistry<CPhysicsEngine>::Instance().RequireCode();
    return true;
  }();
  static_cast<void>(registered);
}

}  // namespace swarmanoid

// The engines that come with the simulator; common/plugin_descriptions describes them.
#include <utility>

#include "common/plugin_descriptions/describe_builtins.h"
#include "common/plugins/own_library.h"
#include "engine_worker/engine_worker.h"
#include "engine_worker/engines/kinematics2d/kinematics2d_engine.h"

namespace swarmanoid
{
namespace
{

void Bind(const char* label, PluginRegistry<CPhysicsEngine>::Factory create)
{
  PluginRegistry<CPhysicsEngine>::Instance().Bind(label, "", std::move(create));
}

std::unique_ptr<CPhysicsEngine> MakeKinematics2d() { return std::make_unique<Kinematics2dEngine>(); }

// The engines of rigid bodies are in a library of their own, which has these functions that make them.
constexpr const char* kRigidBodies = "rigid_bodies";
constexpr std::pair<const char*, const char*> kMakers[] = {{"dynamics2d", "MakeDynamics2d"},
                                                           {"dynamics3d", "MakeDynamics3d"}};

}  // namespace

void RegisterBuiltinEngines()
{
  static const bool registered = []
  {
    DescribeBuiltinEngines();
    Bind("dummy_engine", MakeKinematics2d);
    Bind("kinematics2d", MakeKinematics2d);
    for (const auto& [label, function] : kMakers)
      Bind(label,
           [name = function]
           {
             const auto make = reinterpret_cast<CPhysicsEngine* (*)()>(FunctionOfOwnLibrary(kRigidBodies, name));
             return std::unique_ptr<CPhysicsEngine>(make());
           });
    PluginRegistry<CPhysicsEngine>::Instance().RequireCode();
    return true;
  }();
  static_cast<void>(registered);
}

void LoadBuiltinEngine(const std::string& label)
{
  try
  {
    for (const auto& [known, function] : kMakers)
      if (known == label) FunctionOfOwnLibrary(kRigidBodies, function);
  }
  catch (const std::runtime_error&)
  {
    // A run will report it.
  }
}

}  // namespace swarmanoid

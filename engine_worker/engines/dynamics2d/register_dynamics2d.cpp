#include "engine_worker/engines/dynamics2d/dynamics2d_engine.h"
#include "engine_worker/engines/dynamics2d/dynamics2d_parameters.h"

namespace swarmanoid
{

void RegisterDynamics2d()
{
  static const bool registered = []
  {
    PluginDescription description;
    description.label = "dynamics2d";
    description.brief = "Rigid bodies with masses, friction and grips on a plane, solved by Box2D.";
    description.parameters = dynamics2d::Dynamics2dParameterTable();
    description.channels = {"footbot_wheels",   "footbot_gripper",       "footbot_turret",        "eyebot_propellers",
                            "footbot_encoders", "footbot_turret_torque", "footbot_accelerometer", "wheels"};
    for (std::string& channel : PlaneRobots::Channels()) description.channels.push_back(std::move(channel));
    description.entity_tags = TagsOfKinds([](const EntityKindDescription&) { return true; });
    description.any_kind = true;
    PluginRegistry<CPhysicsEngine>::Instance().Add(std::move(description),
                                                   [] { return std::make_unique<CDynamics2dEngine>(); });
    return true;
  }();
  static_cast<void>(registered);
}

}  // namespace swarmanoid

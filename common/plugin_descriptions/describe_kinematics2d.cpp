#include "common/configuration/parameter_table.h"
#include "common/experiment/entity_kind.h"
#include "common/plugin_descriptions/engine_bodies.h"
#include "common/plugin_descriptions/engines.h"

namespace swarmanoid
{

PluginDescription Kinematics2dDescription(const std::string& label)
{
  return {
      .label = label,
      .brief = "2D kinematic engine: velocities, elastic collisions, no masses; the fast one",
      .parameters = Joined(
          PlaneParameters(),
          {{.name = "elasticity",
            .default_value = "1",
            .description =
                "Part of the approach that a collision gives back; 1 is purely elastic, 0 lets bodies stay in touch.",
            .minimum = 0,
            .maximum = 1},
           {.name = "threads",
            .type = ParameterType::kInteger,
            .default_value = "0",
            .description = "Threads that share the work; their number changes no bit of the results. 0: in one process "
                           "as many as --threads has, while that is quicker; in a process of its own one.",
            .minimum = 0,
            .maximum = 64}}),
      .channels = WithChannelsOfPlaneRobots({"eyebot_propellers", "footbot_encoders", "footbot_gripper",
                                             "footbot_turret", "footbot_turret_torque", "footbot_wheels", "wheels"}),
      .entity_tags = TagsOfKinds([](const EntityKindDescription&) { return true; }),
      .any_kind = true,
      .can_split = true,
      .ignores = {"mass", "friction", "restitution", "ground_friction", "hole"},
      .collision_model = Kinematics2dBodies};
}

}  // namespace swarmanoid

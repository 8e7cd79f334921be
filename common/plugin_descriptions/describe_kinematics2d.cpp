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
           {.name = "friction",
            .default_value = "0.49",
            .description = "Coulomb coefficient of bodies that move, where walls have one; they use the geometric mean "
                           "of both. Bodies that move slide along each other without friction.",
            .minimum = 0,
            .maximum = 100},
           {.name = "wall_friction",
            .default_value = "0",
            .description = "Coulomb coefficient of what never moves: walls, blocks, terrain.",
            .minimum = 0,
            .maximum = 100},
           ThreadsParameter()}),
      .channels = WithChannelsOfPlaneRobots({"eyebot_propellers", "footbot_encoders", "footbot_gripper",
                                             "footbot_turret", "footbot_turret_torque", "footbot_wheels", "wheels"}),
      .entity_tags = TagsOfKinds([](const EntityKindDescription&) { return true; }),
      .any_kind = true,
      .can_split = true,
      .hands_over = true,
      .ignores = {"mass", "restitution", "ground_friction", "ground_torque", "hole"},
      .collision_model = Kinematics2dBodies};
}

}  // namespace swarmanoid

#include <fmt/format.h>

#include <string>
#include <utility>

#include "common/configuration/parameter_table.h"
#include "common/experiment/entity_kind.h"
#include "common/plugin_descriptions/engine_bodies.h"
#include "common/plugin_descriptions/engines.h"

namespace swarmanoid
{
namespace
{

ParameterSpec Number(const char* name, const char* unit, std::string value, double minimum, double maximum,
                     const char* description)
{
  return {name, ParameterType::kNumber, unit, std::move(value), description, minimum, maximum, {}};
}

ParameterSpec Integer(const char* name, const char* value, double maximum, const char* description)
{
  return {name, ParameterType::kInteger, "", value, description, 1, maximum, {}};
}

// docs/engines.md has the sources of the defaults.
std::vector<ParameterSpec> Dynamics2dParameters()
{
  const EntityKindDescription& eyebot = DescriptionOf(*KindOfTag("eyebot"));
  return {
      Integer("substeps", "4", 1000,
              "Steps of the solver in each step of the engine: more make contacts stiffer and friction more exact, and "
              "take longer in proportion."),
      Integer("velocity_iterations", "8", 1000,
              "Passes over all contacts and joints for their velocities, in each step."),
      Integer("position_iterations", "3", 1000, "Passes against overlaps and gaps in joints, in each step."),
      Number("gravity", "m/s2", "9.81", 0, 1000,
             "Presses bodies onto the plane: their friction against the ground is proportional to it."),
      Number("friction", "", "0.49", 0, 100,
             "Coulomb coefficient of bodies that move, where others touch them; two bodies use the geometric mean."),
      Number(
          "wall_friction", "", "0.01", 0, 100,
          "Coulomb coefficient of what never moves: walls, blocks, terrain. With 0.49 of robots a contact has 0.07."),
      Number("restitution", "", "0", 0, 1,
             "The part of the approach speed with which two bodies part; approaches below 0.1 m/s never bounce."),
      Number("wheel_friction", "", "0.8", 0, 100, "Coulomb coefficient of the footbot's wheels on the ground."),
      Number("ground_friction", "", "0.5", 0, 100, "Coulomb coefficient of preys, blocks and handbots on the ground."),
      Number("density", "kg/m3", "200", 1e-3, 1e5, "Of preys and movable blocks that have no mass of their own."),
      Number("footbot_mass", "kg", "1.6", 1e-3, 1e5, "The mass of a footbot."),
      Number("handbot_mass", "kg", "3", 1e-3, 1e5, "The mass of a handbot."),
      Number("eyebot_mass", "kg", fmt::format("{}", eyebot.mass_kg), 1e-3, 1e5, "The mass of an eyebot."),
      Number("drive_force", "N", "15", 0, 1e6,
             "What the motors of a footbot exert at most; the grip of its wheels on the ground is a second limit."),
      Number("eyebot_force", "N", fmt::format("{}", eyebot.propellers->plane_force_n), 0, 1e6,
             "The horizontal force of an eyebot's propellers at most."),
      Number("eyebot_torque", "N m", fmt::format("{}", eyebot.propellers->plane_torque_n_m), 0, 1e6,
             "The yaw torque of an eyebot's propellers at most."),
      Number(
          "turret_torque", "N m", "1.5", 1e-6, 1e6,
          "What the turret's motor exerts at most while gripping, and the torque that the torque sensor reads as 1."),
      Number("traction_range", "N", "25", 1e-6, 1e6, "The traction on the turret that the torque sensor reads as 1."),
      Number("grip_distance", "m", "0.02", 0, 0.1, "How far from the gripper's face a surface may be to be gripped."),
      {.name = "gripper",
       .type = ParameterType::kText,
       .default_value = "square",
       .description = "square stops bodies and holds rigidly; rod, as in ARGoS3, stops none, and its ends turn freely.",
       .choices = {"square", "rod"}},
      ThreadsParameter(),
  };
}

}  // namespace

PluginDescription Dynamics2dDescription()
{
  return {.label = "dynamics2d",
          .brief = "Rigid bodies with masses, friction and grips on a plane.",
          .parameters = Joined(PlaneParameters(), Dynamics2dParameters()),
          .channels = WithChannelsOfPlaneRobots({"footbot_wheels", "footbot_gripper", "footbot_turret",
                                                 "eyebot_propellers", "footbot_encoders", "footbot_turret_torque",
                                                 "footbot_accelerometer", "wheels"}),
          .entity_tags = TagsOfKinds([](const EntityKindDescription&) { return true; }),
          .any_kind = true,
          .can_split = true,
          .hands_over = true,
          .ignores = {"hole"},
          .collision_model = Dynamics2dBodies};
}

}  // namespace swarmanoid

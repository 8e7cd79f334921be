#include "common/experiment/entity_kind.h"
#include "common/plugin_descriptions/engine_bodies.h"
#include "common/plugin_descriptions/engines.h"

namespace swarmanoid
{
namespace
{

std::vector<ParameterSpec> Dynamics3dParameters()
{
  using enum ParameterType;
  const auto switched = [](const char* name, const char* value, const char* description) -> ParameterSpec
  { return {.name = name, .type = kBoolean, .default_value = value, .description = description}; };
  return {
      {.name = "step_ms",
       .unit = "ms",
       .default_value = "5",
       .description = "Length of one step of the solver at most; a clock tick is cut into equal ones, each again into "
                      "<subclock> parts. Longer steps are faster and softer: above 10 robots sink and sway.",
       .minimum = 0.1,
       .maximum = 100},
      {.name = "iterations",
       .type = kInteger,
       .default_value = "8",
       .description = "Iterations of the solver in each step; more of them bring motors and grips nearer to their "
                      "values and cost time in proportion.",
       .minimum = 1,
       .maximum = 1000},
      {.name = "object_iterations",
       .type = kInteger,
       .default_value = "50",
       .description =
           "Iterations, if that is more, for blocks, preys, handbots, robots with spinning wheels, and all that "
           "touches or holds them, directly or through others.",
       .minimum = 1,
       .maximum = 1000},
      {.name = "gravity",
       .type = kVector3,
       .unit = "m/s2",
       .default_value = "0, 0, -9.81",
       .description = "Acceleration of free fall, along the axes of the space.",
       .minimum = -1000,
       .maximum = 1000},
      {.name = "position",
       .type = kVector3,
       .unit = "m",
       .default_value = "0, 0, 0",
       .description = "Where the frame of the engine has its origin in the space; the ground is the plane z = 0 of it.",
       .minimum = -1e6,
       .maximum = 1e6},
      {.name = "orientation",
       .type = kVector3,
       .unit = "deg",
       .default_value = "0, 0, 0",
       .description = "How the frame of the engine is turned in the space: about x, y and z, in this order. A tilted "
                      "frame has a tilted ground under upright gravity.",
       .minimum = -1e5,
       .maximum = 1e5},
      switched("ground", "true", "Whether there is a ground plane; switch it off where a terrain takes its place."),
      switched("ceiling", "false",
               "Whether there is a ceiling at the height of the arena, to which eyebots and ropes attach."),
      switched("arena_walls", "false", "Whether the four sides of the arena are walls."),
      switched("solve_all", "false",
               "Whether robots on wheels that touch nothing but level ground are solved too: they then pitch when they "
               "speed up, and cost some twenty times as much."),
      ThreadsParameter(),
      {.name = "friction",
       .default_value = "0.5",
       .description = "Coefficient of Coulomb friction between bodies, and with the ground.",
       .minimum = 0,
       .maximum = 100},
      {.name = "wheel_friction",
       .default_value = "1",
       .description =
           "Coefficient of Coulomb friction of wheels with what they roll on. Below 0.95 motors can spin the wheels.",
       .minimum = 0,
       .maximum = 100},
      {.name = "restitution",
       .default_value = "0",
       .description = "Part of the speed of approach that a collision gives back, from 5 cm/s on.",
       .minimum = 0,
       .maximum = 1},
      {.name = "density",
       .unit = "kg/m3",
       .default_value = "200",
       .description = "Of preys and movable blocks that have no mass of their own.",
       .minimum = 1e-3,
       .maximum = 1e5}};
}

}  // namespace

PluginDescription Dynamics3dDescription()
{
  return {.label = "dynamics3d",
          .brief = "3D dynamic engine: rigid bodies with masses, friction, joints and motors, solved by ODE",
          .parameters = Dynamics3dParameters(),
          .channels = {"eyebot_attach", "eyebot_propellers", "footbot_accelerometer", "footbot_encoders",
                       "footbot_gripper", "footbot_turret", "footbot_turret_torque", "footbot_wheels", "handbot_arms",
                       "handbot_hands", "handbot_rope", "joints", "wheels"},
          .entity_tags = TagsOfKinds([](const EntityKindDescription&) { return true; }),
          .any_kind = true,
          .moves_links = true,
          .can_split = true,
          .hands_over = true,
          .ignores = {"ground_torque"},
          .collision_model = Dynamics3dBodies};
}

}  // namespace swarmanoid

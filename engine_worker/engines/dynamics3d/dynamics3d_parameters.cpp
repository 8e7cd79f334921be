#include "engine_worker/engines/dynamics3d/dynamics3d_parameters.h"

#include "common/math/elementary.h"

namespace swarmanoid::dynamics3d
{

Settings SettingsFrom(const Parameters& parameters)
{
  Settings settings;
  settings.step_seconds = parameters.Number("step_ms") * 1e-3;
  settings.world.gravity = parameters.Vector3Of("gravity");
  settings.world.iterations = static_cast<int>(parameters.Integer("iterations"));
  settings.world.object_iterations = static_cast<int>(parameters.Integer("object_iterations"));
  settings.world.friction = parameters.Number("friction");
  settings.world.wheel_friction = parameters.Number("wheel_friction");
  settings.world.restitution = parameters.Number("restitution");
  const Vector3 turn = parameters.Vector3Of("orientation");
  settings.frame.position = parameters.Vector3Of("position");
  settings.frame.orientation =
      QuaternionFromEuler({DegreesToRadians(turn.x()), DegreesToRadians(turn.y()), DegreesToRadians(turn.z())});
  settings.density = parameters.Number("density");
  settings.ground = parameters.Boolean("ground");
  settings.ceiling = parameters.Boolean("ceiling");
  settings.arena_walls = parameters.Boolean("arena_walls");
  settings.solve_all = parameters.Boolean("solve_all");
  return settings;
}

}  // namespace swarmanoid::dynamics3d

#include "engine_worker/engines/dynamics2d/dynamics2d_parameters.h"

namespace swarmanoid::dynamics2d
{

Dynamics2dParameters ReadDynamics2dParameters(const Parameters& parameters)
{
  Dynamics2dParameters values;
  values.substeps = static_cast<int>(parameters.Integer("substeps"));
  values.velocity_iterations = static_cast<int>(parameters.Integer("velocity_iterations"));
  values.position_iterations = static_cast<int>(parameters.Integer("position_iterations"));
  values.gravity = parameters.Number("gravity");
  values.friction = parameters.Number("friction");
  values.wall_friction = parameters.Number("wall_friction");
  values.restitution = parameters.Number("restitution");
  values.wheel_friction = parameters.Number("wheel_friction");
  values.ground_friction = parameters.Number("ground_friction");
  values.density = parameters.Number("density");
  for (auto& [tag, mass] : values.robot_mass) mass = parameters.Number(tag + "_mass");
  values.drive_force = parameters.Number("drive_force");
  for (auto& [tag, forces] : values.propellers)
    forces = {parameters.Number(tag + "_force"), parameters.Number(tag + "_torque")};
  values.turret_torque = parameters.Number("turret_torque");
  values.traction_range = parameters.Number("traction_range");
  values.grip_distance = parameters.Number("grip_distance");
  values.grips_by_rods = parameters.Text("gripper") == "rod";
  return values;
}

}  // namespace swarmanoid::dynamics2d

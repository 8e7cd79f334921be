// The values of the parameters of the engine dynamics2d.
#pragma once

#include <map>
#include <string>

#include "common/configuration/parameter.h"

namespace swarmanoid::dynamics2d
{

struct Dynamics2dParameters
{
  int substeps = 4;
  int velocity_iterations = 8;
  int position_iterations = 3;
  double gravity = 9.81;  // m/s2
  double friction = 0.49;
  double wall_friction = 0.01;
  double restitution = 0;
  double wheel_friction = 0.8;
  double ground_friction = 0.5;
  double density = 200;  // kg/m3
  // Mass in kg by the robot's tag. Other robots have the mass of their row in the table of kinds, or the density.
  std::map<std::string, double> robot_mass = {{"footbot", 1.6}, {"handbot", 3}, {"eyebot", 0.5}};
  double drive_force = 15;      // N
  double eyebot_force = 5;      // N
  double eyebot_torque = 0.2;   // N m
  double turret_torque = 1.5;   // N m
  double traction_range = 25;   // N
  double grip_distance = 0.01;  // m
  bool grips_by_rods = false;
};

Dynamics2dParameters ReadDynamics2dParameters(const Parameters& parameters);

}  // namespace swarmanoid::dynamics2d

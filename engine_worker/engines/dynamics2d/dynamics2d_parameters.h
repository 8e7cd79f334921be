// The values of the parameters of the engine dynamics2d.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "common/configuration/parameter.h"
#include "common/experiment/entity_kind.h"

namespace swarmanoid::dynamics2d
{

// The greatest force and torque that propellers exert along the plane.
struct PropellerForces
{
  double force_n = 0;
  double torque_n_m = 0;  // about the normal
};

inline double MassOfKind(std::string_view tag) { return DescriptionOf(*KindOfTag(tag)).mass_kg; }
inline PropellerForces ForcesOfKind(std::string_view tag)
{
  const Propellers& row = *DescriptionOf(*KindOfTag(tag)).propellers;
  return {row.plane_force_n, row.plane_torque_n_m};
}

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
  // By the robot's tag. Other robots have the values of their row in the table of kinds; those without a mass have the
  // density.
  std::map<std::string, double> robot_mass = {{"footbot", 1.6}, {"handbot", 3}, {"eyebot", MassOfKind("eyebot")}};
  std::map<std::string, PropellerForces> propellers = {{"eyebot", ForcesOfKind("eyebot")}};
  double drive_force = 15;      // N
  double turret_torque = 1.5;   // N m
  double traction_range = 25;   // N
  double grip_distance = 0.01;  // m
  bool grips_by_rods = false;
};

Dynamics2dParameters ReadDynamics2dParameters(const Parameters& parameters);

}  // namespace swarmanoid::dynamics2d

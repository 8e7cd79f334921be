// A kind of robot with rotors, of round numbers, for the tests of engines.
#pragma once

#include "common/experiment/entity_kind.h"

namespace swarmanoid::test
{

inline EntityKindDescription QuadrotorRow(const std::string& tag)
{
  EntityKindDescription row;
  row.tag = tag;
  row.form = BodyForm::kCylinder;
  row.size = {0.07, 0.07, 0.03};
  row.mass_kg = 0.03;
  Propellers propellers;
  propellers.inertia_kg_m2 = {1.6e-5, 1.7e-5, 3e-5};
  propellers.centre_of_mass_m = 0.015;
  propellers.plane_force_n = 0.1;
  propellers.plane_torque_n_m = 1e-3;
  Rotors rotors;
  rotors.reach_m = 0.05;
  rotors.max_thrust_n = 0.16;
  rotors.torque_m = 0.006;
  rotors.thrust_of_speed = {-0.001, 1e-5, 1.5e-8};
  rotors.spin_up_s = 0.02;
  rotors.spin_down_s = 0.04;
  rotors.drag = {1e-6, 1e-6, 2e-6};
  propellers.rotors = rotors;
  row.propellers = propellers;
  return row;
}

// Returns the kind of such robots. Registers it at the first call.
inline EntityKind Quadrotor()
{
  if (!KindOfTag("test_quadrotor")) RegisterEntityKind(QuadrotorRow("test_quadrotor"));
  return *KindOfTag("test_quadrotor");
}

}  // namespace swarmanoid::test

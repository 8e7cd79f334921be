// The rotors of a flying robot: how thrust and torques are shared among them, and how their speeds follow.
#pragma once

#include <vector>

#include "common/experiment/entity_kind.h"
#include "common/serialisation/bytes.h"

namespace swarmanoid::dynamics3d
{

class RotorSet
{
public:
  struct Wrench
  {
    double thrust = 0;                 // N, along the robot's z axis
    Vector3 torque = Vector3::Zero();  // N m, about its axes
  };

  // The row outlives the set.
  explicit RotorSet(const Rotors& row);

  // All rotors turn as they must for this thrust (N) together.
  void SpinFor(double thrust);
  // Commands thrust and torques, lets the speeds follow for the time of a step, and returns what the rotors then exert.
  // A rotor that cannot exert its part exerts the nearest thrust that it can.
  Wrench Advance(const Wrench& wanted, double seconds);
  // Returns the drag (N) of the rotors for the velocity (m/s) of the robot in the air, both along the robot's axes.
  Vector3 Drag(const Vector3& velocity) const { return -SpeedSum() * row_.drag.cwiseProduct(velocity); }

  double SpeedSum() const;  // rad/s
  const std::vector<double>& Speeds() const { return speeds_; }

  void Save(ByteWriter& state) const;
  void Load(ByteReader& state);

private:
  double ThrustAt(double speed) const;
  double SpeedFor(double thrust) const;

  const Rotors& row_;
  std::vector<Vector2> axes_;   // the directions of the rotors from the middle
  std::vector<double> speeds_;  // rad/s
};

}  // namespace swarmanoid::dynamics3d

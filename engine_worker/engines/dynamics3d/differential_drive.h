// DifferentialDrive: the motion of a robot on two driven wheels on level ground without other contacts. It computes
// what the solver would, without the robot's pitch. In each step the wheels come as near to their commands as the
// motors allow, and the robot moves along an arc. Used by WheeledModel.
#pragma once

#include <array>

#include "common/math/elementary.h"

namespace swarmanoid::dynamics3d
{

// Properties of the robot in metres, kilograms and radians. Arrays have the left wheel first.
struct DriveDescription
{
  double mass = 0;           // of the robot with its wheels
  double inertia = 0;        // of all of it, about the vertical axis
  double wheel_inertia = 0;  // of each, about its axle
  double wheel_radius = 0;
  double half_track = 0;
  double stall_torque = 0;  // N m, of each motor
  double free_rate = 0;     // rad/s, of a wheel that needs no torque
};

// The pose and speed of a robot in the plane, and the rates of its wheels.
struct PlaneMotion
{
  double x = 0, y = 0;
  double cosine = 1, sine = 0;            // of the heading
  double half_cosine = 1, half_sine = 0;  // of half the turn since it was left alone
  std::array<double, 2> rates = {0, 0};   // rad/s, of the wheels
  std::array<double, 2> turned = {0, 0};  // rad, by the wheels in the last call of Advance
  // The velocity (m/s, rad/s) of a robot that slides or is pushed. One that rolls has that of its wheels.
  double vx = 0, vy = 0, spin = 0;

  void RotateHeading(const SinCos& turn) { Rotate(cosine, sine, turn); }
  void RotateHalfTurn(const SinCos& turn) { Rotate(half_cosine, half_sine, turn); }

private:
  static void Rotate(double& cosine, double& sine, const SinCos& turn)
  {
    const double before = cosine;
    cosine = turn.cos * cosine - turn.sin * sine;
    sine = turn.cos * sine + turn.sin * before;
  }
};

class DifferentialDrive
{
public:
  explicit DifferentialDrive(const DriveDescription& description);
  const DriveDescription& Description() const { return robot_; }

  // Returns the largest torque (N m) of a direct-current motor: the stall torque less the loss by speed, or more than
  // it when braking.
  double LargestTorque(double command, double rate) const;
  void Advance(PlaneMotion& motion, const std::array<double, 2>& commands, int steps, double step_seconds) const;

  double Speed(const PlaneMotion& motion) const;  // m/s
  double Turn(const PlaneMotion& motion) const;   // rad/s

private:
  void Accelerate(PlaneMotion& motion, const std::array<double, 2>& commands, double seconds) const;
  void Roll(PlaneMotion& motion, double seconds) const;

  DriveDescription robot_;
  // The torque on a wheel for 1 rad/s2 of its own and of the other's.
  double own_ = 0, other_ = 0;
};

}  // namespace swarmanoid::dynamics3d

// Problem: move a robot on two wheels on level ground as the solver would, without a solver.
//
// Method: with wheel rates r, the robot's speed is R (r_left + r_right) / 2 and its turn R (r_right - r_left) / (2 h),
// for wheels of radius R at h left and right. The kinetic energy in these rates gives the torque on a wheel for its own
// acceleration (own_) and for the other's (other_). If both motors can bring their wheels to the commands within the
// step, they do. Otherwise both torques are found by clamping them in turn, a projected Gauss-Seidel of two unknowns.
// The robot then follows the arc of a circle exactly.
//
// Invariant: steady wheels do all their steps in one, since the arc is exact for any time. Source: docs/engines.md,
// "Robots that touch nothing".
#include "engine_worker/engines/dynamics3d/differential_drive.h"

#include <algorithm>
#include <cmath>

#include "common/math/elementary.h"

namespace swarmanoid::dynamics3d
{

DifferentialDrive::DifferentialDrive(const DriveDescription& description) : robot_(description)
{
  const double square = robot_.wheel_radius * robot_.wheel_radius;
  const double straight = square * robot_.mass / 4;
  const double turning = square * robot_.inertia / (4 * robot_.half_track * robot_.half_track);
  own_ = straight + turning + robot_.wheel_inertia;
  other_ = straight - turning;
}

double DifferentialDrive::LargestTorque(double command, double rate) const
{
  const double along = command > rate ? rate : command < rate ? -rate : 0;
  return robot_.stall_torque * std::clamp(1 - along / robot_.free_rate, 0.0, 2.0);
}

double DifferentialDrive::Speed(const PlaneMotion& motion) const
{
  return robot_.wheel_radius * (motion.rates[0] + motion.rates[1]) / 2;
}

double DifferentialDrive::Turn(const PlaneMotion& motion) const
{
  return robot_.wheel_radius * (motion.rates[1] - motion.rates[0]) / (2 * robot_.half_track);
}

void DifferentialDrive::Advance(PlaneMotion& motion, const std::array<double, 2>& commands, int steps,
                                double step_seconds) const
{
  motion.turned = {0, 0};
  while (steps > 0)
  {
    const bool is_steady = motion.rates == commands;
    const int count = is_steady ? steps : 1;
    const double seconds = count * step_seconds;
    if (!is_steady) Accelerate(motion, commands, seconds);
    Roll(motion, seconds);
    for (std::size_t wheel = 0; wheel < 2; ++wheel) motion.turned[wheel] += motion.rates[wheel] * seconds;
    steps -= count;
  }
}

void DifferentialDrive::Accelerate(PlaneMotion& motion, const std::array<double, 2>& commands, double seconds) const
{
  std::array<double, 2> change, limit, torque;
  for (std::size_t wheel = 0; wheel < 2; ++wheel)
  {
    change[wheel] = commands[wheel] - motion.rates[wheel];
    limit[wheel] = LargestTorque(commands[wheel], motion.rates[wheel]);
  }
  const auto needed = [&](std::size_t wheel) { return (own_ * change[wheel] + other_ * change[1 - wheel]) / seconds; };
  torque = {needed(0), needed(1)};
  if (std::abs(torque[0]) <= limit[0] && std::abs(torque[1]) <= limit[1])
  {
    motion.rates = commands;
    return;
  }
  // Each motor in turn gives as much as it can of the missing speed. The two wheels hardly depend on each other.
  const double determinant = own_ * own_ - other_ * other_;
  const auto gained = [&](std::size_t wheel)
  { return seconds * (own_ * torque[wheel] - other_ * torque[1 - wheel]) / determinant; };
  constexpr int kRounds = 8;
  for (int round = 0; round < kRounds; ++round)
    for (std::size_t wheel = 0; wheel < 2; ++wheel)
      torque[wheel] = std::clamp(torque[wheel] + (change[wheel] - gained(wheel)) * determinant / (own_ * seconds),
                                 -limit[wheel], limit[wheel]);
  for (std::size_t wheel = 0; wheel < 2; ++wheel) motion.rates[wheel] += gained(wheel);
}

void DifferentialDrive::Roll(PlaneMotion& motion, double seconds) const
{
  const double half = Turn(motion) * seconds / 2;
  const SinCos half_turn = SinCosOf(half);
  const double chord = Speed(motion) * seconds * (std::abs(half) > 1e-6 ? half_turn.sin / half : 1);
  motion.RotateHalfTurn(half_turn);
  motion.RotateHeading(half_turn);
  motion.x += chord * motion.cosine;
  motion.y += chord * motion.sine;
  motion.RotateHeading(half_turn);
}

}  // namespace swarmanoid::dynamics3d

// Problem: rotors that only push upwards, and whose speeds lag, have to exert a thrust and three torques.
//
// Method: rotor i at the angle a(i) on a circle of radius r, turning by the sign s(i), has the torques r sin a(i) f(i)
// and -r cos a(i) f(i) about x and y, and s(i) c f(i) about z. As the rotors are even around the circle and turn
// alternately, these rows and the row of the thrust are orthogonal, so the least thrusts are
//
//   f(i) = T / n + 2 (X sin a(i) - Y cos a(i)) / (n r) + s(i) Z / (n c)
//
// Each is limited to what the rotor can exert. The speeds follow theirs as in RotorS: first order, with one time
// constant up and one down. RotorS: F. Furrer, M. Burri, M. Achtelik, R. Siegwart, "RotorS - A Modular Gazebo MAV
// Simulator Framework", in: Robot Operating System, Springer 2016.
#include "engine_worker/engines/dynamics3d/rotors.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/math/elementary.h"

namespace swarmanoid::dynamics3d
{

RotorSet::RotorSet(const Rotors& row)
    : row_(row),
      axes_(PlacesOnCircle(row.count, 1, kPi / row.count)),
      speeds_(static_cast<std::size_t>(row.count), SpeedFor(0))
{
}

double RotorSet::ThrustAt(double speed) const
{
  const Vector3& curve = row_.thrust_of_speed;
  return std::max(curve.x() + speed * (curve.y() + speed * curve.z()), 0.0);
}

double RotorSet::SpeedFor(double thrust) const
{
  const Vector3& curve = row_.thrust_of_speed;
  return (std::sqrt(curve.y() * curve.y() - 4 * curve.z() * (curve.x() - thrust)) - curve.y()) / (2 * curve.z());
}

void RotorSet::SpinFor(double thrust)
{
  std::ranges::fill(speeds_, SpeedFor(std::clamp(thrust / row_.count, 0.0, row_.max_thrust_n)));
}

RotorSet::Wrench RotorSet::Advance(const Wrench& wanted, double seconds)
{
  const double n = row_.count;
  // Returns the part of a difference in speed that is left after the step.
  const auto rest = [&](double lag_s) { return lag_s > 0 ? Exp(-seconds / lag_s) : 0.0; };
  const double rest_up = rest(row_.spin_up_s);
  const double rest_down = rest(row_.spin_down_s);
  Wrench exerted;
  double spin = 1;
  for (std::size_t i = 0; i < speeds_.size(); ++i, spin = -spin)
  {
    const Vector2& axis = axes_[i];
    const double share = wanted.thrust / n +
                         2 * (wanted.torque.x() * axis.y() - wanted.torque.y() * axis.x()) / (n * row_.reach_m) +
                         spin * wanted.torque.z() / (n * row_.torque_m);
    const double target = SpeedFor(std::clamp(share, 0.0, row_.max_thrust_n));
    double& speed = speeds_[i];
    speed = target + (speed - target) * (target > speed ? rest_up : rest_down);
    const double thrust = ThrustAt(speed);
    exerted.thrust += thrust;
    exerted.torque += thrust * Vector3(row_.reach_m * axis.y(), -row_.reach_m * axis.x(), spin * row_.torque_m);
  }
  return exerted;
}

double RotorSet::SpeedSum() const { return std::accumulate(speeds_.begin(), speeds_.end(), 0.0); }

void RotorSet::Save(ByteWriter& state) const
{
  for (const double speed : speeds_) state.Put(speed);
}

void RotorSet::Load(ByteReader& state)
{
  for (double& speed : speeds_) speed = state.Get<double>();
}

}  // namespace swarmanoid::dynamics3d

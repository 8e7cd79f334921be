// Problem: move robots on wheels that press against walls and one another on level ground, at a small part of the cost
// of a solver in three dimensions.
//
// Method: sequential impulses (projected Gauss-Seidel, E. Catto 2005) on speeds forward, to the left and in turn, and
// on those of both rims. In each sweep a wheel finds the impulses of its motor and of the ground together: the motor
// brings the rim to its command within its torque, and the ground brings the rim's slip to 0 within the disc of its
// friction. Both wheels hold a half each of the robot against sliding sideways. Then the contacts take the speed into a
// wall or another robot, last in each sweep, so that no body is left with it.
//
// A contact with a gap leaves the speed that closes the gap within the step. An overlap parts as in ODE, by a fifth in
// a step. A slipping wheel rubs a little more the faster it slips, and robots that rub yield (ode_contacts.cpp).
//
// Invariants: a robot depends only on those that it touches, directly or through others, in the order in which they and
// their contacts were added. Impulses begin at 0 in each step, so nothing is kept. Source: docs/engines.md, "Robots
// that touch walls and one another".
#include "engine_worker/engines/dynamics3d/planar_solver.h"

#include <algorithm>
#include <cmath>

#include "common/math/elementary.h"
#include "engine_worker/engines/dynamics3d/contact_constants.h"

namespace swarmanoid::dynamics3d
{
namespace
{

constexpr double kWheelLoad = 0.77;    // the part of the weight that the wheels carry, not the casters
constexpr double kPart = 0.2;          // of an overlap that parts in a step
constexpr double kLeft = 1e-4;         // m of overlap that stays, so that the contact does
constexpr double kFastestParting = 1;  // m/s
// A robot whose speeds change by less in a sweep (m/s) rests until a contact changes them.
constexpr double kSmallest = 1e-5;

}  // namespace

void PlanarSolver::Begin(double seconds, double wheel_friction, double gravity)
{
  seconds_ = seconds;
  wheel_friction_ = wheel_friction;
  gravity_ = gravity;
  robots_.clear();
  given_.clear();
  contacts_.clear();
}

std::size_t PlanarSolver::Add(const DifferentialDrive& drive, PlaneMotion& motion,
                              const std::array<double, 2>& commands)
{
  const DriveDescription& kind = drive.Description();
  Robot& robot = robots_.emplace_back();
  robot.motion = &motion;
  robot.mass = kind.mass;
  robot.inverse_mass = 1 / kind.mass;
  robot.inverse_inertia = 1 / kind.inertia;
  robot.half_track = kind.half_track;
  robot.wheel_radius = kind.wheel_radius;
  robot.rim_mass = kind.wheel_inertia / (kind.wheel_radius * kind.wheel_radius);
  robot.inverse_rim_mass = 1 / robot.rim_mass;
  robot.forward = motion.cosine * motion.vx + motion.sine * motion.vy;
  robot.left = motion.cosine * motion.vy - motion.sine * motion.vx;
  robot.turn = motion.spin;
  const double load = kWheelLoad * kind.mass * gravity_ / 2;
  const double mass = 1 / (robot.inverse_mass + kind.half_track * kind.half_track * robot.inverse_inertia);
  robot.ground_mass = mass;
  robot.slip_mass = 1 / (1 / mass + robot.inverse_rim_mass);
  for (std::size_t wheel = 0; wheel < 2; ++wheel)
  {
    robot.rim[wheel] = kind.wheel_radius * motion.rates[wheel];
    robot.command[wheel] = kind.wheel_radius * commands[wheel];
    robot.most_motor[wheel] = drive.LargestTorque(commands[wheel], motion.rates[wheel]) / kind.wheel_radius * seconds_;
    const double side = wheel == 0 ? -kind.half_track : kind.half_track;
    const double along = robot.forward + side * robot.turn - robot.rim[wheel];
    const double slip = std::sqrt(along * along + robot.left * robot.left);
    const double rise = slip > kWheelSlip ? 1 + kSlipRise * std::min(slip, kFastestSlip) : 1;
    robot.most_grip[wheel] = wheel_friction_ * rise * load * seconds_;
  }
  robot.motor = robot.along = robot.across = {0, 0};
  return robots_.size() - 1;
}

void PlanarSolver::Add(const PlanarContact& contact) { given_.push_back(contact); }

double PlanarSolver::SpeedAlong(const Contact& contact, const std::array<Row, 2>& rows)
{
  const auto of = [](const Robot& robot, const Row& row)
  { return row[0] * robot.forward + row[1] * robot.left + row[2] * robot.turn; };
  const double speed = of(*contact.first, rows[0]);
  return contact.second == nullptr ? speed : speed + of(*contact.second, rows[1]);
}

void PlanarSolver::Push(Contact& contact, const std::array<Row, 2>& rows, double impulse)
{
  const auto push = [&](Robot& robot, const Row& row)
  {
    robot.forward += row[0] * robot.inverse_mass * impulse;
    robot.left += row[1] * robot.inverse_mass * impulse;
    robot.turn += row[2] * robot.inverse_inertia * impulse;
  };
  push(*contact.first, rows[0]);
  if (contact.second != nullptr) push(*contact.second, rows[1]);
}

void PlanarSolver::Prepare(const PlanarContact& given)
{
  Contact& contact = contacts_.emplace_back();
  contact.first = &robots_[given.first];
  contact.second = given.second < 0 ? nullptr : &robots_[static_cast<std::size_t>(given.second)];
  const Vector2 along(-given.normal.y(), given.normal.x());
  double normal_inverse = 0, tangent_inverse = 0;
  const auto add = [&](std::size_t side, const Robot& robot, double sign)
  {
    const PlaneMotion& motion = *robot.motion;
    const Vector2 arm = given.point - Vector2(motion.x, motion.y);
    const auto row_of = [&](const Vector2& direction) -> Row
    {
      return {sign * (motion.cosine * direction.x() + motion.sine * direction.y()),
              sign * (motion.cosine * direction.y() - motion.sine * direction.x()),
              sign * (arm.x() * direction.y() - arm.y() * direction.x())};
    };
    contact.normal[side] = row_of(given.normal);
    contact.tangent[side] = row_of(along);
    normal_inverse += robot.inverse_mass + contact.normal[side][2] * contact.normal[side][2] * robot.inverse_inertia;
    tangent_inverse += robot.inverse_mass + contact.tangent[side][2] * contact.tangent[side][2] * robot.inverse_inertia;
  };
  add(0, *contact.first, 1);
  if (contact.second != nullptr) add(1, *contact.second, -1);
  contact.friction = given.friction;
  contact.yielding = given.yielding / seconds_;
  contact.normal_mass = 1 / normal_inverse;
  contact.tangent_mass = 1 / (tangent_inverse + contact.yielding);
  contact.least_speed = given.depth < 0
                            ? given.depth / seconds_
                            : std::min(kPart * std::max(0.0, given.depth - kLeft) / seconds_, kFastestParting);
  const double approach = -SpeedAlong(contact, contact.normal);
  if (given.restitution > 0 && approach > kLeastBounce && given.depth + approach * seconds_ >= 0)
    contact.least_speed = std::max(contact.least_speed, given.restitution * approach);
}

void PlanarSolver::Solve(int iterations)
{
  contacts_.reserve(given_.size());
  for (const PlanarContact& given : given_) Prepare(given);
  for (int iteration = 0; iteration < iterations; ++iteration)
  {
    for (Robot& robot : robots_)
      if (robot.is_moving) robot.has_moved = Drive(robot);
    for (Contact& contact : contacts_)
    {
      if (!contact.first->is_moving && (contact.second == nullptr || !contact.second->is_moving)) continue;
      if (!Touch(contact)) continue;
      contact.first->has_moved = true;
      if (contact.second != nullptr) contact.second->has_moved = true;
    }
    bool is_any_moving = false;
    for (Robot& robot : robots_)
    {
      robot.is_moving = robot.has_moved;
      robot.has_moved = false;
      is_any_moving = is_any_moving || robot.is_moving;
    }
    if (!is_any_moving) break;
  }
  for (Robot& robot : robots_) Move(robot);
}

// The motors and the ground at both wheels.
bool PlanarSolver::Drive(Robot& robot)
{
  double largest = 0;
  // Each wheel stops the sliding with the mass that it drives forward, so that it rubs against its slip.
  const double half = -robot.left * robot.ground_mass;
  for (std::size_t wheel = 0; wheel < 2; ++wheel)
  {
    const double side = wheel == 0 ? -robot.half_track : robot.half_track;
    const double ground = robot.forward + side * robot.turn;
    double& rim = robot.rim[wheel];
    const double most = robot.most_motor[wheel];
    const double grip = robot.most_grip[wheel];
    double along = 0, across = 0;
    // The ground brings its slip to 0, within the disc of friction.
    const auto hold = [&](double wanted)
    {
      along = robot.along[wheel] + wanted;
      across = robot.across[wheel] + half;
      const double square = along * along + across * across;
      if (square <= grip * grip) return;
      const double part = grip / std::sqrt(square);
      along *= part;
      across *= part;
    };
    // This impulse brings the rim to its command.
    const auto motor_wanted = [&]
    { return robot.motor[wheel] + robot.rim_mass * (robot.command[wheel] - rim) + along - robot.along[wheel]; };
    hold((robot.command[wheel] - ground) * robot.ground_mass);
    double motor = motor_wanted();
    if (std::abs(motor) > most)
    {
      // The motor is too weak, so the ground and the rim come to one speed.
      motor = std::clamp(motor, -most, most);
      hold((rim + (motor - robot.motor[wheel]) * robot.inverse_rim_mass - ground) * robot.slip_mass);
      motor = std::clamp(motor_wanted(), -most, most);
    }
    const double more_along = along - robot.along[wheel];
    const double more_motor = motor - robot.motor[wheel];
    largest = std::max({largest, std::abs(more_along), std::abs(more_motor)});
    rim += (more_motor - more_along) * robot.inverse_rim_mass;
    robot.forward += more_along * robot.inverse_mass;
    robot.turn += side * more_along * robot.inverse_inertia;
    const double more_across = across - robot.across[wheel];
    largest = std::max(largest, std::abs(more_across));
    robot.left += more_across * robot.inverse_mass;
    robot.motor[wheel] = motor;
    robot.along[wheel] = along;
    robot.across[wheel] = across;
  }
  return largest > kSmallest * robot.mass;
}

bool PlanarSolver::Touch(Contact& contact)
{
  const double most = contact.friction * contact.pressed;
  double largest = 0;
  if (most > 0 || contact.rubbed != 0)
  {
    const double slip = SpeedAlong(contact, contact.tangent) + contact.yielding * contact.rubbed;
    const double rubbed = std::clamp(contact.rubbed - slip * contact.tangent_mass, -most, most);
    largest = std::abs(rubbed - contact.rubbed);
    Push(contact, contact.tangent, rubbed - contact.rubbed);
    contact.rubbed = rubbed;
  }
  const double missing = contact.least_speed - SpeedAlong(contact, contact.normal);
  const double pressed = std::max(0.0, contact.pressed + missing * contact.normal_mass);
  if (pressed != contact.pressed)
  {
    largest = std::max(largest, std::abs(pressed - contact.pressed));
    Push(contact, contact.normal, pressed - contact.pressed);
    contact.pressed = pressed;
  }
  return largest > kSmallest * contact.first->mass;
}

void PlanarSolver::Move(Robot& robot) const
{
  PlaneMotion& motion = *robot.motion;
  motion.vx = motion.cosine * robot.forward - motion.sine * robot.left;
  motion.vy = motion.sine * robot.forward + motion.cosine * robot.left;
  motion.spin = robot.turn;
  motion.x += motion.vx * seconds_;
  motion.y += motion.vy * seconds_;
  const SinCos half_turn = SinCosOf(motion.spin * seconds_ / 2);
  motion.RotateHalfTurn(half_turn);
  motion.RotateHeading(half_turn);
  motion.RotateHeading(half_turn);
  for (std::size_t wheel = 0; wheel < 2; ++wheel)
  {
    motion.rates[wheel] = robot.rim[wheel] / robot.wheel_radius;
    motion.turned[wheel] = motion.rates[wheel] * seconds_;
  }
}

}  // namespace swarmanoid::dynamics3d

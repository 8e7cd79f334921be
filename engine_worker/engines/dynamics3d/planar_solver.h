// PlanarSolver: the contacts of robots on wheels that stand on level ground and meet upright walls or one another. Each
// robot is one rigid body in the plane with two wheels on it: the ground bears it without contacts, and its wheels hold
// within their friction cones, driven by their motors. Used by ContactFreeSet, by one thread at a time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/math/pose.h"
#include "engine_worker/engines/dynamics3d/differential_drive.h"

namespace swarmanoid::dynamics3d
{

// A point where a robot meets a wall or another robot.
struct PlanarContact
{
  std::size_t first = 0;
  int second = -1;                   // -1: what never moves
  Vector2 normal = Vector2::Zero();  // into the first one
  Vector2 point = Vector2::Zero();
  double depth = 0;  // m; negative: a gap
  double friction = 0;
  double restitution = 0;
  double yielding = 0;  // m/s per N of friction
};

class PlanarSolver
{
public:
  // Begins a step of `seconds`, on a floor of that friction. `gravity` in m/s2.
  void Begin(double seconds, double wheel_friction, double gravity);
  // Adds a robot, whose motion must stay where it is until Solve, and returns its number.
  std::size_t Add(const DifferentialDrive& drive, PlaneMotion& motion, const std::array<double, 2>& commands);
  void Add(const PlanarContact& contact);
  // Moves all robots by the step.
  void Solve(int iterations);
  bool IsEmpty() const { return robots_.empty(); }
  std::size_t ContactCount() const { return contacts_.size(); }

private:
  // Speeds are those of the robot forward and to the left, and of the rims of its wheels. Impulses are N s.
  struct Robot
  {
    PlaneMotion* motion;
    double mass, inverse_mass, inverse_inertia;
    double half_track, wheel_radius;
    double rim_mass, inverse_rim_mass;  // a wheel's inertia at its rim
    double ground_mass, slip_mass;      // that the ground drives at a wheel, without and with its rim
    double forward, left, turn;
    std::array<double, 2> rim, command;
    std::array<double, 2> most_motor, most_grip;
    std::array<double, 2> motor, along, across;
    // An impulse on it changed in the last sweep, or in this one.
    bool is_moving = true, has_moved = false;
  };
  // A direction as speeds of a robot: forward, left, turn.
  using Row = std::array<double, 3>;
  struct Contact
  {
    Robot* first;
    Robot* second;  // nullptr: what never moves
    std::array<Row, 2> normal, tangent;
    double normal_mass, tangent_mass;
    double least_speed;  // along the normal
    double friction, yielding;
    double pressed = 0, rubbed = 0;
  };

  static double SpeedAlong(const Contact& contact, const std::array<Row, 2>& rows);
  static void Push(Contact& contact, const std::array<Row, 2>& rows, double impulse);
  void Prepare(const PlanarContact& contact);
  // Return whether an impulse changed.
  static bool Drive(Robot& robot);
  static bool Touch(Contact& contact);
  void Move(Robot& robot) const;

  double seconds_ = 0;
  double wheel_friction_ = 1;
  double gravity_ = 0;
  std::vector<Robot> robots_;
  std::vector<PlanarContact> given_;
  std::vector<Contact> contacts_;
};

}  // namespace swarmanoid::dynamics3d

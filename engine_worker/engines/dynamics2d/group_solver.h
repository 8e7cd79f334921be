// Moves the bodies of one contact group through the steps of a tick: wheels and friction against the ground, grips and
// contacts. The result follows from the bodies, the group and the settings alone, so that any thread or process may
// solve any group. Bodies are in one array; a group has their numbers.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine_worker/engines/dynamics2d/manifold.h"
#include "engine_worker/engines/dynamics2d/plane_body.h"

namespace swarmanoid::dynamics2d
{

struct SolverSettings
{
  std::int32_t velocity_iterations = 8;
  std::int32_t position_iterations = 3;
  double turret_torque = 0;  // N m, of the motor that turns a gripping turret
  std::uint32_t measures_loads = 0;
};

// The forces of a contact in the last step. The next step begins with them.
struct ContactForces
{
  std::int32_t points = 0;
  std::array<std::uint32_t, 2> features{};  // of the points: which corners and edges meet
  std::array<double, 2> normal{};           // N
  std::array<double, 2> tangent{};          // N
};

// Two parts that meet: 0 is the outline of a body, and 1 the square of its gripper. `a` moves and has the smaller
// number, unless `b` is static.
struct Contact
{
  std::uint32_t a, b;
  std::uint8_t part_a, part_b;
  std::uint8_t touches;
  ContactForces forces;
};

// Where a body began, and how far it may get until the groups are found again.
struct Way
{
  double x, y, angle;
  double most;  // m
};

// A body while its group is solved.
struct Mover
{
  double vx, vy, turn;
  double mass, inertia, inverse_mass, inverse_inertia;
  BodyPlace place, before;  // now, and before the step
  double angle, angle_before;
  PlaneVelocity wanted;          // against the ground
  double most_force, most_turn;  // impulses of the ground in this step
  double ground_x, ground_y, ground_turn;
  double way;  // m, in this step, by itself
  double turret_cos, turret_sin;
  ChordOfStep chord;
  std::array<PartShape, 2> parts;
  std::array<Corner, 4> square;
  std::uint32_t body;
  bool moves;     // by the solver
  bool is_bound;  // by a contact or grip, in this step
};

struct Candidate
{
  std::uint32_t a, b;  // movers
  std::uint8_t part_a, part_b;
  bool touches;
  double friction, restitution;
  ContactForces forces;
};

struct ContactPoint
{
  double ax, ay, bx, by;  // from the middles of both bodies
  double normal_mass, tangent_mass, inverse_normal_mass, inverse_tangent_mass;
  double target;  // velocity along the normal, at least
  double normal, tangent;
};

struct ContactRow
{
  Candidate* candidate;
  Manifold manifold;
  double normal_x, normal_y;
  std::array<ContactPoint, 2> points;
};

struct GripRow
{
  std::uint32_t holder, held;  // movers
  double anchor_x, anchor_y;   // of the held body, against its middle
  double axis_x, axis_y;       // of a rod
  double mass, turn_mass, motor_speed;
  double impulse_x, impulse_y, impulse_turn;
};

struct GroupRun
{
  // What the group is.
  std::vector<std::uint32_t> bodies;  // that move, ascending
  std::vector<Way> ways;              // of `bodies`
  std::vector<std::uint32_t> fixed;   // static bodies near them, ascending
  std::vector<Contact> contacts;      // after the last step, by `a`
  bool is_bounded = true;             // `ways` limit where the bodies may get
  // What is done.
  std::int32_t steps_done = 0;  // of the tick
  bool goes_too_far = false;    // a body was pushed farther than its way allows, or is about to be
  // Memory of the solver.
  std::vector<Mover> movers;
  std::vector<Candidate> candidates;
  std::vector<ContactRow> rows;
  std::vector<GripRow> grips;
  std::vector<std::array<std::uint32_t, 2>> pairs;
  std::vector<std::uint32_t> by_x;
};

// Makes the steps of a tick that are left, each of `seconds`. Stops after one in which a body of a bounded group goes
// too far.
void SolveGroup(std::span<Body> bodies, GroupRun& run, const SolverSettings& settings, double seconds, int steps);

}  // namespace swarmanoid::dynamics2d

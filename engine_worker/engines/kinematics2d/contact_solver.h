// Pushes overlapping bodies apart: an elastic, frictionless exchange of the ways that they made within a step. Used by
// the kinematic world. Contacts act on leaders: a body on its own, or the prey of a gripped group, which moves as one.
#pragma once

#include <cstdint>
#include <vector>

#include "engine_worker/engines/kinematics2d/narrow_phase.h"

namespace swarmanoid::kinematics2d
{

// A Touch between two leaders, in terms of their positions. The second of a contact with a static shape is the index of
// a body at the origin that has no weight.
struct Contact
{
  std::uint32_t first = 0, second = 0;
  Touch touch;
  double bounce = 0;  // metres of overlap that came from approaching in this step and are given back
};

// A leader in a contact, and where it stood before the solver.
struct TouchedLeader
{
  std::uint32_t leader = 0;
  double x = 0, y = 0;
};

class ContactSolver
{
public:
  void Configure(std::size_t bodies);

  void Clear();
  void Add(const Contact& contact, const std::vector<double>& x, const std::vector<double>& y);
  // Moves the leaders until no contact is deeper than `tolerance` or the sweeps are used up; shares follow `mobility`,
  // the inverse of a weight. No leader is moved further than `reach`. Contacts are handled in the order of adding.
  void Solve(const std::vector<double>& mobility, double tolerance, double reach, std::vector<double>& x,
             std::vector<double>& y);

  const std::vector<Contact>& Contacts() const { return contacts_; }
  const std::vector<TouchedLeader>& Touched() const { return touched_; }

private:
  void Note(std::uint32_t leader, const std::vector<double>& x, const std::vector<double>& y);
  double Sweep(const std::vector<double>& mobility, bool bounce, std::vector<double>& x, std::vector<double>& y);

  std::vector<Contact> contacts_;
  std::vector<TouchedLeader> touched_;
  std::vector<std::uint8_t> is_touched_;
};

}  // namespace swarmanoid::kinematics2d

// Pushes overlapping bodies apart: an elastic, frictionless exchange of the ways that they made within a step. Used by
// the kinematic world. Contacts act on leaders: a body on its own, or the prey of a gripped group, which moves as one.
#pragma once

#include <cstdint>
#include <vector>

#include "engine_worker/engines/kinematics2d/narrow_phase.h"

namespace swarmanoid::kinematics2d
{

// A Touch between two leaders, in terms of their positions. The second of a contact with a static shape is the index of
// a body at the origin that cannot move.
struct Contact
{
  std::uint32_t first = 0, second = 0;
  Touch touch;
  double bounce = 0;  // metres of overlap that came from approaching in this step and are given back
};

// A leader that was pushed, and where it stood before.
struct PushedLeader
{
  std::uint32_t leader = 0;
  double x = 0, y = 0;
};

class ContactSolver
{
public:
  void Configure(std::size_t bodies);

  void Clear();
  void Add(const Contact& contact, bool overlapping)
  {
    if (overlapping) active_.push_back(static_cast<std::uint32_t>(contacts_.size()));
    contacts_.push_back(contact);
  }
  // In their order.
  void Add(const std::vector<Contact>& contacts)
  {
    for (const Contact& contact : contacts) Add(contact, contact.touch.depth > 0);
  }
  // Moves the leaders until no contact is deeper than `tolerance` or the sweeps are used up; shares follow `mobility`,
  // the inverse of a weight. No leader is moved further than `reach`. Contacts are handled in the order of adding.
  void Solve(const std::vector<double>& mobility, double tolerance, double reach, std::vector<double>& x,
             std::vector<double>& y);

  const std::vector<Contact>& Contacts() const { return contacts_; }
  const std::vector<PushedLeader>& Pushed() const { return pushed_; }
  bool WasPushed(std::uint32_t leader) const { return last_push_[leader] != 0; }
  bool HasOverlaps() const { return !active_.empty(); }

private:
  // One pass over the active contacts; those that may need another one stay active.
  void Sweep(std::uint8_t sweep, double tolerance, const std::vector<double>& mobility, std::vector<double>& x,
             std::vector<double>& y);
  void ActivateNeighbours(std::uint8_t since);
  void NotePush(std::uint32_t leader, std::uint8_t sweep, double x, double y);

  std::vector<Contact> contacts_;
  std::vector<std::uint32_t> active_;  // contacts, ascending
  std::vector<PushedLeader> pushed_;
  std::vector<std::uint8_t> last_push_;  // of each leader: the sweep, from 1; 0 for none
};

}  // namespace swarmanoid::kinematics2d

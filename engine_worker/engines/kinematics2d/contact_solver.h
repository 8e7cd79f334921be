// Pushes overlapping bodies apart: an elastic, frictionless exchange of the ways that they made within a step. Used by
// the kinematic world. Contacts act on leaders: a body on its own, or the prey of a gripped group, which moves as one.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "engine_worker/engines/kinematics2d/narrow_phase.h"

namespace swarmanoid::kinematics2d
{

// Touches between two leaders, in terms of their positions. The second of a contact with a static shape is the index of
// a body at the origin that cannot move.
class ContactList
{
public:
  // As in Touch.
  struct Outline
  {
    double x, y, reach;
    double bounce;  // metres of overlap that came from approaching in this step and are given back

    double Depth(bool face, double dx, double dy) const
    {
      if (face) return reach - (dx * x + dy * y);
      return reach - std::sqrt((dx + x) * (dx + x) + (dy + y) * (dy + y));
    }
  };
  struct Ends
  {
    std::uint32_t first;
    std::uint32_t second : 31, face : 1;
  };

  // Makes room for this many, at least.
  void Grow(std::size_t contacts);
  void Clear() { count_ = overlaps_ = 0; }
  void Add(std::uint32_t first, std::uint32_t second, const Touch& touch, double bounce)
  {
    if (count_ == ends_.size()) Grow(count_ + 1);
    ends_[count_] = {first, second & 0x7fffffffU, touch.face};
    outlines_[count_] = {touch.x, touch.y, touch.reach, bounce};
    overlapping_[overlaps_] = count_;
    overlaps_ += touch.depth > 0 ? 1 : 0;
    ++count_;
  }
  void Append(const ContactList& others);

  // One entry of both for each contact: ends are searched as a whole several times.
  std::span<const Ends> AllEnds() const { return {ends_.data(), count_}; }
  std::span<const Outline> Outlines() const { return {outlines_.data(), count_}; }
  // The contacts that overlapped when they were found, ascending.
  std::span<const std::uint32_t> Overlapping() const { return {overlapping_.data(), overlaps_}; }

private:
  // As long as there is room; those behind `count_` and `overlaps_` mean nothing.
  std::vector<Ends> ends_;
  std::vector<Outline> outlines_;
  std::vector<std::uint32_t> overlapping_;
  std::uint32_t count_ = 0, overlaps_ = 0;
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

  // Without contacts and pushes.
  void Clear();
  ContactList& Contacts() { return contacts_; }
  // Moves the leaders until no contact is deeper than `tolerance` or the sweeps are used up; shares follow `mobility`,
  // the inverse of a weight; empty if all bodies have the same. No leader is moved further than `reach`. Contacts
  // are handled in the order of adding.
  void Solve(std::span<const double> mobility, double tolerance, double reach, std::vector<double>& x,
             std::vector<double>& y);

  const std::vector<PushedLeader>& Pushed() const { return pushed_; }
  // After Solve. Calls `act` with both leaders of every contact that may still be deeper than `allowed`, which is more
  // than the tolerance.
  template <class Act>
  void ForEachDeeper(double allowed, const std::vector<double>& x, const std::vector<double>& y, const Act& act) const
  {
    const std::span<const ContactList::Ends> ends = contacts_.AllEnds();
    for (std::size_t k = 0; k < ends.size(); ++k)
    {
      const auto [i, j, face] = ends[k];
      if (!IsPushedSince(i, j, last_search_)) continue;
      if (contacts_.Outlines()[k].Depth(face != 0, x[i] - x[j], y[i] - y[j]) > allowed) act(i, j);
    }
  }

private:
  struct Push
  {
    double x, y, depth;
  };

  // What the solver works on, of each leader.
  struct Leaders
  {
    const double* mobility;  // nullptr if those of all bodies are 1
    double* x;
    double* y;
    std::uint32_t statics;  // the leader of all static shapes

    double MobilityOf(std::uint32_t leader) const
    {
      return mobility != nullptr ? mobility[leader] : leader != statics ? 1.0 : 0.0;
    }
  };

  static bool IsDeep(const ContactList::Outline& outline, bool face, double limit, double dx, double dy, Push& push);
  void PushApart(ContactList::Ends ends, const ContactList::Outline& outline, std::uint8_t sweep, double limit,
                 const Leaders& leaders);
  void Prefetch(std::uint32_t contact, const Leaders& leaders) const;
  void ActivateNeighbours(std::uint8_t sweep);
  void NotePush(std::uint32_t leader, std::uint8_t sweep, double x, double y);
  bool IsPushedSince(std::uint32_t i, std::uint32_t j, int sweep) const
  {
    return ((last_push_[i] >= sweep) | (last_push_[j] >= sweep)) != 0;
  }

  ContactList contacts_;
  std::vector<std::uint32_t> active_;  // contacts, ascending; longer than what it holds
  std::size_t active_count_ = 0;
  std::vector<PushedLeader> pushed_;
  std::vector<std::uint8_t> last_push_;  // of each leader: the sweep, from 1; 0 for none
  std::uint8_t last_search_ = 0;         // the sweep before which active contacts were looked for among all
};

}  // namespace swarmanoid::kinematics2d

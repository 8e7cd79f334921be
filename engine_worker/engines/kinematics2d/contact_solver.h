// Pushes overlapping bodies apart: an elastic exchange of the ways that they made within a step, without friction
// between bodies and with Coulomb's friction along static shapes. Contacts act on leaders: a body on its own, or the
// prey of a gripped group, which moves as one. The derivation is in contact_solver.cpp.
#pragma once

#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "common/threads/worker_pool.h"
#include "engine_worker/engines/kinematics2d/motion.h"
#include "engine_worker/engines/kinematics2d/narrow_phase.h"

namespace swarmanoid::kinematics2d
{

// Touches between two leaders, in terms of their positions. The second leader of a contact with a static shape is the
// index of a body at the origin that cannot move.
class ContactList
{
public:
  // The form of the contact, as in Touch.
  struct Outline
  {
    double x, y, reach;
    double bounce;    // metres of overlap that came from approaching in this step and are given back
    double friction;  // Coulomb coefficient; 0 between two bodies
  };
  struct Ends
  {
    std::uint32_t first;
    std::uint32_t second : 31, face : 1;
  };

  // Makes room for at least this many contacts.
  void Grow(std::size_t contacts);
  void Clear() { count_ = overlaps_ = 0; }
  void Add(std::uint32_t first, std::uint32_t second, const Touch& touch, double bounce, double friction)
  {
    if (count_ == ends_.size()) Grow(count_ + 1);
    ends_[count_] = {first, second & 0x7fffffffU, touch.face};
    outlines_[count_] = {touch.x, touch.y, touch.reach, bounce, friction};
    overlapping_[overlaps_] = count_;
    overlaps_ += touch.depth > 0 ? 1 : 0;
    ++count_;
  }
  void Append(const ContactList& others);

  // Each contact has one entry in both arrays, since the solver often searches ends alone.
  std::span<const Ends> AllEnds() const { return {ends_.data(), count_}; }
  std::span<const Outline> Outlines() const { return {outlines_.data(), count_}; }
  // The contacts that overlapped when they were found, ascending.
  std::span<const std::uint32_t> Overlapping() const { return {overlapping_.data(), overlaps_}; }

private:
  // The arrays have room for more; entries behind `count_` and `overlaps_` mean nothing.
  std::vector<Ends> ends_;
  std::vector<Outline> outlines_;
  std::vector<std::uint32_t> overlapping_;
  std::uint32_t count_ = 0, overlaps_ = 0;
};

// A range of contacts of one list, and the range of those that overlapped: from the first to before the last.
struct ContactBlock
{
  const ContactList* list = nullptr;
  std::uint32_t first = 0, last = 0;
  std::uint32_t first_overlapping = 0, last_overlapping = 0;
  std::uint32_t last_of_groups = 0;  // of another list: before which contacts of groups were found with these
};

class ContactSolver
{
public:
  // When a push happens: visits are numbered by round and colour, each with kMostSweeps sweeps.
  using Stamp = std::uint16_t;

  // The arrays of leaders that the solver works on.
  struct Leaders
  {
    const double* mobility;  // nullptr if those of all bodies are 1
    double* x;
    double* y;
    const double* before_x;  // where the substep began
    const double* before_y;
    Stamp* last_push;       // 0 for never
    std::uint32_t statics;  // the leader of all static shapes
    double most;            // metres that a push parts by

    double MobilityOf(std::uint32_t leader) const
    {
      return mobility != nullptr ? mobility[leader] : leader != statics ? 1.0 : 0.0;
    }
    bool IsPushedSince(ContactList::Ends ends, Stamp since) const
    {
      return ((last_push[ends.first] >= since) | (last_push[ends.second] >= since)) != 0;
    }
  };

  // The border of a region in a cut plane. Each region solves its own blocks, and all of them solve the last colour.
  class Border
  {
  public:
    virtual ~Border() = default;
    // Is called after each colour but the last one. Sends the leaders with pushes from `begin` on to all regions that
    // hold them. Returns whether `moved` is true in any region.
    virtual bool AfterColour(Stamp begin, bool moved) = 0;
    // Returns the leaders of the last colour as they are now. A push parts them by up to `most` (m).
    virtual Leaders TakeShared(double most) = 0;
    // Puts the leaders back that were pushed from `begin` on.
    virtual void PutShared(Stamp begin) = 0;
  };

  void Configure(std::size_t bodies, unsigned threads);

  // Moves the leaders until no contact is deeper than `tolerance` or the visits are used up. Their shares follow
  // `mobility`, the inverse of a weight; it is empty if all weigh the same. A push parts by up to `most` (m), so that
  // bodies that were put deep into each other do not jump past others.
  void Solve(std::span<const std::vector<ContactBlock>> colours, std::span<const double> mobility, double tolerance,
             double most, PoseStore& now, const PoseStore& before, WorkerPool* pool, Border* border = nullptr);

  // Returns whether the last Solve moved it.
  bool IsPushed(std::uint32_t leader) const { return last_push_[leader] != 0; }
  // Calls act(leader) for each leader that the last Solve moved, in the threads of `pool` if there is one.
  template <class Act>
  void ForEachPushed(WorkerPool* pool, const Act& act) const
  {
    InParts(pool, last_push_.size(), kMany,
            [&](unsigned, std::size_t begin, std::size_t end) { ForEachPushed(begin, end, act); });
  }

  // When each leader was pushed last in Solve.
  std::span<Stamp> LastPushes() { return last_push_; }

private:
  struct Push
  {
    double x, y, depth;
  };
  static constexpr std::size_t kMany = sizeof(std::uint64_t) / sizeof(Stamp);

  template <class Act>
  void ForEachPushed(std::size_t begin, std::size_t end, const Act& act) const
  {
    // Few are: many at a time are looked at.
    for (std::size_t k = begin; k < end; k += kMany)
    {
      std::uint64_t many;
      std::memcpy(&many, &last_push_[k], sizeof many);
      if (many == 0) continue;
      for (std::size_t n = k; n < k + kMany; ++n)
        if (last_push_[n] != 0) act(static_cast<std::uint32_t>(n));
    }
  }

  static bool IsDeep(const ContactList::Outline& outline, bool face, double limit, double dx, double dy, Push& push);
  static bool PushApart(ContactList::Ends ends, const ContactList::Outline& outline, Stamp now, double limit,
                        bool bounces, const Leaders& leaders);
  static bool Visit(const ContactBlock& block, Stamp begin, Stamp since, double tolerance, const Leaders& leaders,
                    std::vector<std::uint32_t>& active);
  static void Rub(std::uint32_t leader, const Push& push, double most, const Leaders& leaders);
  static void Prefetch(ContactList::Ends ends, const Leaders& leaders);

  std::uint32_t statics_ = 0;                       // the leader of all static shapes
  std::vector<Stamp> last_push_;                    // of each leader; 0 for never; padded for ForEachPushed
  std::vector<std::vector<std::uint32_t>> active_;  // of each thread: contacts, ascending; longer than what it holds
};

}  // namespace swarmanoid::kinematics2d

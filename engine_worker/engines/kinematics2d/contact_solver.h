// Pushes overlapping bodies apart: an elastic, frictionless exchange of the ways that they made within a step. Used by
// the kinematic world. Contacts act on leaders: a body on its own, or the prey of a gripped group, which moves as one.
//
// Contacts come in blocks, and blocks in colours. Those of one colour share no leader, so that threads can take any of
// them in any order; inside a block contacts are handled in the order of adding. So threads change no bit.
#pragma once

#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "common/threads/worker_pool.h"
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

// Contacts of one list, and those of them that overlapped: from the first to before the last.
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

  // What the solver works on, of each leader.
  struct Leaders
  {
    const double* mobility;  // nullptr if those of all bodies are 1
    double* x;
    double* y;
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

  // Of a world that is cut into regions: each solves the blocks of its own, and all of them alike the last colour.
  class Border
  {
  public:
    virtual ~Border() = default;
    // After each colour but the last one: those with pushes from `begin` on are told to all regions that hold them.
    // Returns whether `moved` is true in any region.
    virtual bool AfterColour(Stamp begin, bool moved) = 0;
    // What the contacts of the last colour act on, as it is now; then those of it with pushes from `begin` on are put
    // back.
    virtual Leaders TakeShared(double most) = 0;
    virtual void PutShared(Stamp begin) = 0;
  };

  void Configure(std::size_t bodies, unsigned threads);

  // Moves the leaders until no contact is deeper than `tolerance` or the visits are used up; shares follow `mobility`,
  // the inverse of a weight; empty if all bodies have the same. One push parts by up to `most` (metres), so that bodies
  // that were put deep into each other do not jump past others.
  void Solve(std::span<const std::vector<ContactBlock>> colours, std::span<const double> mobility, double tolerance,
             double most, std::vector<double>& x, std::vector<double>& y, WorkerPool* pool, Border* border = nullptr);

  // Whether the last Solve moved it.
  bool IsPushed(std::uint32_t leader) const { return last_push_[leader] != 0; }
  // In the threads of `pool`, if there is one.
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
  static void Prefetch(ContactList::Ends ends, const Leaders& leaders);

  std::uint32_t statics_ = 0;                       // the leader of all static shapes
  std::vector<Stamp> last_push_;                    // of each leader; 0 for never; padded for ForEachPushed
  std::vector<std::vector<std::uint32_t>> active_;  // of each thread: contacts, ascending; longer than what it holds
};

}  // namespace swarmanoid::kinematics2d

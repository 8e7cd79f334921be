// ContactGroups: the groups of bodies that can touch each other before the groups are found again, directly or through
// others. An engine solves each group in a solver world of its own, so that no group's motion depends on another one,
// on threads or on processes. Used by the engines of rigid bodies, in the thread that steps them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine_worker/engines/rigid_bodies/islands.h"
#include "engine_worker/engines/rigid_bodies/separation_test.h"

namespace swarmanoid
{

// Two bodies that hold each other: a joint or a grip.
struct BodyLink
{
  std::uint32_t first;
  std::uint32_t second;
};

// The input of a search. Bodies are numbered from 0 in the order of their entities. A gap (m) is what remains after
// both bodies have gone their ways.
struct ContactQuery
{
  double margin = 0;  // bodies with a smaller gap are in one group, also if nothing pushes them
  double band = 0;    // a pair that was in one group stays in it up to `margin` + `band`
  double pushed = 0;  // the solver may push a body of a group by this much farther than its own way
  // All pairs with gaps up to `margin` + `band` and up to two pushes. `second` counts on to fixed outlines.
  std::span<const GapPair> pairs;
  std::span<const BodyLink> links;
  std::span<const std::uint8_t> is_pushable;    // of each body: 0 for a mirror, which moves others and is not moved
  std::span<const std::uint32_t> group_before;  // of each body: any number of its group, kAlone if it had none
};

class ContactGroups
{
public:
  static constexpr std::uint32_t kAlone = 0xffffffff;

  // Finds the groups. They depend on nothing but the query, and not on the order of its pairs and links.
  void Find(const ContactQuery& query);
  // Puts all bodies into one group with all `fixed` outlines. Nothing is in a group if no body is pushable.
  void FindOne(std::span<const std::uint8_t> is_pushable, std::uint32_t fixed);

  // The number of groups. They come in the order of their first bodies. Each has at least one pushable body, and at
  // least two bodies or a fixed outline.
  std::size_t Count() const { return first_body_.size() - 1; }
  // The bodies of a group, ascending.
  std::span<const std::uint32_t> Bodies(std::size_t group) const
  {
    return std::span(bodies_).subspan(first_body_[group], first_body_[group + 1] - first_body_[group]);
  }
  // The fixed outlines near a group, ascending, numbered from 0.
  std::span<const std::uint32_t> Fixed(std::size_t group) const
  {
    return std::span(fixed_).subspan(first_fixed_[group], first_fixed_[group + 1] - first_fixed_[group]);
  }
  // The group of a body, or kAlone.
  std::uint32_t GroupOf(std::uint32_t body) const { return group_of_[body]; }

private:
  struct FixedNear
  {
    std::uint32_t group, fixed;
    bool operator==(const FixedNear&) const = default;
  };
  bool IsGrouped(std::uint32_t body) { return is_grouped_[islands_.Of(body)] != 0; }
  void Join(std::uint32_t a, std::uint32_t b);
  void ListBodies(std::uint32_t bodies);
  void ListFixed();

  Islands islands_;
  std::vector<std::uint8_t> is_grouped_;  // by the first body of an island
  std::vector<std::uint32_t> group_of_;   // of each body
  std::vector<std::uint32_t> first_body_ = {0}, bodies_;
  std::vector<std::uint32_t> first_fixed_ = {0}, fixed_;
  std::vector<FixedNear> near_fixed_;
};

}  // namespace swarmanoid

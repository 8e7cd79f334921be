// Problem: find groups of bodies such that no body can touch a body of another group, or a fixed outline that its group
// does not know, although solvers push bodies beyond the ways that they can go by themselves.
//
// Method: connected components (a union-find) over pairs with a small gap, joints and grips. A body that is alone is
// not pushed, so that two such bodies need no margin. A body of a group can be pushed: bodies within a push of it join
// the group, and groups within two pushes of each other become one, until none is left.
//
// Invariants: the result follows from the query alone. A group is numbered by its first body. Pairs stay together up to
// a larger gap than that at which they join, so that few groups change from tick to tick.
#include "engine_worker/engines/rigid_bodies/contact_groups.h"

#include <algorithm>

namespace swarmanoid
{

void ContactGroups::Find(const ContactQuery& query)
{
  const auto bodies = static_cast<std::uint32_t>(query.is_pushable.size());
  islands_.Reset(bodies);
  is_grouped_.assign(bodies, 0);
  for (const BodyLink& link : query.links) Join(link.first, link.second);
  const auto is_pushable = [&](std::uint32_t body) { return query.is_pushable[body] != 0; };
  const auto is_fixed = [&](const GapPair& pair) { return pair.second >= bodies; };
  const auto joins = [&](const GapPair& pair)
  {
    const std::uint32_t before = query.group_before[pair.first];
    const bool were_together = before != kAlone && (is_fixed(pair) || before == query.group_before[pair.second]);
    return pair.gap < (were_together ? query.margin + query.band : query.margin);
  };
  for (const GapPair& pair : query.pairs)
  {
    if (!joins(pair) || !(is_pushable(pair.first) || (!is_fixed(pair) && is_pushable(pair.second)))) continue;
    if (is_fixed(pair))
      is_grouped_[islands_.Of(pair.first)] = 1;
    else
      Join(pair.first, pair.second);
  }

  for (bool has_changed = true; has_changed;)
  {
    has_changed = false;
    for (const GapPair& pair : query.pairs)
    {
      if (is_fixed(pair) || islands_.Of(pair.first) == islands_.Of(pair.second)) continue;
      const int pushes = (is_pushable(pair.first) && IsGrouped(pair.first) ? 1 : 0) +
                         (is_pushable(pair.second) && IsGrouped(pair.second) ? 1 : 0);
      if (pushes == 0 || pair.gap >= pushes * query.pushed) continue;
      Join(pair.first, pair.second);
      has_changed = true;
    }
  }

  ListBodies(bodies);
  near_fixed_.clear();
  for (const GapPair& pair : query.pairs)
    if (is_fixed(pair) && is_pushable(pair.first) && group_of_[pair.first] != kAlone &&
        (pair.gap < query.pushed || joins(pair)))
      near_fixed_.push_back({group_of_[pair.first], pair.second - bodies});
  ListFixed();
}

// Makes two islands one, which is a group.
void ContactGroups::Join(std::uint32_t a, std::uint32_t b)
{
  islands_.Join(a, b);
  is_grouped_[islands_.Of(a)] = 1;
}

void ContactGroups::FindOne(std::span<const std::uint8_t> is_pushable, std::uint32_t fixed)
{
  const auto bodies = static_cast<std::uint32_t>(is_pushable.size());
  islands_.Reset(bodies);
  is_grouped_.assign(bodies, 0);
  near_fixed_.clear();
  if (std::ranges::find_if(is_pushable, [](std::uint8_t is) { return is != 0; }) != is_pushable.end())
  {
    for (std::uint32_t body = 0; body < bodies; ++body) Join(0, body);
    for (std::uint32_t number = 0; number < fixed; ++number) near_fixed_.push_back({0, number});
  }
  ListBodies(bodies);
  ListFixed();
}

void ContactGroups::ListBodies(std::uint32_t bodies)
{
  group_of_.resize(bodies);
  first_body_.assign(1, 0);
  for (std::uint32_t body = 0; body < bodies; ++body)
  {
    const std::uint32_t first = islands_.Of(body);
    if (is_grouped_[first] == 0)
    {
      group_of_[body] = kAlone;
      continue;
    }
    if (first == body)
    {
      group_of_[body] = static_cast<std::uint32_t>(first_body_.size() - 1);
      first_body_.push_back(0);
    }
    group_of_[body] = group_of_[first];
    ++first_body_[group_of_[body] + 1];
  }
  for (std::size_t group = 1; group < first_body_.size(); ++group) first_body_[group] += first_body_[group - 1];
  bodies_.resize(first_body_.back());
  // Each start moves to its end while the list is filled, and then back.
  for (std::uint32_t body = 0; body < bodies; ++body)
    if (group_of_[body] != kAlone) bodies_[first_body_[group_of_[body]]++] = body;
  for (std::size_t group = first_body_.size() - 1; group > 0; --group) first_body_[group] = first_body_[group - 1];
  first_body_[0] = 0;
}

// Lists the fixed outlines of near_fixed_ by group.
void ContactGroups::ListFixed()
{
  std::ranges::sort(near_fixed_, [](const FixedNear& a, const FixedNear& b)
                    { return a.group < b.group || (a.group == b.group && a.fixed < b.fixed); });
  near_fixed_.erase(std::unique(near_fixed_.begin(), near_fixed_.end()), near_fixed_.end());
  first_fixed_.assign(first_body_.size(), 0);
  fixed_.clear();
  for (const FixedNear& near : near_fixed_)
  {
    ++first_fixed_[near.group + 1];
    fixed_.push_back(near.fixed);
  }
  for (std::size_t group = 1; group < first_fixed_.size(); ++group) first_fixed_[group] += first_fixed_[group - 1];
}

}  // namespace swarmanoid

// Problem: regions that compute parts of one plane must come to the same bits as one world.
//
// Method: each decision about a body is computed by one region and sent to all that hold the body, or computed by all
// from the same numbers. Each region solves the blocks of its own; after each colour, pushes of common bodies are sent
// to their holders. Contacts that are not bound to a block (of groups and of large bodies) are sent to all regions,
// which solve them alike as the last colour. So are the limits of motions, whose rounds end for all at once.
//
// Invariants: all regions make the same exchanges in the same order. Contacts that several regions send are put into
// the order in which one world finds them. Leaders and limited bodies that a region does not hold get numbers behind
// those of its own. Source: docs/scaling.md.
#include "engine_worker/engines/kinematics2d/region_border.h"

#include <algorithm>
#include <numeric>

namespace swarmanoid::kinematics2d
{
namespace
{

// Returns the motion of another leader: number_of(leader) instead of its own.
template <class NumberOf>
std::uint32_t Renamed(std::uint32_t motion, const NumberOf& number_of)
{
  const std::uint32_t number = number_of(LeaderOfMotion(motion));
  return motion % 2 == 0 ? WayMotion(number) : TurnMotion(number);
}

template <class NumberOf>
LimitList::Bound Renamed(LimitList::Bound bound, const NumberOf& number_of)
{
  bound.motion = Renamed(bound.motion, number_of);
  return bound;
}

template <class NumberOf>
LimitList::Chase Renamed(LimitList::Chase chase, const NumberOf& number_of)
{
  for (std::uint32_t* motion : {&chase.motion, &chase.ahead[0], &chase.ahead[1]}) *motion = Renamed(*motion, number_of);
  return chase;
}

}  // namespace

void RegionBorder::ShareMaxima(std::initializer_list<double*> numbers)
{
  mail_.Swap(
      [&](unsigned, ByteWriter& message)
      {
        for (const double* number : numbers) message.Put(*number);
      },
      [&](unsigned, ByteReader& message)
      {
        for (double* number : numbers) *number = std::max(*number, message.Get<double>());
      });
}

// A pair is computed by the region of the small body. A pair of large ones, or with a static shape, is computed by that
// of the first body that has a region. Pairs that cannot move have none.
void RegionBorder::ChoosePairsOfLarge()
{
  order_of_large_.clear();
  const Bodies& bodies = plane_.bodies;
  const BroadPhase& broad = plane_.contacts.broad;
  PairList& large_pairs = plane_.contacts.PairsOfLarge();
  const auto is_large = [&](std::uint32_t body) { return broad.IsLarge(bodies.RadiusOf(body)); };
  const auto behind_cells = static_cast<std::uint32_t>(broad.Cells().Count());
  std::erase_if(large_pairs.pairs,
                [&](const Pair& pair)
                {
                  const bool fixed = bodies.IsStatic(pair.second);
                  auto [large, other] = pair;
                  if (!is_large(large)) std::swap(large, other);
                  const bool both = !fixed && is_large(other);
                  const std::uint32_t computed = fixed || (both && !bodies.IsFollower(large)) ? large : other;
                  const std::uint32_t here = bodies.IsFollower(computed) ? large : computed;
                  if (!bodies_.IsOwn(here)) return true;
                  Order order{bodies_.NumberInWhole(large) + 1, behind_cells + 1, 0};
                  if (fixed)
                    order.other = pair.second - static_cast<std::uint32_t>(bodies.count);
                  else
                  {
                    order.other = bodies_.NumberInWhole(other);
                    order.cell =
                        both ? behind_cells : broad.Cells().CellOf(bodies.before.x[other], bodies.before.y[other]);
                  }
                  order_of_large_.push_back(order);
                  return false;
                });
  large_pairs.ends.resize(order_of_large_.size());
  std::iota(large_pairs.ends.begin(), large_pairs.ends.end(), 1U);
}

RegionBorder::SharedLeader RegionBorder::LeaderAt(std::uint32_t leader) const
{
  const Bodies& bodies = plane_.bodies;
  if (bodies.IsStatic(leader)) return {kNobody, 0, 0, 0, 0, 0, 0};
  return {bodies_.NumberInWhole(leader), 0,
          bodies.now.x[leader],          bodies.now.y[leader],
          bodies.before.x[leader],       bodies.before.y[leader],
          plane_.groups.mobility[leader]};
}

// Adds the shared contacts that this region found, each with its place in the order of all.
void RegionBorder::AddOwnContacts()
{
  const ContactList& contacts = plane_.contacts.shared;
  std::size_t overlapping = 0;
  std::uint32_t n = 0;
  const auto add_to = [&](std::size_t end, const Order& order)
  {
    for (; n < end; ++n)
    {
      const ContactList::Ends ends = contacts.AllEnds()[n];
      const bool overlaps = overlapping < contacts.Overlapping().size() && contacts.Overlapping()[overlapping] == n;
      overlapping += overlaps ? 1 : 0;
      shared_contacts_.push_back(
          {order, ends.face != 0, overlaps, LeaderAt(ends.first), LeaderAt(ends.second), contacts.Outlines()[n]});
    }
  };
  std::size_t begin = 0, b = 0;
  for (const Contacts::Part& part : plane_.contacts.parts)
  {
    for (const std::uint32_t block : part.blocks)
      add_to(begin + plane_.contacts.of_blocks[b++].last_of_groups, {0, block, 0});
    begin += part.of_groups.AllEnds().size();
  }
  for (std::size_t k = 0; k < order_of_large_.size(); ++k) add_to(plane_.contacts.of_large[k].last, order_of_large_[k]);
}

void RegionBorder::ShareContacts()
{
  is_sent_.assign(plane_.bodies.count, 0);
  shared_contacts_.clear();
  AddOwnContacts();
  bool overlaps = !plane_.contacts.shared.Overlapping().empty();
  for (const ContactBlock& block : plane_.contacts.of_blocks)
    overlaps |= block.first_overlapping != block.last_overlapping;
  overlaps_anywhere_ = overlaps;

  const std::vector<SharedContact> own = shared_contacts_;
  mail_.Swap(
      [&](unsigned, ByteWriter& message)
      {
        message.Put(overlaps);
        message.PutArray(own);
      },
      [&](unsigned, ByteReader& message)
      {
        overlaps_anywhere_ |= message.Get<bool>();
        const auto theirs = message.GetArray<SharedContact>();
        shared_contacts_.insert(shared_contacts_.end(), theirs.begin(), theirs.end());
      });
  // Contacts of one block, or of one pair, are from one region, in their order.
  std::ranges::stable_sort(shared_contacts_, {}, &SharedContact::order);
  NumberLeaders();
}

// The contacts become those of the last colour, between leaders that are numbered among themselves.
void RegionBorder::NumberLeaders()
{
  shared_numbers_.clear();
  for (const SharedContact& contact : shared_contacts_)
    for (const SharedLeader* leader : {&contact.first, &contact.second})
      if (leader->number != kNobody) shared_numbers_.push_back(leader->number);
  std::sort(shared_numbers_.begin(), shared_numbers_.end());
  shared_numbers_.erase(std::unique(shared_numbers_.begin(), shared_numbers_.end()), shared_numbers_.end());

  const std::size_t leaders = shared_numbers_.size();
  for (std::vector<double>* values : {&shared_x_, &shared_y_, &shared_before_x_, &shared_before_y_, &shared_mobility_})
    values->assign(leaders + 1, 0);
  shared_pushes_.assign(leaders + 1, 0);
  shared_bodies_.resize(leaders);
  for (std::size_t k = 0; k < leaders; ++k) shared_bodies_[k] = bodies_.Find(shared_numbers_[k]);

  ContactList& shared = plane_.contacts.shared;
  shared.Clear();
  const auto index_of = [&](const SharedLeader& leader)
  {
    const std::uint32_t k = IndexOfShared(leader.number);
    shared_x_[k] = leader.x;
    shared_y_[k] = leader.y;
    shared_before_x_[k] = leader.before_x;
    shared_before_y_[k] = leader.before_y;
    shared_mobility_[k] = leader.mobility;
    return k;
  };
  for (const SharedContact& contact : shared_contacts_)
  {
    const std::uint32_t first = index_of(contact.first);
    const std::uint32_t second = index_of(contact.second);
    const ContactList::Outline& outline = contact.outline;
    const double depth = contact.overlaps != 0 ? 1.0 : -1.0;
    shared.Add(first, second, {outline.x, outline.y, outline.reach, contact.face != 0, 0, 0, depth}, outline.bounce,
               outline.friction);
  }
}

// Static shapes come behind all others.
std::uint32_t RegionBorder::IndexOfShared(std::uint32_t number) const
{
  return static_cast<std::uint32_t>(std::lower_bound(shared_numbers_.begin(), shared_numbers_.end(), number) -
                                    shared_numbers_.begin());
}

// The bodies that were pushed from `begin` on, each with its index in the list.
void RegionBorder::ListPushed(std::span<const std::uint32_t> bodies, Stamp begin, std::vector<Pushed>& pushed)
{
  const PoseStore& now = plane_.bodies.now;
  const std::span<const Stamp> pushes = plane_.contacts.solver.LastPushes();
  pushed.clear();
  for (std::uint32_t k = 0; k < bodies.size(); ++k)
  {
    const std::uint32_t body = bodies[k];
    if (body != kNobody && pushes[body] >= begin) pushed.push_back({k, pushes[body], now.x[body], now.y[body]});
  }
}

bool RegionBorder::AfterColour(Stamp begin, bool moved)
{
  PoseStore& now = plane_.bodies.now;
  const std::span<Stamp> pushes = plane_.contacts.solver.LastPushes();
  bool moved_anywhere = moved;
  ListPushed(shared_bodies_, begin, shared_pushed_);
  mail_.Swap(
      [&](unsigned region, ByteWriter& message)
      {
        ListPushed(bodies_.Common(region), begin, pushed_);
        message.Put(moved);
        message.Put(static_cast<std::uint32_t>(bodies_.Common(region).size()));
        message.PutArray(pushed_);
        message.PutArray(shared_pushed_);
      },
      [&](unsigned region, ByteReader& message)
      {
        const auto push = [&](std::uint32_t body, const Pushed& pushed)
        {
          now.x[body] = pushed.x;
          now.y[body] = pushed.y;
          pushes[body] = static_cast<Stamp>(pushed.stamp);
        };
        const std::span<const std::uint32_t> common = bodies_.Common(region);
        moved_anywhere |= message.Get<bool>();
        if (message.Get<std::uint32_t>() != common.size()) RefuseRegion("two of them hold different common bodies");
        for (const Pushed& pushed : message.GetArray<Pushed>())
        {
          if (pushed.index >= common.size()) RefuseRegion("a push is of a body that is not common");
          push(common[pushed.index], pushed);
        }
        for (const Pushed& pushed : message.GetArray<Pushed>())
        {
          const std::uint32_t body = shared_bodies_.at(pushed.index);
          if (body != kNobody) push(body, pushed);
          shared_x_[pushed.index] = pushed.x;
          shared_y_[pushed.index] = pushed.y;
          shared_pushes_[pushed.index] = static_cast<Stamp>(pushed.stamp);
        }
      });
  return moved_anywhere;
}

ContactSolver::Leaders RegionBorder::TakeShared(double most)
{
  const std::span<const Stamp> pushes = plane_.contacts.solver.LastPushes();
  for (std::size_t k = 0; k < shared_bodies_.size(); ++k)
  {
    const std::uint32_t body = shared_bodies_[k];
    if (body == kNobody) continue;
    shared_x_[k] = plane_.bodies.now.x[body];
    shared_y_[k] = plane_.bodies.now.y[body];
    shared_pushes_[k] = pushes[body];
  }
  return {shared_mobility_.data(),
          shared_x_.data(),
          shared_y_.data(),
          shared_before_x_.data(),
          shared_before_y_.data(),
          shared_pushes_.data(),
          static_cast<std::uint32_t>(shared_bodies_.size()),
          most};
}

void RegionBorder::PutShared(Stamp begin)
{
  const std::span<Stamp> pushes = plane_.contacts.solver.LastPushes();
  for (std::size_t k = 0; k < shared_bodies_.size(); ++k)
  {
    const std::uint32_t body = shared_bodies_[k];
    if (body == kNobody || shared_pushes_[k] < begin) continue;
    plane_.bodies.now.x[body] = shared_x_[k];
    plane_.bodies.now.y[body] = shared_y_[k];
    pushes[body] = shared_pushes_[k];
  }
}

bool RegionBorder::ShareInvolved(bool more)
{
  std::vector<std::uint8_t>& is_involved = plane_.limits.is_involved;
  // The indices of bodies in the common list of each region. No region is told twice.
  std::vector<std::vector<std::uint32_t>> news(mail_.RegionCount());
  for (unsigned region = 0; region < news.size(); ++region)
  {
    const std::span<const std::uint32_t> common = bodies_.Common(region);
    for (std::uint32_t k = 0; k < common.size(); ++k)
      if (is_involved[common[k]] != 0 && is_sent_[common[k]] == 0) news[region].push_back(k);
    more |= !news[region].empty();
  }
  bool more_anywhere = more;
  mail_.Swap(
      [&](unsigned region, ByteWriter& message)
      {
        for (const std::uint32_t k : news[region]) is_sent_[bodies_.Common(region)[k]] = 1;
        message.Put(more);
        message.PutArray(news[region]);
      },
      [&](unsigned region, ByteReader& message)
      {
        const std::span<const std::uint32_t> common = bodies_.Common(region);
        more_anywhere |= message.Get<bool>();
        for (const std::uint32_t k : message.GetArray<std::uint32_t>())
        {
          if (k >= common.size()) RefuseRegion("a body to limit is not common");
          is_involved[common[k]] = is_sent_[common[k]] = 1;
        }
      });
  return more_anywhere;
}

std::uint32_t RegionBorder::LimitedBody(std::uint32_t number)
{
  const std::uint32_t body = bodies_.Find(number);
  if (body != kNobody) return body;
  const auto next = static_cast<std::uint32_t>(plane_.bodies.count + 1 + limited_elsewhere_.size());
  return limited_elsewhere_.emplace(number, next).first->second;
}

const LimitList& RegionBorder::ShareLimits()
{
  std::vector<LimitList::Bound> bounds;
  std::vector<LimitList::Chase> chases;
  const auto in_whole = [&](std::uint32_t body) { return bodies_.NumberInWhole(body); };
  for (const Limits::Part& part : plane_.limits.parts)
  {
    for (const LimitList::Bound& bound : part.limits.Bounds()) bounds.push_back(Renamed(bound, in_whole));
    for (const LimitList::Chase& chase : part.limits.Chases()) chases.push_back(Renamed(chase, in_whole));
  }

  limits_of_others_.Clear();
  limited_elsewhere_.clear();
  const auto here = [&](std::uint32_t number) { return LimitedBody(number); };
  mail_.Swap(
      [&](unsigned, ByteWriter& message)
      {
        message.PutArray(bounds);
        message.PutArray(chases);
      },
      [&](unsigned, ByteReader& message)
      {
        for (const auto& bound : message.GetArray<LimitList::Bound>()) limits_of_others_.Add(Renamed(bound, here));
        for (const auto& chase : message.GetArray<LimitList::Chase>()) limits_of_others_.Add(Renamed(chase, here));
      });
  plane_.limits.limiter.MakeRoom(plane_.bodies.count + 1 + limited_elsewhere_.size());
  return limits_of_others_;
}

}  // namespace swarmanoid::kinematics2d

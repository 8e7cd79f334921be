// KinematicWorld::Region: what regions tell one another while contacts are solved and motions limited.
#include <algorithm>
#include <numeric>

#include "engine_worker/engines/kinematics2d/kinematic_region.h"

namespace swarmanoid::kinematics2d
{

KinematicWorld::Region::SharedLeader KinematicWorld::Region::LeaderAt(const KinematicWorld& world,
                                                                      std::uint32_t leader) const
{
  if (leader >= world.count_) return {kNobody, 0, 0, 0, 0};
  return {numbers_[leader], 0, world.now_.x[leader], world.now_.y[leader], world.mobility_[leader]};
}

// A pair is computed by the region of the small body; between large ones, and with static shapes, by that of the first
// one that has a region. Pairs that cannot move have none.
void KinematicWorld::Region::ChoosePairsOfLarge(KinematicWorld& world)
{
  order_of_large_.clear();
  const auto is_large = [&](std::uint32_t body) { return world.broad_.IsLarge(world.RadiusOf(body)); };
  const auto cells = static_cast<std::uint32_t>(world.broad_.Cells().Count());
  std::erase_if(
      world.pairs_of_large_.pairs,
      [&](const Pair& pair)
      {
        const bool fixed = pair.second >= world.count_;
        auto [large, other] = pair;
        if (!is_large(large)) std::swap(large, other);
        const bool both = !fixed && is_large(other);
        const std::uint32_t computed = fixed || (both && !world.IsFollower(large)) ? large : other;
        const std::uint32_t here = world.IsFollower(computed) ? large : computed;
        if (!IsOwn(here)) return true;
        const std::uint32_t place = fixed ? cells + 1
                                    : both
                                        ? cells
                                        : world.broad_.Cells().CellOf(world.before_.x[other], world.before_.y[other]);
        order_of_large_.push_back({numbers_[large] + 1, place,
                                   fixed ? pair.second - static_cast<std::uint32_t>(world.count_) : numbers_[other]});
        return false;
      });
  std::vector<std::uint32_t>& ends = world.pairs_of_large_.ends;
  ends.resize(order_of_large_.size());
  std::iota(ends.begin(), ends.end(), 1U);
}

void KinematicWorld::Region::AddOwnContacts(const KinematicWorld& world)
{
  const ContactList& contacts = world.shared_contacts_;
  std::size_t overlapping = 0;
  std::uint32_t n = 0;
  const auto add_to = [&](std::size_t end, const Order& order)
  {
    for (; n < end; ++n)
    {
      const ContactList::Ends ends = contacts.AllEnds()[n];
      const bool overlaps = overlapping < contacts.Overlapping().size() && contacts.Overlapping()[overlapping] == n;
      overlapping += overlaps ? 1 : 0;
      shared_contacts_.push_back({order, ends.face != 0, overlaps, LeaderAt(world, ends.first),
                                  LeaderAt(world, ends.second), contacts.Outlines()[n]});
    }
  };
  std::size_t begin = 0, b = 0;
  for (const Part& part : world.parts_)
  {
    for (const std::uint32_t block : part.blocks)
      add_to(begin + world.block_contacts_[b++].last_of_groups, {0, block, 0});
    begin += part.of_groups.AllEnds().size();
  }
  for (std::size_t k = 0; k < order_of_large_.size(); ++k) add_to(world.contacts_of_large_[k].last, order_of_large_[k]);
}

void KinematicWorld::Region::ShareContacts(KinematicWorld& world)
{
  solved_ = &world;
  is_told_.assign(world.count_, 0);
  shared_contacts_.clear();
  AddOwnContacts(world);
  overlaps_anywhere_ = !world.shared_contacts_.Overlapping().empty();
  for (const ContactBlock& block : world.block_contacts_)
    overlaps_anywhere_ |= block.first_overlapping != block.last_overlapping;

  ForEachOther(
      [&](unsigned region)
      {
        out_[region].Put(overlaps_anywhere_);
        out_[region].PutArray(shared_contacts_);
      });
  Swap();
  ForEachOther(
      [&](unsigned region)
      {
        ByteReader message(in_[region]);
        overlaps_anywhere_ |= message.Get<bool>();
        const auto theirs = message.GetArray<SharedContact>();
        shared_contacts_.insert(shared_contacts_.end(), theirs.begin(), theirs.end());
      });
  // Those of a block, or of a pair, are from one region, in their order.
  std::stable_sort(shared_contacts_.begin(), shared_contacts_.end(),
                   [](const SharedContact& a, const SharedContact& b) { return a.order < b.order; });
  NumberLeaders(world);
}

// The contacts become those of the world's last colour, between leaders that are numbered among themselves.
void KinematicWorld::Region::NumberLeaders(KinematicWorld& world)
{
  shared_numbers_.clear();
  for (const SharedContact& contact : shared_contacts_)
    for (const SharedLeader* leader : {&contact.first, &contact.second})
      if (leader->number != kNobody) shared_numbers_.push_back(leader->number);
  std::sort(shared_numbers_.begin(), shared_numbers_.end());
  shared_numbers_.erase(std::unique(shared_numbers_.begin(), shared_numbers_.end()), shared_numbers_.end());

  const std::size_t leaders = shared_numbers_.size();
  shared_x_.assign(leaders + 1, 0);
  shared_y_.assign(leaders + 1, 0);
  shared_mobility_.assign(leaders + 1, 0);
  shared_pushes_.assign(leaders + 1, 0);
  shared_bodies_.resize(leaders);
  for (std::size_t k = 0; k < leaders; ++k) shared_bodies_[k] = FindBody(shared_numbers_[k]);

  world.shared_contacts_.Clear();
  for (const SharedContact& contact : shared_contacts_)
  {
    std::uint32_t ends[2];
    for (int side = 0; side < 2; ++side)
    {
      const SharedLeader& leader = side == 0 ? contact.first : contact.second;
      const std::uint32_t k = ends[side] = IndexOfShared(leader.number);
      shared_x_[k] = leader.x;
      shared_y_[k] = leader.y;
      shared_mobility_[k] = leader.mobility;
    }
    const ContactList::Outline& outline = contact.outline;
    world.shared_contacts_.Add(
        ends[0], ends[1],
        {outline.x, outline.y, outline.reach, contact.face != 0, 0, 0, contact.overlaps != 0 ? 1.0 : -1.0},
        outline.bounce);
  }
}

// That of static shapes is behind all others.
std::uint32_t KinematicWorld::Region::IndexOfShared(std::uint32_t number) const
{
  return static_cast<std::uint32_t>(std::lower_bound(shared_numbers_.begin(), shared_numbers_.end(), number) -
                                    shared_numbers_.begin());
}

bool KinematicWorld::Region::AfterColour(Stamp begin, bool moved)
{
  PoseStore& now = solved_->now_;
  const std::span<Stamp> pushes = solved_->solver_.LastPushes();
  const auto list_pushed = [&](std::span<const std::uint32_t> bodies)
  {
    pushed_.clear();
    for (std::uint32_t k = 0; k < bodies.size(); ++k)
    {
      const std::uint32_t body = bodies[k];
      if (body != kNobody && pushes[body] >= begin) pushed_.push_back({k, pushes[body], now.x[body], now.y[body]});
    }
  };
  ForEachOther(
      [&](unsigned region)
      {
        list_pushed(common_[region]);
        out_[region].Put(moved);
        out_[region].Put(static_cast<std::uint32_t>(common_[region].size()));
        out_[region].PutArray(pushed_);
      });
  list_pushed(shared_bodies_);
  ForEachOther([&](unsigned region) { out_[region].PutArray(pushed_); });
  Swap();
  ForEachOther(
      [&](unsigned region)
      {
        const std::vector<std::uint32_t>& bodies = common_[region];
        const auto push = [&](std::uint32_t body, const Pushed& pushed)
        {
          now.x[body] = pushed.x;
          now.y[body] = pushed.y;
          pushes[body] = static_cast<Stamp>(pushed.stamp);
        };
        ByteReader message(in_[region]);
        moved |= message.Get<bool>();
        if (message.Get<std::uint32_t>() != bodies.size()) Refuse("two of them hold different bodies of their border");
        for (const Pushed& pushed : message.GetArray<Pushed>()) push(bodies.at(pushed.index), pushed);
        for (const Pushed& pushed : message.GetArray<Pushed>())
        {
          const std::uint32_t body = shared_bodies_.at(pushed.index);
          if (body != kNobody) push(body, pushed);
          shared_x_[pushed.index] = pushed.x;
          shared_y_[pushed.index] = pushed.y;
          shared_pushes_[pushed.index] = static_cast<Stamp>(pushed.stamp);
        }
      });
  return moved;
}

ContactSolver::Leaders KinematicWorld::Region::TakeShared(double most)
{
  const std::span<const Stamp> pushes = solved_->solver_.LastPushes();
  for (std::size_t k = 0; k < shared_bodies_.size(); ++k)
  {
    const std::uint32_t body = shared_bodies_[k];
    if (body == kNobody) continue;
    shared_x_[k] = solved_->now_.x[body];
    shared_y_[k] = solved_->now_.y[body];
    shared_pushes_[k] = pushes[body];
  }
  return {shared_mobility_.data(),
          shared_x_.data(),
          shared_y_.data(),
          shared_pushes_.data(),
          static_cast<std::uint32_t>(shared_bodies_.size()),
          most};
}

void KinematicWorld::Region::PutShared(Stamp begin)
{
  const std::span<Stamp> pushes = solved_->solver_.LastPushes();
  for (std::size_t k = 0; k < shared_bodies_.size(); ++k)
  {
    const std::uint32_t body = shared_bodies_[k];
    if (body == kNobody || shared_pushes_[k] < begin) continue;
    solved_->now_.x[body] = shared_x_[k];
    solved_->now_.y[body] = shared_y_[k];
    pushes[body] = shared_pushes_[k];
  }
}

bool KinematicWorld::Region::ShareInvolved(KinematicWorld& world, bool more)
{
  std::vector<std::vector<std::uint32_t>> news(common_.size());
  ForEachOther(
      [&](unsigned region)
      {
        const std::vector<std::uint32_t>& bodies = common_[region];
        for (std::uint32_t k = 0; k < bodies.size(); ++k)
          if (world.is_involved_[bodies[k]] != 0 && is_told_[bodies[k]] == 0) news[region].push_back(k);
        more |= !news[region].empty();
      });
  ForEachOther(
      [&](unsigned region)
      {
        for (const std::uint32_t k : news[region]) is_told_[common_[region][k]] = 1;
        out_[region].Put(more);
        out_[region].PutArray(news[region]);
      });
  Swap();
  ForEachOther(
      [&](unsigned region)
      {
        ByteReader message(in_[region]);
        more |= message.Get<bool>();
        for (const std::uint32_t k : message.GetArray<std::uint32_t>())
        {
          const std::uint32_t body = common_[region].at(k);
          world.is_involved_[body] = is_told_[body] = 1;
        }
      });
  return more;
}

// A body that is limited, or a number behind those of this region.
std::uint32_t KinematicWorld::Region::LimitedBody(const KinematicWorld& world, std::uint32_t number)
{
  const std::uint32_t body = FindBody(number);
  if (body != kNobody) return body;
  const auto next = static_cast<std::uint32_t>(world.count_ + 1 + limited_elsewhere_.size());
  return limited_elsewhere_.emplace(number, next).first->second;
}

const LimitList& KinematicWorld::Region::ShareLimits(KinematicWorld& world)
{
  std::vector<LimitList::Bound> bounds;
  std::vector<LimitList::Chase> chases;
  const auto rename = [](std::uint32_t motion, const auto& number_of)
  {
    const std::uint32_t number = number_of(LeaderOfMotion(motion));
    return motion % 2 == 0 ? WayMotion(number) : TurnMotion(number);
  };
  const auto in_whole = [&](std::uint32_t body) { return numbers_[body]; };
  const auto list = [&](const LimitList& limits)
  {
    for (LimitList::Bound bound : limits.Bounds())
    {
      bound.motion = rename(bound.motion, in_whole);
      bounds.push_back(bound);
    }
    for (LimitList::Chase chase : limits.Chases())
    {
      for (std::uint32_t* motion : {&chase.motion, &chase.ahead[0], &chase.ahead[1]})
        *motion = rename(*motion, in_whole);
      chases.push_back(chase);
    }
  };
  for (const Part& part : world.parts_) list(part.limits);
  list(world.limits_of_large_);
  ForEachOther(
      [&](unsigned region)
      {
        out_[region].PutArray(bounds);
        out_[region].PutArray(chases);
      });
  Swap();

  const auto here = [&](std::uint32_t number) { return LimitedBody(world, number); };
  limits_of_others_.Clear();
  limited_elsewhere_.clear();
  ForEachOther(
      [&](unsigned region)
      {
        ByteReader message(in_[region]);
        for (LimitList::Bound bound : message.GetArray<LimitList::Bound>())
        {
          bound.motion = rename(bound.motion, here);
          limits_of_others_.Add(bound);
        }
        for (LimitList::Chase chase : message.GetArray<LimitList::Chase>())
        {
          for (std::uint32_t* motion : {&chase.motion, &chase.ahead[0], &chase.ahead[1]})
            *motion = rename(*motion, here);
          limits_of_others_.Add(chase);
        }
      });
  world.limiter_.MakeRoom(world.count_ + 1 + limited_elsewhere_.size());
  return limits_of_others_;
}

}  // namespace swarmanoid::kinematics2d

// KinematicWorld::Region: what regions tell one another while contacts are solved and motions limited.
#include <algorithm>

#include "engine_worker/engines/kinematics2d/kinematic_region.h"

namespace swarmanoid::kinematics2d
{

KinematicWorld::Region::SharedLeader KinematicWorld::Region::LeaderAt(const KinematicWorld& world,
                                                                      std::uint32_t leader) const
{
  if (leader >= world.count_) return {kNobody, 0, 0, 0, 0};
  return {numbers_[leader], 0, world.now_.x[leader], world.now_.y[leader], world.mobility_[leader]};
}

void KinematicWorld::Region::AddOwnContacts(const KinematicWorld& world)
{
  for (const Part& part : world.parts_)
  {
    const ContactList& contacts = part.of_groups;
    std::size_t overlapping = 0;
    std::uint32_t n = 0;
    for (std::size_t b = part.first_block; b < part.last_block; ++b)
      for (; n < world.block_contacts_[b].last_of_groups; ++n)
      {
        const ContactList::Ends ends = contacts.AllEnds()[n];
        const bool overlaps = overlapping < contacts.Overlapping().size() && contacts.Overlapping()[overlapping] == n;
        overlapping += overlaps ? 1 : 0;
        shared_contacts_.push_back({world.blocks_[b], ends.face != 0, overlaps, 0, LeaderAt(world, ends.first),
                                    LeaderAt(world, ends.second), contacts.Outlines()[n]});
      }
  }
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
  // A block has its contacts from one region, in their order.
  std::stable_sort(shared_contacts_.begin(), shared_contacts_.end(),
                   [](const SharedContact& a, const SharedContact& b) { return a.block < b.block; });
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

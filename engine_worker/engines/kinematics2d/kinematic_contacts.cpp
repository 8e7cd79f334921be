// KinematicWorld::FindContacts: where the outlines of near pairs touch, in terms of their leaders.
#include <algorithm>

#include "engine_worker/engines/kinematics2d/kinematic_region.h"
#include "engine_worker/engines/kinematics2d/kinematic_world.h"

namespace swarmanoid::kinematics2d
{
namespace
{

// In large crowds the bodies are not in the cache: they are asked for this many pairs before they are needed.
constexpr std::size_t kPairsAhead = 12;
constexpr std::size_t kLeast = 512;  // bodies; below, handing parts over to threads takes longer

}  // namespace

void KinematicWorld::FindContacts()
{
  const double margin = 2 * reach_;
  SwapFollowers();
  const bool listed =
      verlet_list_.Update(broad_, region_ ? region_->HeldBlocks() : broad_.Blocks(), before_, present_, margin, Pool());
  if (!listed) broad_.Sort(before_, present_, Pool());
  broad_.FindPairsOfLarge(margin, before_, present_, pairs_of_large_.pairs);
  pairs_of_large_.ends.assign(1, static_cast<std::uint32_t>(pairs_of_large_.pairs.size()));
  if (region_) region_->ChoosePairsOfLarge(*this);
  SwapFollowers();
  broad_.ShareOut(blocks_, count_ < kLeast || Pool() == nullptr ? 1 : parts_.size(), parts_);
  for (Part& part : parts_)
  {
    part.pairs.pairs.clear();
    part.contacts.Clear();
    part.of_groups.Clear();
  }
  ForEachPart(
      [&](Part& part)
      {
        if (listed)
          verlet_list_.TakePairs(part.blocks, part.pairs);
        else
          broad_.FindPairs(margin, part.blocks, part.pairs);
        FindContacts(part.pairs, block_contacts_.data() + (part.blocks.data() - blocks_.data()), part.contacts,
                     part.of_groups);
      });

  shared_contacts_.Clear();
  for (const Part& part : parts_) shared_contacts_.Append(part.of_groups);
  if (!pairs_of_large_.pairs.empty())
  {
    contacts_of_large_.resize(pairs_of_large_.ends.size());
    FindContacts(pairs_of_large_, contacts_of_large_.data(), shared_contacts_, shared_contacts_);
  }
  statistics_.pairs = pairs_of_large_.pairs.size();
  statistics_.contacts = shared_contacts_.AllEnds().size();
  for (const Part& part : parts_)
  {
    statistics_.pairs += part.pairs.pairs.size();
    statistics_.contacts += part.contacts.AllEnds().size();
  }
  if (region_) region_->ShareContacts(*this);
}

// Writes down what of `contacts` belongs to each block of `pairs`.
void KinematicWorld::FindContacts(const PairList& pairs, ContactBlock* blocks, ContactList& contacts,
                                  ContactList& of_groups) const
{
  PairBatch batch;
  const bool everyone_is_free = EveryoneIsFree();
  std::uint32_t n = 0;
  for (const std::uint32_t end : pairs.ends)
  {
    blocks->list = &contacts;
    blocks->first = static_cast<std::uint32_t>(contacts.AllEnds().size());
    blocks->first_overlapping = static_cast<std::uint32_t>(contacts.Overlapping().size());
    for (; n < end; ++n)
    {
      const Pair& ahead = pairs.pairs[std::min<std::size_t>(n + kPairsAhead, pairs.pairs.size() - 1)];
      __builtin_prefetch(&placed_[ahead.first]);
      __builtin_prefetch(&placed_[ahead.second]);
      __builtin_prefetch(&before_.x[ahead.first]);
      __builtin_prefetch(&before_.y[ahead.first]);
      const auto [a, b] = pairs.pairs[n];
      const Placed& first = placed_[a];
      const Placed& second = placed_[b];
      if (b < count_)
      {
        const double dx = first.x - second.x;
        const double dy = first.y - second.y;
        const double limit = first.model->bounding_radius + second.model->bounding_radius + contact_margin_;
        if (dx * dx + dy * dy >= limit * limit) continue;
      }
      if (!everyone_is_free)
      {
        const std::uint32_t i = leader_[a];
        const std::uint32_t j = LeaderOf(b);
        if (i == j || mobility_[i] + mobility_[j] <= 0) continue;
      }
      if (batch.IsFull() || !batch.Takes(first, second)) AddContacts(batch, contacts, of_groups);
      batch.Add(first, second);
    }
    AddContacts(batch, contacts, of_groups);
    blocks->last = static_cast<std::uint32_t>(contacts.AllEnds().size());
    blocks->last_overlapping = static_cast<std::uint32_t>(contacts.Overlapping().size());
    blocks->last_of_groups = static_cast<std::uint32_t>(of_groups.AllEnds().size());
    ++blocks;
  }
}

// Whether there is an overlap anywhere.
bool KinematicWorld::ListContactsByColour()
{
  bool overlaps = false;
  for (std::vector<ContactBlock>& colour : colours_) colour.clear();
  const auto list = [&](const ContactBlock& contacts, std::size_t colour)
  {
    if (contacts.first == contacts.last) return;
    colours_[colour].push_back(contacts);
    overlaps |= contacts.first_overlapping != contacts.last_overlapping;
  };
  for (std::size_t n = 0; n < blocks_.size(); ++n) list(block_contacts_[n], broad_.ColourOf(blocks_[n]));
  list({&shared_contacts_, 0, static_cast<std::uint32_t>(shared_contacts_.AllEnds().size()), 0,
        static_cast<std::uint32_t>(shared_contacts_.Overlapping().size())},
       BroadPhase::kColours);
  return region_ ? region_->OverlapsAnywhere() : overlaps;
}

// Of all pairs of the batch, which is empty then.
void KinematicWorld::AddContacts(PairBatch& batch, ContactList& contacts, ContactList& of_groups) const
{
  if (batch.Count() == 0) return;
  batch.FindTouches(contact_margin_);
  batch.ForEachTouch(
      [&](std::size_t lane, Touch touch)
      {
        const Placed& a = batch.First(lane);
        const Placed& b = batch.Second(lane);
        const std::uint32_t first = NumberOf(a);
        const auto second = std::min(NumberOf(b), static_cast<std::uint32_t>(count_));  // one for all static shapes
        const std::uint32_t i = leader_[first];
        const std::uint32_t j = leader_[second];
        double dx = a.x - b.x;
        double dy = a.y - b.y;
        if (i != first || j != second)
        {
          // From the difference of the leaders to that of the bodies.
          const double shift_x = dx - (now_.x[i] - now_.x[j]);
          const double shift_y = dy - (now_.y[i] - now_.y[j]);
          dx = now_.x[i] - now_.x[j];
          dy = now_.y[i] - now_.y[j];
          if (touch.face)
            touch.reach -= shift_x * touch.x + shift_y * touch.y;
          else
          {
            touch.x += shift_x;
            touch.y += shift_y;
          }
        }
        double bounce = 0;
        if (touch.depth > 0)
        {
          const double length = touch.reach - touch.depth;
          const double nx = touch.face ? touch.x : length > 0 ? (dx + touch.x) / length : 1;
          const double ny = touch.face ? touch.y : length > 0 ? (dy + touch.y) / length : 0;
          const double way_x = dx - (before_.x[i] - before_.x[j]);
          const double way_y = dy - (before_.y[i] - before_.y[j]);
          bounce = elasticity_ * std::min(touch.depth, std::max(0.0, -(way_x * nx + way_y * ny)));
        }
        (i != first || j != second ? of_groups : contacts).Add(i, j, touch, bounce);
      });
  batch.Clear();
}

}  // namespace swarmanoid::kinematics2d

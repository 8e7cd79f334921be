// KinematicWorld::FindContacts: where the outlines of near pairs touch, in terms of their leaders.
#include <algorithm>

#include "engine_worker/engines/kinematics2d/kinematic_world.h"

namespace swarmanoid::kinematics2d
{
namespace
{

// In large crowds the bodies are not in the cache: they are asked for this many pairs before they are needed.
constexpr std::size_t kPairsAhead = 12;

}  // namespace

// Each thread some of the pairs, in their order; then one after the other into the solver.
void KinematicWorld::FindContacts(double margin)
{
  solver_.Clear();
  for (ContactList& contacts : contacts_of_others_) contacts.Clear();
  InParts(pool_.get(), broad_.Pairs().size(), 1,
          [&](unsigned part, std::size_t begin, std::size_t end)
          { FindContacts(margin, begin, end, part == 0 ? solver_.Contacts() : contacts_of_others_[part - 1]); });
  for (const ContactList& contacts : contacts_of_others_) solver_.Contacts().Append(contacts);
  FindStaticContacts(margin, solver_.Contacts());
}

void KinematicWorld::FindContacts(double margin, std::size_t begin, std::size_t end, ContactList& contacts) const
{
  PairBatch batch;
  const bool everyone_is_free = EveryoneIsFree();
  for (std::size_t n = begin; n < end; ++n)
  {
    const Pair& ahead = broad_.Pairs()[std::min(n + kPairsAhead, end - 1)];
    __builtin_prefetch(&placed_[ahead.first]);
    __builtin_prefetch(&placed_[ahead.second]);
    __builtin_prefetch(&before_.x[ahead.first]);
    __builtin_prefetch(&before_.y[ahead.first]);
    __builtin_prefetch(&before_.x[ahead.second]);
    __builtin_prefetch(&before_.y[ahead.second]);
    const auto [a, b] = broad_.Pairs()[n];
    if (!everyone_is_free && (leader_[a] == leader_[b] || mobility_[leader_[a]] + mobility_[leader_[b]] <= 0)) continue;
    if (batch.IsFull() || !batch.Takes(placed_[a], placed_[b])) AddContacts(batch, margin, contacts);
    batch.Add(placed_[a], placed_[b]);
  }
  AddContacts(batch, margin, contacts);
}

void KinematicWorld::FindStaticContacts(double margin, ContactList& contacts) const
{
  PairBatch batch;
  for (const Pair& pair : broad_.StaticPairs())
  {
    if (mobility_[leader_[pair.first]] <= 0) continue;
    const Placed& first = placed_[pair.first];
    const Placed& second = placed_[count_ + pair.second];
    if (batch.IsFull() || !batch.Takes(first, second)) AddContacts(batch, margin, contacts);
    batch.Add(first, second);
  }
  AddContacts(batch, margin, contacts);
}

// Of all pairs of the batch, which is empty then.
void KinematicWorld::AddContacts(PairBatch& batch, double margin, ContactList& contacts) const
{
  if (batch.Count() == 0) return;
  batch.FindTouches(margin);
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
        contacts.Add(i, j, touch, bounce);
      });
  batch.Clear();
}

}  // namespace swarmanoid::kinematics2d

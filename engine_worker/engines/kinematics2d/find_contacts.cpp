// Problem: find all places where outlines touch, or may come to touch while contacts are solved.
//
// Method: no body gets further than `reach` from where the substep began, so those that were further than twice that
// apart cannot meet: near pairs come from the grid (broad_phase.h), or from a Verlet list while the bodies move little
// (verlet_list.h). A pair whose circles are near where the free motion ended goes to the exact test (narrow_phase.h).
// A contact is stated in terms of its leaders' positions, so that pushes of leaders change its depth as they go.
//
// Two bodies that were put into each other are parted as wholes, by one contact along the line of their first parts.
// With several parts inside each other, each part has another shortest way out, and the ways can block each other for
// ever. In each substep both get at least kSlowestSeparation farther along that line than they were.
//
// A collision is elastic: of the overlap, what came from approaching in this substep is given back once more.
//
// Invariants: contacts stand in the order of blocks, and within a block in that of its pairs. Two blocks of one colour
// share no body. Contacts of groups and of large bodies may reach anywhere and come last, as one more colour. Source:
// docs/engines.md, "Crowds".
#include <algorithm>
#include <array>
#include <cmath>

#include "engine_worker/engines/kinematics2d/plane_step.h"
#include "engine_worker/engines/kinematics2d/step_constants.h"

namespace swarmanoid::kinematics2d
{
namespace
{

// In large crowds the bodies are not in the cache: they are asked for this many pairs before they are needed.
constexpr std::size_t kPairsAhead = 12;
constexpr std::size_t kLeastBodies = 512;  // below, handing parts over to threads takes longer

// Returns the part of an overlap that came from approaching, along the direction that parts the bodies.
double BounceOf(const Touch& touch, double dx, double dy, const PoseStore& before, std::uint32_t i, std::uint32_t j)
{
  const double length = touch.reach - touch.depth;
  const double nx = touch.face ? touch.x : length > 0 ? (dx + touch.x) / length : 1;
  const double ny = touch.face ? touch.y : length > 0 ? (dy + touch.y) / length : 0;
  const double way_x = dx - (before.x[i] - before.x[j]);
  const double way_y = dy - (before.y[i] - before.y[j]);
  return std::min(touch.depth, std::max(0.0, -(way_x * nx + way_y * ny)));
}

// Returns how much nearer (m) a pair of the batch came along a unit vector from the second body to the first one since
// the substep began.
double ApproachAlong(const PlaneState& plane, const PairBatch& batch, std::size_t lane, double x, double y)
{
  const Bodies& bodies = plane.bodies;
  const Placed& a = batch.First(lane);
  const Placed& b = batch.Second(lane);
  const std::uint32_t first = bodies.NumberOf(a);
  const std::uint32_t second = bodies.NumberOf(b);
  const bool is_static = bodies.IsStatic(second);
  const double way_x = a.x - bodies.before.x[first] - (is_static ? 0 : b.x - bodies.before.x[second]);
  const double way_y = a.y - bodies.before.y[first] - (is_static ? 0 : b.y - bodies.before.y[second]);
  return -(way_x * x + way_y * y);
}

// Returns the part (m) of the overlap at a touch that the way since the substep began does not explain.
double DepthBefore(const PlaneState& plane, const PairBatch& batch, std::size_t lane, const Touch& touch)
{
  const Placed& a = batch.First(lane);
  const Placed& b = batch.Second(lane);
  const double length = touch.reach - touch.depth;
  const double nx = touch.face ? touch.x : length > 0 ? (a.x - b.x + touch.x) / length : 1;
  const double ny = touch.face ? touch.y : length > 0 ? (a.y - b.y + touch.y) / length : 0;
  return touch.depth - std::max(0.0, ApproachAlong(plane, batch, lane, nx, ny));
}

// Returns for each pair of the batch whether it was put into each other: whether it overlapped when the substep began.
// The exact test is for the few pairs whose overlap does not come from their ways.
std::array<bool, kDoubleLanes> FindPutIntoEachOther(const PlaneState& plane, const PairBatch& batch)
{
  const double least = kPutIntoEachOther * plane.lengths.allowed;
  std::array<bool, kDoubleLanes> found{};
  bool any_deep = false;
  for (std::size_t lane = 0; lane < batch.Count(); ++lane) any_deep |= batch.Deepest(lane) > least;
  if (!any_deep) return found;
  batch.ForEachTouch(
      [&](std::size_t lane, const Touch& touch)
      {
        if (found[lane] || touch.depth <= least || DepthBefore(plane, batch, lane, touch) <= least) return;
        const Bodies& bodies = plane.bodies;
        const std::uint32_t first = bodies.NumberOf(batch.First(lane));
        const std::uint32_t second = bodies.NumberOf(batch.Second(lane));
        const Placed other = bodies.IsStatic(second) ? batch.Second(lane) : bodies.PlacedBefore(second);
        found[lane] = Overlap(bodies.PlacedBefore(first), other) > least;
      });
  return found;
}

// Returns the contact that parts a pair of the batch as a whole.
Touch WholeTouch(const PlaneState& plane, const PairBatch& batch, std::size_t lane)
{
  const Placed& a = batch.First(lane);
  const Placed& b = batch.Second(lane);
  const Vector2 apart = PartingDirection(a, b);
  const double x = apart.x();
  const double y = apart.y();
  const double back = ApproachAlong(plane, batch, lane, x, y) + 2 * kSlowestSeparation;
  const double depth = std::max(batch.Deepest(lane), back);
  return {x, y, (a.x - b.x) * x + (a.y - b.y) * y + depth, true, 0, 0, depth};
}

// Returns the Coulomb coefficient of a contact: friction acts along static shapes alone.
double FrictionOf(const CollisionModel& body, const CollisionModel& other, bool is_static)
{
  return is_static && other.friction > 0 ? std::sqrt(body.friction * other.friction) : 0;
}

// Adds the contacts of all pairs of the batch, and empties it.
void AddContacts(const PlaneState& plane, PairBatch& batch, ContactList& contacts, ContactList& of_groups)
{
  if (batch.Count() == 0) return;
  const Bodies& bodies = plane.bodies;
  batch.FindTouches(plane.lengths.contact_margin);
  const auto add = [&](std::size_t lane, Touch touch, double elasticity)
  {
    const Placed& a = batch.First(lane);
    const Placed& b = batch.Second(lane);
    const std::uint32_t first = bodies.NumberOf(a);
    // One number stands for all static shapes.
    const auto second = std::min(bodies.NumberOf(b), static_cast<std::uint32_t>(bodies.count));
    const std::uint32_t i = plane.groups.leader[first];
    const std::uint32_t j = plane.groups.leader[second];
    double dx = a.x - b.x;
    double dy = a.y - b.y;
    if (i != first || j != second)
    {
      // The shift turns the difference of the leaders into the difference of the bodies.
      const PoseStore& now = bodies.now;
      const double shift_x = dx - (now.x[i] - now.x[j]);
      const double shift_y = dy - (now.y[i] - now.y[j]);
      dx = now.x[i] - now.x[j];
      dy = now.y[i] - now.y[j];
      if (touch.face)
        touch.reach -= shift_x * touch.x + shift_y * touch.y;
      else
      {
        touch.x += shift_x;
        touch.y += shift_y;
      }
    }
    const double bounce = touch.depth > 0 ? elasticity * BounceOf(touch, dx, dy, bodies.before, i, j) : 0;
    const double friction = FrictionOf(*a.model, *b.model, bodies.IsStatic(second));
    (i != first || j != second ? of_groups : contacts).Add(i, j, touch, bounce, friction);
  };
  // The contacts come in the order of the pairs, whatever pairs share a batch.
  const std::array<bool, kDoubleLanes> put_into_each_other = FindPutIntoEachOther(plane, batch);
  std::size_t next_lane = 0;
  batch.ForEachTouch(
      [&](std::size_t lane, const Touch& touch)
      {
        const bool is_first = lane >= next_lane;
        next_lane = lane + 1;
        if (!put_into_each_other[lane])
          add(lane, touch, plane.contacts.elasticity);
        else if (is_first)
          add(lane, WholeTouch(plane, batch, lane), 0);
      });
  batch.Clear();
}

// Returns whether two bodies, or a body and a static shape, are near enough for the exact test.
bool CanTouch(const PlaneState& plane, const Pair& pair, const Placed& first, const Placed& second, bool each_is_free)
{
  if (!plane.bodies.IsStatic(pair.second))
  {
    const double dx = first.x - second.x;
    const double dy = first.y - second.y;
    const double limit = first.model->bounding_radius + second.model->bounding_radius + plane.lengths.contact_margin;
    if (dx * dx + dy * dy >= limit * limit) return false;
  }
  if (each_is_free) return true;
  const std::uint32_t i = plane.groups.leader[pair.first];
  const std::uint32_t j = plane.groups.LeaderOf(pair.second);
  return i != j && plane.groups.mobility[i] + plane.groups.mobility[j] > 0;
}

// Finds the contacts of `pairs`, and writes down which belong to each block of them.
void FindContactsOf(const PlaneState& plane, const PairList& pairs, ContactBlock* blocks, ContactList& contacts,
                    ContactList& of_groups)
{
  const Bodies& bodies = plane.bodies;
  const bool each_is_free = plane.EachIsFree();
  PairBatch batch;
  std::uint32_t n = 0;
  for (const std::uint32_t end : pairs.ends)
  {
    blocks->list = &contacts;
    blocks->first = static_cast<std::uint32_t>(contacts.AllEnds().size());
    blocks->first_overlapping = static_cast<std::uint32_t>(contacts.Overlapping().size());
    for (; n < end; ++n)
    {
      const Pair& ahead = pairs.pairs[std::min<std::size_t>(n + kPairsAhead, pairs.pairs.size() - 1)];
      __builtin_prefetch(&bodies.placed[ahead.first]);
      __builtin_prefetch(&bodies.placed[ahead.second]);
      __builtin_prefetch(&bodies.before.x[ahead.first]);
      __builtin_prefetch(&bodies.before.y[ahead.first]);
      const Pair pair = pairs.pairs[n];
      const Placed& first = bodies.placed[pair.first];
      const Placed& second = bodies.placed[pair.second];
      if (!CanTouch(plane, pair, first, second, each_is_free)) continue;
      if (batch.IsFull() || !batch.Takes(first, second)) AddContacts(plane, batch, contacts, of_groups);
      batch.Add(first, second);
    }
    AddContacts(plane, batch, contacts, of_groups);
    blocks->last = static_cast<std::uint32_t>(contacts.AllEnds().size());
    blocks->last_overlapping = static_cast<std::uint32_t>(contacts.Overlapping().size());
    blocks->last_of_groups = static_cast<std::uint32_t>(of_groups.AllEnds().size());
    ++blocks;
  }
}

}  // namespace

void FindNearPairs(PlaneState& plane, std::span<const std::uint32_t> held_blocks)
{
  Contacts& contacts = plane.contacts;
  const Bodies& bodies = plane.bodies;
  const double margin = 2 * plane.lengths.reach;
  for (Contacts::Part& part : contacts.parts)
  {
    part.pairs.pairs.clear();
    part.contacts.Clear();
    part.of_groups.Clear();
  }
  contacts.is_listed =
      contacts.verlet_list.Update(contacts.broad, held_blocks, bodies.before, bodies.is_present, margin, plane.Pool());
  if (!contacts.is_listed) contacts.broad.Sort(bodies.before, bodies.is_present, plane.Pool());
  PairList& large = contacts.PairsOfLarge();
  contacts.broad.FindPairsOfLarge(margin, bodies.before, bodies.is_present, large.pairs);
  large.ends.assign(1, static_cast<std::uint32_t>(large.pairs.size()));
}

void FindContacts(PlaneState& plane)
{
  Contacts& contacts = plane.contacts;
  const bool alone = plane.bodies.count < kLeastBodies || plane.Pool() == nullptr;
  contacts.broad.ShareOut(contacts.blocks, alone ? 1 : plane.PartCount(), contacts.parts);
  plane.ForEachPart(
      [&](unsigned k)
      {
        Contacts::Part& part = contacts.parts[k];
        if (contacts.is_listed)
          contacts.verlet_list.TakePairs(part.blocks, part.pairs);
        else
          contacts.broad.FindPairs(2 * plane.lengths.reach, part.blocks, part.pairs);
        ContactBlock* const blocks = contacts.of_blocks.data() + (part.blocks.data() - contacts.blocks.data());
        FindContactsOf(plane, part.pairs, blocks, part.contacts, part.of_groups);
      });

  ContactList& shared = contacts.shared;
  shared.Clear();
  for (const Contacts::Part& part : contacts.parts) shared.Append(part.of_groups);
  const PairList& large = contacts.PairsOfLarge();
  if (!large.pairs.empty())
  {
    contacts.of_large.resize(large.ends.size());
    FindContactsOf(plane, large, contacts.of_large.data(), shared, shared);
  }
  plane.statistics.pairs = 0;
  plane.statistics.contacts = shared.AllEnds().size();
  for (const Contacts::Part& part : contacts.parts)
  {
    plane.statistics.pairs += part.pairs.pairs.size();
    plane.statistics.contacts += part.contacts.AllEnds().size();
  }
}

bool SortContactsByColour(Contacts& contacts)
{
  bool overlap = false;
  for (std::vector<ContactBlock>& colour : contacts.colours) colour.clear();
  const auto add = [&](const ContactBlock& block, std::size_t colour)
  {
    if (block.first == block.last) return;
    contacts.colours[colour].push_back(block);
    overlap |= block.first_overlapping != block.last_overlapping;
  };
  for (std::size_t n = 0; n < contacts.blocks.size(); ++n)
    add(contacts.of_blocks[n], contacts.broad.ColourOf(contacts.blocks[n]));
  add({&contacts.shared, 0, static_cast<std::uint32_t>(contacts.shared.AllEnds().size()), 0,
       static_cast<std::uint32_t>(contacts.shared.Overlapping().size())},
      BroadPhase::kColours);
  return overlap;
}

}  // namespace swarmanoid::kinematics2d

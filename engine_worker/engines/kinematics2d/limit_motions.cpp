// Problem: the visits of the contact solver may end before a dense crowd is at peace. No two outlines may overlap
// deeper than allowed afterwards, or than they did before.
//
// Method: the solver only says where bodies want to go. How far they get is decided from where they were when the
// substep began. Bodies that overlap at the end of their ways are involved, and with them all that they approach. Each
// pair of near parts of an involved body gets a plane (separating_planes.cpp), and the motions are raised from 0 as far
// as all planes allow (motion_limiter.h). Other bodies are not limited.
//
// Invariants: no push leads further than `reach` from the start, so that the near pairs of the substep are all that can
// meet. Two bodies that were not pushed do not overlap, else the solver would have pushed them. The set of involved
// bodies grows until nothing is added, so that threads, regions and order change no bit. Two bodies that were put into
// each other have one plane, with the direction in which the solver parts them: they do not approach along it.
// Source: docs/engines.md, "Crowds: how".
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

#include "common/math/lanes.h"
#include "engine_worker/engines/kinematics2d/plane_step.h"
#include "engine_worker/engines/kinematics2d/separating_planes.h"
#include "engine_worker/engines/kinematics2d/step_constants.h"

namespace swarmanoid::kinematics2d
{
namespace
{

// Pairs that can meet, put to the exact test a batch at a time. All stand where the caller placed them.
struct PlacedPairs
{
  PairBatch batch;
  std::array<Pair, kDoubleLanes> pairs;
  std::array<Placed, kDoubleLanes> first, second;
  std::array<double, kDoubleLanes> margins;

  bool Takes(const Placed& a, const Placed& b) const { return !batch.IsFull() && batch.Takes(a, b); }
  void Add(const Pair& pair, const Placed& a, const Placed& b, double margin)
  {
    const std::size_t lane = batch.Count();
    pairs[lane] = pair;
    first[lane] = a;
    second[lane] = b;
    margins[lane] = margin;
    batch.Add(first[lane], second[lane]);
  }
};

// Several threads may do so for one leader. Sets `more` if it was not involved.
void Involve(PlaneState& plane, std::uint32_t leader, std::atomic<bool>& more)
{
  if (plane.bodies.IsStatic(leader) || plane.groups.mobility[leader] <= 0) return;
  const std::atomic_ref<std::uint8_t> involved(plane.limits.is_involved[leader]);
  if (involved.load(std::memory_order_relaxed) != 0) return;
  involved.store(1, std::memory_order_relaxed);
  more.store(true, std::memory_order_relaxed);
}

bool IsInvolved(PlaneState& plane, std::uint32_t leader)
{
  return std::atomic_ref<std::uint8_t>(plane.limits.is_involved[leader]).load(std::memory_order_relaxed) != 0;
}

// Shortens the way of a leader to `most` (m).
void LimitWay(Bodies& bodies, std::uint32_t leader, double most)
{
  const PoseStore& before = bodies.before;
  PoseStore& now = bodies.now;
  const double dx = now.x[leader] - before.x[leader];
  const double dy = now.y[leader] - before.y[leader];
  const double squared = dx * dx + dy * dy;
  if (squared <= most * most) return;
  const double part = most / std::sqrt(squared);
  now.x[leader] = before.x[leader] + part * dx;
  now.y[leader] = before.y[leader] + part * dy;
}

// Returns the way (m) of a member about its prey.
double ArcOf(const PlaneState& plane, const Grip& grip, double seconds)
{
  return std::fabs(plane.TurnOf(grip.prey, seconds)) * grip.Arm();
}

// Returns whether the circles around two bodies overlap where they are now.
bool CirclesMeet(const Bodies& bodies, const Pair& pair)
{
  const double dx = bodies.now.x[pair.first] - bodies.now.x[pair.second];
  const double dy = bodies.now.y[pair.first] - bodies.now.y[pair.second];
  const double limit = bodies.RadiusOf(pair.first) + bodies.RadiusOf(pair.second);
  return dx * dx + dy * dy <= limit * limit;
}

// Involves the leaders of pairs that overlap now.
void FindOverlapsOf(PlaneState& plane, std::span<const Pair> pairs, std::atomic<bool>& more)
{
  const Bodies& bodies = plane.bodies;
  const Groups& groups = plane.groups;
  const double allowed = plane.lengths.allowed;
  PlacedPairs near;
  const auto look = [&]
  {
    if (near.batch.Count() == 0) return;
    near.batch.FindTouches(-allowed);
    for (std::size_t lane = 0; lane < near.batch.Count(); ++lane)
    {
      if (near.batch.Deepest(lane) <= allowed) continue;
      Involve(plane, groups.LeaderOf(near.pairs[lane].first), more);
      Involve(plane, groups.LeaderOf(near.pairs[lane].second), more);
    }
    near.batch.Clear();
  };
  for (const Pair& pair : pairs)
  {
    const std::uint32_t i = groups.LeaderOf(pair.first);
    const std::uint32_t j = groups.LeaderOf(pair.second);
    if (!plane.contacts.solver.IsPushed(i) && !plane.contacts.solver.IsPushed(j)) continue;
    const bool fixed = bodies.IsStatic(pair.second);
    if (i == j || (!fixed && !CirclesMeet(bodies, pair))) continue;
    const Placed first = bodies.PlacedNow(pair.first);
    const Placed second = fixed ? bodies.placed[pair.second] : bodies.PlacedNow(pair.second);
    if (!near.Takes(first, second)) look();
    near.Add(pair, first, second, 0);
  }
  look();
}

// Returns whether the circles around two bodies can come to overlap, each on a part of its way.
bool CanMeet(const PlaneState& plane, const Pair& pair)
{
  const auto [a, b] = pair;
  const PoseStore& before = plane.bodies.before;
  const PoseStore& now = plane.bodies.now;
  const double dx = before.x[a] - before.x[b];
  const double dy = before.y[a] - before.y[b];
  const double squared = dx * dx + dy * dy;
  const double radii = plane.bodies.RadiusOf(a) + plane.bodies.RadiusOf(b);
  const double far = radii + plane.limits.way[a] + plane.limits.way[b];
  if (squared >= far * far) return false;
  // A body that is led by another one goes no straight way.
  if (squared <= radii * radii || plane.groups.leader[a] != a || plane.groups.leader[b] != b) return true;
  const double distance = std::sqrt(squared);
  const double nearer_a = dx * (before.x[a] - now.x[a]) + dy * (before.y[a] - now.y[a]);
  const double nearer_b = dx * (now.x[b] - before.x[b]) + dy * (now.y[b] - before.y[b]);
  return std::max(nearer_a, 0.0) + std::max(nearer_b, 0.0) > (distance - radii) * distance;
}

// No point of the body's outline gets further than this (m) from where it was.
double OutlineWay(const PlaneState& plane, std::uint32_t body, double seconds)
{
  const Bodies& bodies = plane.bodies;
  return plane.limits.way[body] + bodies.RadiusOf(body) * (std::fabs(plane.TurnOf(plane.groups.leader[body], seconds)) +
                                                           std::fabs(bodies.turret_way[body]));
}

MovingPart MovingPartOf(const PlaneState& plane, std::uint32_t body, const Placed& start, std::size_t part,
                        double seconds)
{
  MovingPart side = PartAt(start, part);
  const Bodies& bodies = plane.bodies;
  const Groups& groups = plane.groups;
  if (bodies.IsStatic(body) || groups.mobility[groups.leader[body]] <= 0) return side;
  const std::uint32_t leader = side.leader = groups.leader[body];
  side.can_move = true;
  side.way_x = bodies.now.x[leader] - bodies.before.x[leader];
  side.way_y = bodies.now.y[leader] - bodies.before.y[leader];
  side.from_x = start.x - bodies.before.x[leader];
  side.from_y = start.y - bodies.before.y[leader];
  side.turn = plane.TurnOf(leader, seconds) + (start.model->on_turret[part] ? bodies.turret_way[body] : 0);
  side.centre_way_x = -side.turn * (side.centre_y - bodies.before.y[leader]);
  side.centre_way_y = side.turn * (side.centre_x - bodies.before.x[leader]);
  return side;
}

// Adds a plane for each two near parts of all pairs of the batch, and empties it.
void AddPlanes(PlaneState& plane, PlacedPairs& near, double seconds, LimitList& limits, std::atomic<bool>& more)
{
  if (near.batch.Count() == 0) return;
  near.batch.FindAllTouches(near.margins);
  const auto limit = [&](double gap, const SeparatingPlane& between)
  {
    if (!limits.Add(gap, between.approaches)) return;
    for (const Approach& approach : between.approaches)
      if (approach.rate > 0) Involve(plane, LeaderOfMotion(approach.motion), more);
  };
  const auto add = [&](std::size_t lane, const Touch& touch)
  {
    const Pair& pair = near.pairs[lane];
    const MovingPart first = MovingPartOf(plane, pair.first, near.first[lane], touch.first_part, seconds);
    const MovingPart second = MovingPartOf(plane, pair.second, near.second[lane], touch.second_part, seconds);
    const SeparatingPlane between = PlaneBetween(first, second, touch, plane.lengths.allowed);
    limit(std::max(between.gap, 0.0), between);
  };
  // Two bodies that were put into each other do not approach against the direction in which they are parted.
  const auto add_whole = [&](std::size_t lane)
  {
    const Pair& pair = near.pairs[lane];
    const Vector2 apart = PartingDirection(plane.bodies.placed[pair.first], plane.bodies.placed[pair.second]);
    const MovingPart first = MovingPartOf(plane, pair.first, near.first[lane], 0, seconds);
    const MovingPart second = MovingPartOf(plane, pair.second, near.second[lane], 0, seconds);
    limit(0, PlaneAlong(first, second, apart.x(), apart.y(), plane.lengths.allowed));
  };
  std::array<bool, kDoubleLanes> are_parted_as_wholes{};
  for (std::size_t lane = 0; lane < near.batch.Count(); ++lane)
  {
    are_parted_as_wholes[lane] = near.batch.Deepest(lane) > kPutIntoEachOther * plane.lengths.allowed;
    if (are_parted_as_wholes[lane]) add_whole(lane);
  }
  near.batch.ForEachTouch(
      [&](std::size_t lane, const Touch& touch)
      {
        if (!are_parted_as_wholes[lane]) add(lane, touch);
      });
  near.batch.Clear();
}

// Adds planes for those pairs that have an involved leader; the others stay open. At first all pairs are open.
void AddLimitsOf(PlaneState& plane, std::span<const Pair> pairs, bool is_first, double seconds, Limits::Part& part,
                 std::atomic<bool>& more)
{
  const Bodies& bodies = plane.bodies;
  const Groups& groups = plane.groups;
  PlacedPairs near;
  const auto limit = [&](const Pair& pair)
  {
    const auto [a, b] = pair;
    const bool fixed = bodies.IsStatic(b);
    if (groups.LeaderOf(a) == groups.LeaderOf(b) || (!fixed && !CanMeet(plane, pair))) return;
    const double margin = OutlineWay(plane, a, seconds) + (fixed ? 0 : OutlineWay(plane, b, seconds));
    if (margin <= 0) return;
    const Placed one = bodies.PlacedBefore(a);
    const Placed other = fixed ? bodies.placed[b] : bodies.PlacedBefore(b);
    if (!near.Takes(one, other)) AddPlanes(plane, near, seconds, part.limits, more);
    near.Add(pair, one, other, margin);
  };
  std::vector<std::uint32_t>& open = part.open;
  if (is_first) open.resize(pairs.size());
  std::size_t left = 0;
  for (std::size_t n = 0; n < open.size(); ++n)
  {
    const std::uint32_t number = is_first ? static_cast<std::uint32_t>(n) : open[n];
    const Pair& pair = pairs[number];
    if (IsInvolved(plane, groups.LeaderOf(pair.first)) || IsInvolved(plane, groups.LeaderOf(pair.second)))
      limit(pair);
    else
      open[left++] = number;
  }
  open.resize(left);
  AddPlanes(plane, near, seconds, part.limits, more);
}

// A leader does its parts of its way and of its turn; its group goes with it.
void MoveInPart(PlaneState& plane, std::uint32_t leader, double seconds)
{
  Bodies& bodies = plane.bodies;
  const double way = plane.limits.limiter.PartOf(WayMotion(leader));
  const double turn = plane.limits.limiter.PartOf(TurnMotion(leader));
  Pose2 pose = bodies.now.Get(leader);
  if (way < 1)
  {
    pose.x = bodies.before.x[leader] + way * (pose.x - bodies.before.x[leader]);
    pose.y = bodies.before.y[leader] + way * (pose.y - bodies.before.y[leader]);
  }
  if (turn < 1)
  {
    pose.heading = Advanced(bodies.before.Get(leader), {0, 0, turn * plane.TurnOf(leader, seconds)}, 1).heading;
    const double turret_way = bodies.turret_way[leader];
    if (turret_way != 0) bodies.SetTurretAngle(leader, bodies.TurretOf(leader).before + turn * turret_way);
  }
  bodies.now.Set(leader, pose);
  for (const Grip& grip : plane.groups.GripsOf(leader)) bodies.now.Set(grip.body, Compose(pose, grip.relative));
}

}  // namespace

void LimitPushes(PlaneState& plane, double seconds)
{
  Bodies& bodies = plane.bodies;
  const ContactSolver& solver = plane.contacts.solver;
  const double reach = plane.lengths.reach;
  solver.ForEachPushed(plane.Pool(),
                       [&](std::uint32_t leader)
                       {
                         if (!bodies.IsStatic(leader)) LimitWay(bodies, leader, reach);
                       });
  // The way of a member is that of its prey and the arc about it. Together they stay within the reach, too.
  plane.groups.ForEach(
      [&](std::span<const Grip> members)
      {
        double longest = 0;
        for (const Grip& grip : members) longest = std::max(longest, ArcOf(plane, grip, seconds));
        const std::uint32_t prey = members.front().prey;
        if (solver.IsPushed(prey)) LimitWay(bodies, prey, std::max(reach - longest, 0.0));
        for (const Grip& grip : members) bodies.now.Set(grip.body, Compose(bodies.now.Get(prey), grip.relative));
      });
}

bool FindOverlaps(PlaneState& plane)
{
  std::ranges::fill(plane.limits.is_involved, std::uint8_t{0});
  std::atomic<bool> more = false;
  plane.ForEachPart([&](unsigned k) { FindOverlapsOf(plane, plane.contacts.parts[k].pairs.pairs, more); });
  FindOverlapsOf(plane, plane.contacts.PairsOfLarge().pairs, more);
  return more;
}

void BeginLimits(PlaneState& plane, double seconds)
{
  const PoseStore& now = plane.bodies.now;
  const PoseStore& before = plane.bodies.before;
  std::vector<double>& way = plane.limits.way;
  InParts(plane.Pool(), PaddedCount(plane.bodies.count), kPadding,
          [&](unsigned, std::size_t begin, std::size_t end)
          {
            for (std::size_t k = begin; k < end; k += kDoubleLanes)
            {
              const DoubleLanes dx = LoadLanes(&now.x[k]) - LoadLanes(&before.x[k]);
              const DoubleLanes dy = LoadLanes(&now.y[k]) - LoadLanes(&before.y[k]);
              StoreLanes(SquareRoot(dx * dx + dy * dy), &way[k]);
            }
          });
  for (const Grip& grip : plane.groups.grips) way[grip.body] = way[grip.prey] + ArcOf(plane, grip, seconds);
  for (Limits::Part& part : plane.limits.parts) part.limits.Clear();
}

bool AddLimits(PlaneState& plane, double seconds, bool is_first)
{
  std::atomic<bool> more = false;
  const auto add = [&](unsigned k)
  { AddLimitsOf(plane, plane.contacts.parts[k].pairs.pairs, is_first, seconds, plane.limits.parts[k], more); };
  plane.ForEachPart(add);
  add(plane.PartCount());
  return more;
}

void LimitMotions(PlaneState& plane, double seconds, const LimitList* of_others)
{
  MotionLimiter& limiter = plane.limits.limiter;
  for (const Limits::Part& part : plane.limits.parts) limiter.Add(part.limits);
  if (of_others != nullptr) limiter.Add(*of_others);
  limiter.Raise();
  for (const std::uint32_t leader : limiter.Limited())
    if (!plane.bodies.IsStatic(leader)) MoveInPart(plane, leader, seconds);
  plane.statistics.held_back += limiter.Limited().size();
}

}  // namespace swarmanoid::kinematics2d

// KinematicWorld::LimitMotions: nobody goes or turns so far that outlines overlap. How is told in motion_limiter.h.
#include <algorithm>
#include <atomic>
#include <cmath>

#include "common/math/elementary.h"
#include "common/math/lanes.h"
#include "engine_worker/engines/kinematics2d/kinematic_limits.h"
#include "engine_worker/engines/kinematics2d/kinematic_region.h"
#include "engine_worker/engines/kinematics2d/kinematic_world.h"

namespace swarmanoid::kinematics2d
{

// The solver's visits may end before a dense crowd is at peace. So it only says where the bodies would go; how far they
// get is decided from where they were. Those that overlap at the end of their ways are limited, and with them all who
// count on their making room; nobody else is.
void KinematicWorld::LimitMotions(double seconds)
{
  LimitPushes();
  LimitPushesOfGroups(seconds);
  std::fill(is_involved_.begin(), is_involved_.end(), std::uint8_t{0});
  std::atomic<bool> more = false;
  ForEachPart([&](Part& part) { FindOverlaps(part.pairs.pairs, more); });
  FindOverlaps(pairs_of_large_.pairs, more);
  if (region_) more = region_->ShareInvolved(*this, more);
  if (!more) return;

  SwapFollowers();
  InParts(Pool(), PaddedCount(count_), kPadding,
          [&](unsigned, std::size_t begin, std::size_t end) { FindWays(begin, end); });
  for (const Grip& grip : grips_) way_[grip.body] = way_[grip.prey] + ArcOf(grip, seconds);
  for (Part& part : parts_) part.limits.Clear();
  limits_of_large_.Clear();
  for (bool first = true; more; first = false)
  {
    more = false;
    ForEachPart([&](Part& part) { FindLimits(part.pairs.pairs, first, part.open, seconds, part.limits, more); });
    FindLimits(pairs_of_large_.pairs, first, open_of_large_, seconds, limits_of_large_, more);
    if (region_ && !more) more = region_->ShareInvolved(*this, false);
  }
  for (const Part& part : parts_) limiter_.Add(part.limits);
  limiter_.Add(limits_of_large_);
  if (region_) limiter_.Add(region_->ShareLimits(*this));
  limiter_.Raise();
  for (const std::uint32_t leader : limiter_.Limited())
    if (leader < count_) MoveInPart(leader, seconds);
  statistics_.held_back += limiter_.Limited().size();
}

// Several threads may do so for one leader.
void KinematicWorld::Involve(std::uint32_t leader, std::atomic<bool>& more)
{
  if (leader >= count_ || mobility_[leader] <= 0) return;
  const std::atomic_ref<std::uint8_t> involved(is_involved_[leader]);
  if (involved.load(std::memory_order_relaxed) != 0) return;
  involved.store(1, std::memory_order_relaxed);
  more.store(true, std::memory_order_relaxed);
}

bool KinematicWorld::IsInvolved(std::uint32_t leader)
{
  return std::atomic_ref<std::uint8_t>(is_involved_[leader]).load(std::memory_order_relaxed) != 0;
}

// Nobody is pushed further than `reach_` from where it was: only then those that it can meet are known.
void KinematicWorld::LimitPushes()
{
  solver_.ForEachPushed(Pool(),
                        [this](std::uint32_t leader)
                        {
                          if (leader < count_) LimitWay(leader, reach_);
                        });
}

void KinematicWorld::LimitWay(std::uint32_t leader, double most)
{
  const double dx = now_.x[leader] - before_.x[leader];
  const double dy = now_.y[leader] - before_.y[leader];
  const double squared = dx * dx + dy * dy;
  if (squared <= most * most) return;
  const double part = most / std::sqrt(squared);
  now_.x[leader] = before_.x[leader] + part * dx;
  now_.y[leader] = before_.y[leader] + part * dy;
}

// By which a member goes about its prey.
double KinematicWorld::ArcOf(const Grip& grip, double seconds) const
{
  return std::fabs(TurnOf(grip.prey, seconds)) *
         std::sqrt(grip.relative.x * grip.relative.x + grip.relative.y * grip.relative.y);
}

// A member's way is that of its prey and the arc about it; together they stay within reach_, too.
void KinematicWorld::LimitPushesOfGroups(double seconds)
{
  for (std::size_t g = 0; g + 1 < group_start_.size(); ++g)
  {
    const std::span<const Grip> members(&grips_[group_start_[g]], group_start_[g + 1] - group_start_[g]);
    double longest = 0;
    for (const Grip& grip : members) longest = std::max(longest, ArcOf(grip, seconds));
    const std::uint32_t prey = members.front().prey;
    if (solver_.IsPushed(prey)) LimitWay(prey, std::max(reach_ - longest, 0.0));
    for (const Grip& grip : members) now_.Set(grip.body, Compose(now_.Get(prey), grip.relative));
  }
}

void KinematicWorld::FindWays(std::size_t begin, std::size_t end)
{
  for (std::size_t k = begin; k < end; k += kDoubleLanes)
  {
    const DoubleLanes dx = LoadLanes(&now_.x[k]) - LoadLanes(&before_.x[k]);
    const DoubleLanes dy = LoadLanes(&now_.y[k]) - LoadLanes(&before_.y[k]);
    StoreLanes(SquareRoot(dx * dx + dy * dy), &way_[k]);
  }
}

// Two that nobody pushed do not overlap: else the solver would have.
void KinematicWorld::FindOverlaps(std::span<const Pair> pairs, std::atomic<bool>& more)
{
  NearPairs near;
  const auto look = [&]
  {
    if (near.batch.Count() == 0) return;
    near.batch.FindTouches(-allowed_);
    for (std::size_t lane = 0; lane < near.batch.Count(); ++lane)
    {
      if (near.batch.Deepest(lane) <= allowed_) continue;
      Involve(LeaderOf(near.pairs[lane].first), more);
      Involve(LeaderOf(near.pairs[lane].second), more);
    }
    near.batch.Clear();
  };
  for (const Pair& pair : pairs)
  {
    const auto [a, b] = pair;
    const std::uint32_t i = LeaderOf(a);
    const std::uint32_t j = LeaderOf(b);
    if (!solver_.IsPushed(i) && !solver_.IsPushed(j)) continue;
    if (i == j || (b < count_ && !CirclesMeet(a, b))) continue;
    const Placed first = PlaceAt(a, now_);
    const Placed second = b < count_ ? PlaceAt(b, now_) : placed_[b];
    if (near.batch.IsFull() || !near.batch.Takes(first, second)) look();
    near.Add(pair, first, second);
  }
  look();
}

bool KinematicWorld::CirclesMeet(std::uint32_t a, std::uint32_t b) const
{
  const double dx = now_.x[a] - now_.x[b];
  const double dy = now_.y[a] - now_.y[b];
  const double limit = RadiusOf(a) + RadiusOf(b);
  return dx * dx + dy * dy <= limit * limit;
}

// Of those of `open`, numbers of pairs, that have a leader that is involved; the others stay in it. At first all are.
void KinematicWorld::FindLimits(std::span<const Pair> pairs, bool first, std::vector<std::uint32_t>& open,
                                double seconds, LimitList& limits, std::atomic<bool>& more)
{
  NearPairs near;
  const auto limit = [&](const Pair& pair)
  {
    const auto [a, b] = pair;
    const bool fixed = b >= count_;
    if (LeaderOf(a) == LeaderOf(b) || (!fixed && !CanMeet(a, b))) return;
    const double margin = OutlineWay(a, seconds) + (fixed ? 0 : OutlineWay(b, seconds));
    if (margin <= 0) return;
    const Placed one = PlaceBefore(a);
    const Placed other = fixed ? placed_[b] : PlaceBefore(b);
    if (near.batch.IsFull() || !near.batch.Takes(one, other)) AddLimits(near, seconds, limits, more);
    near.margins[near.batch.Count()] = margin;
    near.Add(pair, one, other);
  };
  if (first) open.resize(pairs.size());
  std::size_t left = 0;
  for (std::size_t n = 0; n < open.size(); ++n)
  {
    const std::uint32_t number = first ? static_cast<std::uint32_t>(n) : open[n];
    const Pair& pair = pairs[number];
    if (IsInvolved(LeaderOf(pair.first)) || IsInvolved(LeaderOf(pair.second)))
      limit(pair);
    else
      open[left++] = number;
  }
  open.resize(left);
  AddLimits(near, seconds, limits, more);
}

// Whether the circles around two bodies can come to overlap, each on a part of its way.
bool KinematicWorld::CanMeet(std::uint32_t a, std::uint32_t b) const
{
  const double dx = before_.x[a] - before_.x[b];
  const double dy = before_.y[a] - before_.y[b];
  const double squared = dx * dx + dy * dy;
  const double radii = RadiusOf(a) + RadiusOf(b);
  const double far = radii + way_[a] + way_[b];
  if (squared >= far * far) return false;
  // What is led by another body goes no straight way.
  if (squared <= radii * radii || leader_[a] != a || leader_[b] != b) return true;
  const double distance = std::sqrt(squared);
  const double nearer_a = dx * (before_.x[a] - now_.x[a]) + dy * (before_.y[a] - now_.y[a]);
  const double nearer_b = dx * (now_.x[b] - before_.x[b]) + dy * (now_.y[b] - before_.y[b]);
  return std::max(nearer_a, 0.0) + std::max(nearer_b, 0.0) > (distance - radii) * distance;
}

// No point of the body's outline gets further than this (metres) from where it was.
double KinematicWorld::OutlineWay(std::uint32_t body, double seconds) const
{
  return way_[body] + RadiusOf(body) * (std::fabs(TurnOf(leader_[body], seconds)) + std::fabs(turret_way_[body]));
}

// One plane for each near pair of parts. For all pairs of the batch, which is empty then.
void KinematicWorld::AddLimits(NearPairs& near, double seconds, LimitList& limits, std::atomic<bool>& more)
{
  if (near.batch.Count() == 0) return;
  near.batch.FindAllTouches(near.margins);
  near.batch.ForEachTouch(
      [&](std::size_t lane, const Touch& touch)
      {
        const Side first = SideOf(near.pairs[lane].first, near.first[lane], touch.first_part, seconds);
        const Side second = SideOf(near.pairs[lane].second, near.second[lane], touch.second_part, seconds);
        // From the second part to the first one.
        double x = touch.x;
        double y = touch.y;
        if (!touch.face)
        {
          x += first.x - second.x;
          y += first.y - second.y;
          // Two centres at one place: they part as they like.
          if (x == 0 && y == 0)
          {
            x = first.way_x - second.way_x;
            y = first.way_y - second.way_y;
          }
        }
        Plane plane = PlaneAlong(first, second, x, y);
        if (plane.left < 0) plane = BestPlane(first, second, x, y, plane);
        if (!limits.Add(std::max(plane.gap, 0.0), plane.approaches)) return;
        for (const Approach& approach : plane.approaches)
          if (approach.rate > 0) Involve(LeaderOfMotion(approach.motion), more);
      });
  near.batch.Clear();
}

// Any direction along which the parts are apart will do. Those that pass each other are best kept apart along that in
// which they are nearest on their way, or along the normal of a face.
KinematicWorld::Plane KinematicWorld::BestPlane(const Side& first, const Side& second, double x, double y,
                                                const Plane& shortest) const
{
  Plane best = shortest;
  const auto consider = [&](double to_x, double to_y)
  {
    const Plane plane = PlaneAlong(first, second, to_x, to_y);
    if (plane.gap >= 0 && plane.left > best.left) best = plane;
  };
  const double way_x = first.way_x + first.centre_way_x - second.way_x - second.centre_way_x;
  const double way_y = first.way_y + first.centre_way_y - second.way_y - second.centre_way_y;
  const double squared = way_x * way_x + way_y * way_y;
  const auto consider_nearest = [&](double from_x, double from_y)
  {
    const double at = squared > 0 ? std::clamp(-(from_x * way_x + from_y * way_y) / squared, 0.0, 1.0) : 0;
    consider(from_x + at * way_x, from_y + at * way_y);
  };
  const Polygon* const polygons[] = {first.OwnPolygon(), second.OwnPolygon()};
  if (polygons[0] == nullptr && polygons[1] == nullptr) consider_nearest(x, y);
  for (int k = 0; k < 2; ++k)
  {
    if (polygons[k] == nullptr) continue;
    const Polygon& polygon = *polygons[k];
    const Side& side = k == 0 ? first : second;
    const Side& other = k == 0 ? second : first;
    const double sign = k == 0 ? -1 : 1;
    for (int n = 0; n < polygon.count; ++n)
    {
      consider(sign * (side.cos * polygon.nx[n] - side.sin * polygon.ny[n]),
               sign * (side.sin * polygon.nx[n] + side.cos * polygon.ny[n]));
      if (other.OwnPolygon() != nullptr) continue;
      // From the corner to the middle of the circle, or back.
      const double corner_x = side.x + side.cos * polygon.x[n] - side.sin * polygon.y[n];
      const double corner_y = side.y + side.sin * polygon.x[n] + side.cos * polygon.y[n];
      consider_nearest(sign * (other.centre_x - corner_x), sign * (other.centre_y - corner_y));
    }
  }
  return best;
}

KinematicWorld::Side KinematicWorld::SideOf(std::uint32_t body, const Placed& start, std::size_t part,
                                            double seconds) const
{
  const CollisionModel& model = *start.model;
  Side side{.start = &start, .part = part, .x = start.x, .y = start.y};
  side.cos = start.cos;
  side.sin = start.sin;
  if (model.on_turret[part])
  {
    side.cos = start.cos * start.turret_cos - start.sin * start.turret_sin;
    side.sin = start.sin * start.turret_cos + start.cos * start.turret_sin;
  }
  side.centre_x = side.x + side.cos * model.part_x[part] - side.sin * model.part_y[part];
  side.centre_y = side.y + side.sin * model.part_x[part] + side.cos * model.part_y[part];
  if (body >= count_ || mobility_[leader_[body]] <= 0) return side;
  const std::uint32_t leader = side.leader = leader_[body];
  side.can_move = true;
  side.way_x = now_.x[leader] - before_.x[leader];
  side.way_y = now_.y[leader] - before_.y[leader];
  side.from_x = start.x - before_.x[leader];
  side.from_y = start.y - before_.y[leader];
  side.turn = TurnOf(leader, seconds) + (model.on_turret[part] ? turret_way_[body] : 0);
  side.centre_way_x = -side.turn * (side.centre_y - before_.y[leader]);
  side.centre_way_y = side.turn * (side.centre_x - before_.x[leader]);
  return side;
}

// (x, y) may have any length.
KinematicWorld::Plane KinematicWorld::PlaneAlong(const Side& first, const Side& second, double x, double y) const
{
  const double length = std::sqrt(x * x + y * y);
  x = length > 0 ? x / length : 1;
  y = length > 0 ? y / length : 0;
  const Extent a = ExtentAlong(first, -x, -y);
  const Extent b = ExtentAlong(second, x, y);
  Plane plane{(first.x - second.x) * x + (first.y - second.y) * y - a.at_start - b.at_start + allowed_, 0, {}};
  if (first.can_move)
  {
    plane.approaches[0] = {WayMotion(first.leader), -first.way_x * x - first.way_y * y};
    plane.approaches[1] = {TurnMotion(first.leader), a.turn_rate};
  }
  if (second.can_move)
  {
    plane.approaches[2] = {WayMotion(second.leader), second.way_x * x + second.way_y * y};
    plane.approaches[3] = {TurnMotion(second.leader), b.turn_rate};
  }
  plane.left = plane.gap;
  for (const Approach& approach : plane.approaches) plane.left -= approach.rate;
  return plane;
}

// How far a part reaches along (x, y) from its body, and how much further, at most, for each part of its turn that is
// made. A point p from the axis comes s * turn * (its arm) further by a part s of the turn, and less if it stays on
// this side of the axis, else by up to (s * turn)^2 |p| / 2 more; s^2 <= s. For corners the furthest of them is convex
// in s, so that it lies below the line to what it is at s = 1.
KinematicWorld::Extent KinematicWorld::ExtentAlong(const Side& side, double x, double y)
{
  const CollisionModel& model = *side.start->model;
  double at_start = -1e300;
  double at_end = -1e300;
  const auto consider = [&](double local_x, double local_y)
  {
    const double own_x = side.cos * local_x - side.sin * local_y;
    const double own_y = side.sin * local_x + side.cos * local_y;
    const double px = side.from_x + own_x;
    const double py = side.from_y + own_y;
    const double along = own_x * x + own_y * y;
    const double bend = 0.5 * side.turn * side.turn;
    const double further = side.turn * (px * y - py * x);
    const double axial = px * x + py * y;
    const bool stays = bend < 1 && axial > 0 && axial + further - bend * axial > 0;
    at_start = std::max(at_start, along);
    at_end = std::max(at_end, along + further + (stays ? 0 : bend * std::sqrt(px * px + py * py)));
  };
  const auto circles = static_cast<std::size_t>(model.circles);
  if (side.part < circles)
  {
    consider(model.part_x[side.part], model.part_y[side.part]);
    return {at_start + model.part_radius[side.part], at_end - at_start};
  }
  const Polygon& polygon = model.polygons[side.part - circles];
  for (int k = 0; k < polygon.count; ++k) consider(polygon.x[k], polygon.y[k]);
  return {at_start, at_end - at_start};
}

void KinematicWorld::MoveInPart(std::uint32_t leader, double seconds)
{
  const double way = limiter_.PartOf(WayMotion(leader));
  const double turn = limiter_.PartOf(TurnMotion(leader));
  Pose2 pose = now_.Get(leader);
  if (way < 1)
  {
    pose.x = before_.x[leader] + way * (pose.x - before_.x[leader]);
    pose.y = before_.y[leader] + way * (pose.y - before_.y[leader]);
  }
  if (turn < 1)
  {
    pose.heading = Advanced(before_.Get(leader), {0, 0, turn * TurnOf(leader, seconds)}, 1).heading;
    if (turret_way_[leader] != 0) SetTurretAngle(leader, FindTurret(leader)->before + turn * turret_way_[leader]);
  }
  now_.Set(leader, pose);
  for (const Grip& grip : GroupOf(leader)) now_.Set(grip.body, Compose(pose, grip.relative));
}

}  // namespace swarmanoid::kinematics2d

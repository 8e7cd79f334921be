// Problem: find the bodies that can touch no other body within a tick.
//
// Method: each body has an outline of circles or one circle, and a largest way. Candidates come from a grid
// (kinematics2d/broad_phase.h). For each pair, the distance of the outlines minus both ways is compared with the
// margin.
//
// Invariant: the result follows from the outlines and ways alone. Two thresholds (margin and margin + kBand) let the
// caller apply hysteresis, so that few bodies change sides.
#include "engine_worker/engines/rigid_bodies/separation_test.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace swarmanoid
{
namespace
{

constexpr double kMargin = 0.05;  // m, at least what Find is asked for

double GapBetween(const MovingCircle& a, const MovingCircle& b)
{
  const double x = b.x - a.x;
  const double y = b.y - a.y;
  return std::sqrt(x * x + y * y) - a.radius - b.radius - a.way - b.way;
}

}  // namespace

double DistanceTo(std::span<const Vector2> polygon, const Vector2& point)
{
  double inside = -std::numeric_limits<double>::infinity();
  double outside = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < polygon.size(); ++i)
  {
    const Vector2& a = polygon[i];
    const Vector2 edge = polygon[(i + 1) % polygon.size()] - a;
    const Vector2 offset = point - a;
    const double along = std::clamp(offset.dot(edge) / edge.squaredNorm(), 0.0, 1.0);
    outside = std::min(outside, std::sqrt((offset - along * edge).squaredNorm()));
    inside = std::max(inside, (offset.x() * edge.y() - offset.y() * edge.x()) / std::sqrt(edge.squaredNorm()));
  }
  return inside <= 0 ? inside : outside;
}

double DistanceTo(const StaticOutline& outline, const Vector2& point)
{
  if (outline.radius <= 0) return DistanceTo(std::span(outline.corners), point);
  return std::sqrt((point - outline.corners.front()).squaredNorm()) - outline.radius;
}

void SeparationTest::Configure(std::span<const MovingOutline> bodies, std::vector<StaticOutline> statics,
                               double longest_way)
{
  statics_ = std::move(statics);
  largest_margin_ = 2 * longest_way + kMargin + kBand;
  kinematics2d::Bounds area{1e9, 1e9, -1e9, -1e9};
  radii_.clear();
  for (const MovingOutline& body : bodies)
  {
    area.Include(body.whole.x, body.whole.y, body.whole.radius);
    radii_.push_back(body.whole.radius);
  }
  std::vector<kinematics2d::Bounds> boxes;
  for (const StaticOutline& outline : statics_)
  {
    kinematics2d::Bounds& box = boxes.emplace_back(kinematics2d::Bounds{1e9, 1e9, -1e9, -1e9});
    for (const Vector2& corner : outline.corners) box.Include(corner.x(), corner.y(), outline.radius);
  }
  broad_phase_.Configure(
      kinematics2d::PlaneGrid::For(bodies.empty() ? kinematics2d::Bounds{} : area, radii_, largest_margin_), radii_);
  broad_phase_.SetStatics(boxes);
  const std::size_t padded = kinematics2d::PaddedCount(bodies.size());
  places_.x.assign(padded, 0);
  places_.y.assign(padded, 0);
  present_.assign(padded, 1);
}

template <class Act>
bool SeparationTest::ForEachPair(std::span<const MovingOutline> bodies, double limit, const Act& act)
{
  double longest = 0;
  for (const MovingOutline& body : bodies)
    if (body.present) longest = std::max(longest, body.whole.way);
  const double reach = 2 * longest + limit;
  // The condition is also true for NaN.
  if (!(reach <= largest_margin_)) return false;

  for (std::size_t k = 0; k < bodies.size(); ++k)
  {
    places_.x[k] = bodies[k].whole.x;
    places_.y[k] = bodies[k].whole.y;
    present_[k] = bodies[k].present ? 1 : 0;
  }
  const auto gap_of = [&](const kinematics2d::Pair& pair)
  {
    const MovingOutline& a = bodies[pair.first];
    double gap = std::numeric_limits<double>::infinity();
    if (pair.second >= bodies.size())
    {
      const StaticOutline& outline = statics_[pair.second - bodies.size()];
      for (const MovingCircle& part : a.Parts())
        gap = std::min(gap, DistanceTo(outline, {part.x, part.y}) - part.radius - part.way);
      return gap;
    }
    for (const MovingCircle& part : a.Parts())
      for (const MovingCircle& other : bodies[pair.second].Parts()) gap = std::min(gap, GapBetween(part, other));
    return gap;
  };
  broad_phase_.Sort(places_, {present_.data(), bodies.size()});
  broad_phase_.FindPairs(reach, broad_phase_.Blocks(), pairs_);
  broad_phase_.FindPairsOfLarge(reach, places_, {present_.data(), bodies.size()}, large_pairs_);
  for (const kinematics2d::Pair& pair : pairs_.pairs) act(pair, gap_of(pair));
  for (const kinematics2d::Pair& pair : large_pairs_) act(pair, gap_of(pair));
  return true;
}

bool SeparationTest::Find(std::span<const MovingOutline> bodies, double margin, std::vector<Nearness>& nearness,
                          std::vector<kinematics2d::Pair>* near_pairs)
{
  if (near_pairs != nullptr) near_pairs->clear();
  nearness.assign(bodies.size(), Nearness::kFar);
  const auto note = [&](std::uint32_t body, double gap)
  {
    if (gap < margin)
      nearness[body] = Nearness::kNear;
    else if (gap < margin + kBand)
      nearness[body] = std::max(nearness[body], Nearness::kClose);
  };
  const auto compare = [&](const kinematics2d::Pair& pair, double gap)
  {
    note(pair.first, gap);
    if (pair.second < bodies.size()) note(pair.second, gap);
    if (near_pairs != nullptr && gap < margin) near_pairs->push_back(pair);
  };
  if (ForEachPair(bodies, margin + kBand, compare)) return true;
  nearness.assign(bodies.size(), Nearness::kNear);
  return false;
}

bool SeparationTest::FindPairs(std::span<const MovingOutline> bodies, double limit, std::vector<GapPair>& pairs)
{
  pairs.clear();
  return ForEachPair(bodies, limit,
                     [&](const kinematics2d::Pair& pair, double gap)
                     {
                       if (gap < limit) pairs.push_back({pair.first, pair.second, gap});
                     });
}

}  // namespace swarmanoid

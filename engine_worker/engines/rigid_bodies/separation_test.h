// SeparationTest finds the bodies that cannot touch any other body within a tick, so that the solver of an engine need
// not see them. It follows from where the bodies are and how far they can get, and from nothing that was before. Used
// by the engines of rigid bodies in the thread that steps them.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "common/math/pose.h"
#include "engine_worker/engines/kinematics2d/broad_phase.h"

namespace swarmanoid
{

// A part of a body that moves, as a circle that contains it. Metres.
struct MovingCircle
{
  double x = 0;
  double y = 0;
  double radius = 0;
  double way = 0;  // that it may go within the tick
};

// A body that moves.
struct MovingOutline
{
  MovingCircle whole;                 // around its origin
  std::array<MovingCircle, 2> parts;  // closer around it
  int part_count = 0;                 // 0: there is nothing closer than `whole`
  bool present = true;                // in the way of others

  std::span<const MovingCircle> Parts() const
  {
    return part_count == 0 ? std::span(&whole, 1) : std::span(parts).first(static_cast<std::size_t>(part_count));
  }
};

// An outline that never moves: a convex polygon in the plane or, with a radius, the circle around its only corner.
struct StaticOutline
{
  std::vector<Vector2> corners;
  double radius = 0;
};

// Two bodies, or a body and a static outline, whose number is counted on from the bodies'; and the gap that remains
// after both have gone their ways (m).
struct GapPair
{
  std::uint32_t first;
  std::uint32_t second;
  double gap;
};

enum class Nearness : std::uint8_t
{
  kFar,    // more than both distances from all others
  kClose,  // between them
  kNear    // less than the smaller one
};

// Distance of a point from a convex polygon, counter-clockwise, or from what never moves; negative inside.
double DistanceTo(std::span<const Vector2> polygon, const Vector2& point);
double DistanceTo(const StaticOutline& outline, const Vector2& point);

class SeparationTest
{
public:
  // Sets the bodies and static outlines. `longest_way` bounds the search: beyond twice this way, no body counts as far.
  void Configure(std::span<const MovingOutline> bodies, std::vector<StaticOutline> statics, double longest_way);
  // Sets the nearness of each body from the smallest gap that remains after both bodies of a pair have gone their ways.
  // It is compared with `margin` and `margin` + kBand. `near_pairs` gets the pairs with a smaller gap than `margin`,
  // numbered as in the broad phase. Returns false if a body is too fast; then all bodies count as near, without pairs.
  bool Find(std::span<const MovingOutline> bodies, double margin, std::vector<Nearness>& nearness,
            std::vector<kinematics2d::Pair>* near_pairs = nullptr);
  // Sets the pairs with a smaller gap than `limit`, in no order that means anything. Returns false if a body is too
  // fast; then there are no pairs.
  bool FindPairs(std::span<const MovingOutline> bodies, double limit, std::vector<GapPair>& pairs);
  std::span<const StaticOutline> Statics() const { return statics_; }

  // A body becomes isolated later than it would cease to be, so that few change sides.
  static constexpr double kBand = 0.02;

private:
  // Calls act(pair, gap) for each pair that may have a smaller gap than `limit`. Returns false if a body is too fast.
  template <class Act>
  bool ForEachPair(std::span<const MovingOutline> bodies, double limit, const Act& act);

  kinematics2d::BroadPhase broad_phase_;
  kinematics2d::PoseStore places_;
  kinematics2d::PairList pairs_;
  std::vector<kinematics2d::Pair> large_pairs_;
  std::vector<std::uint8_t> present_;
  std::vector<double> radii_;  // that the broad phase knows
  std::vector<StaticOutline> statics_;
  double largest_margin_ = 0;
};

}  // namespace swarmanoid

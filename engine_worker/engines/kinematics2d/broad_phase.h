// Which bodies are near each other: a uniform grid filled anew at each step by a counting sort, with float copies of
// the positions in the order of the cells. Used by the kinematic world. Remembers nothing from step to step, so that
// the pairs and their order follow from the positions alone.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/math/cells.h"
#include "common/math/lanes.h"
#include "engine_worker/engines/kinematics2d/motion.h"
#include "engine_worker/engines/kinematics2d/worker_pool.h"

namespace swarmanoid::kinematics2d
{

struct Bounds
{
  double min_x = 0, min_y = 0;
  double max_x = 0, max_y = 0;

  void Include(double x, double y, double radius);
};

// Two bodies, first < second; or a body and a static shape.
struct Pair
{
  std::uint32_t first;
  std::uint32_t second;
};

class BroadPhase
{
public:
  // `radii`: of the circles around the bodies. `largest_margin`: the most that FindPairs will ever be asked for.
  // Bodies may leave `area`; many of them far outside cost time, nothing else.
  void Configure(const Bounds& area, std::span<const double> radii, double largest_margin);
  // The static shapes by their boxes. After Configure.
  void SetStatics(std::span<const Bounds> boxes);

  // `present[k]` is 0 for bodies that are not to be found.
  void FindPairs(const PoseStore& poses, std::span<const std::uint8_t> present, double margin, WorkerPool* pool);
  // Bodies whose circles are less than `margin` apart, in the order of their cells.
  const std::vector<Pair>& Pairs() const { return pairs_; }
  const std::vector<Pair>& StaticPairs() const { return static_pairs_; }

  // Calls `act` with every body that was present and whose circle was less than `reach` from a point when the pairs
  // were found; with some that were further away, too. In the order of their cells.
  template <class Act>
  void ForEachNear(double x, double y, double reach, const Act& act) const
  {
    const std::uint32_t* const start = sort_.Starts();
    const double widest = reach + largest_small_radius_;
    const float cut = static_cast<float>(reach) + 2 * slack_;
    cells_.ForEachRow(x - widest, y - widest, x + widest, y + widest,
                      [&](std::uint32_t first, std::uint32_t last)
                      {
                        const std::uint32_t to = start[last + 1];
                        for (std::uint32_t from = start[first]; from < to; from += kLanes)
                          ForEachBit(Within(static_cast<float>(x), static_cast<float>(y), cut, from, to),
                                     [&](unsigned bit) { act(body_[from + bit]); });
                      });
    for (const std::uint32_t body : large_) act(body);
  }
  // Fetches into the cache what ForEachNear and ForEachStaticNear will look at.
  void PrefetchNear(double x, double y) const
  {
    const std::uint32_t* const start = sort_.Starts();
    const std::uint32_t cell = cells_.CellOf(x, y);
    statics_.Prefetch(cell);
    for (const std::uint32_t row : {cell - cells_.stride, cell, cell + cells_.stride})
    {
      const std::uint32_t first = start[row];
      __builtin_prefetch(&x_[first]);
      __builtin_prefetch(&y_[first]);
      __builtin_prefetch(&r_[first]);
      __builtin_prefetch(&body_[first]);
    }
  }
  // Calls `act` with every static shape that may touch a body at a point.
  template <class Act>
  void ForEachStaticNear(std::uint32_t body, double x, double y, const Act& act) const
  {
    if (is_large_[body] != 0)
    {
      for (std::uint32_t shape = 0; shape < static_boxes_.size(); ++shape) act(shape);
      return;
    }
    for (const std::uint32_t shape : statics_.In(cells_.CellOf(x, y))) act(shape);
  }

private:
  struct FloatBox
  {
    float min_x, min_y, max_x, max_y;
  };

  // Those of the sorted bodies `from`, `from` + 1, ... before `to` whose circle is less than `reach` from a point: one
  // bit each, for as many as fit a vector.
  unsigned Within(float x, float y, float reach, std::uint32_t from, std::uint32_t to) const
  {
    const FloatLanes dx = LoadLanes(&x_[from]) - x;
    const FloatLanes dy = LoadLanes(&y_[from]) - y;
    const FloatLanes limit = LoadLanes(&r_[from]) + reach;
    const unsigned hits = LaneMask(dx * dx + dy * dy < limit * limit);
    const std::uint32_t left = to - from;
    return left < kLanes ? hits & ((1U << left) - 1) : hits;
  }
  // Where the sorted bodies end: those that take no part stand behind them.
  std::uint32_t End() const { return sort_.Starts()[cells_.Count()]; }
  void Sort(const PoseStore& poses, std::span<const std::uint8_t> present);
  void SweepBodies(float margin, std::size_t begin, std::size_t end, std::vector<Pair>& pairs) const;
  void SweepStatics(float margin);
  void FindPairsOfLarge(float margin, std::span<const std::uint8_t> present, const PoseStore& poses);

  std::size_t count_ = 0;
  PlaneCells<double> cells_;
  double largest_margin_ = 0;
  double largest_small_radius_ = 0;
  float slack_ = 0;  // covers the rounding of positions to float

  std::vector<float> radius_;         // of each body
  std::vector<std::uint32_t> large_;  // bodies that are too big for the cells, ascending
  std::vector<std::uint8_t> is_large_;

  CellSort sort_;
  std::vector<std::uint32_t> body_, sorted_cell_;
  std::vector<float> x_, y_, r_;

  std::vector<FloatBox> static_boxes_;
  CellLists statics_;  // the shapes near each cell

  std::vector<Pair> pairs_, static_pairs_;
  std::vector<std::vector<Pair>> parts_;  // of pairs_, found by other threads
};

}  // namespace swarmanoid::kinematics2d

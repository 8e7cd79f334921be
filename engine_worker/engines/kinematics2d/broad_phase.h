// Finds bodies that are near each other: a uniform grid, filled in each step by a counting sort, with float copies of
// the positions in the order of the cells. It remembers nothing from step to step, so that the pairs and their order
// follow from the positions alone. Threads may share the search. IsNear tells for a pair what a search would find,
// without a search (VerletList).
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "common/math/cells.h"
#include "common/math/lanes.h"
#include "common/threads/worker_pool.h"
#include "engine_worker/engines/kinematics2d/motion.h"

namespace swarmanoid::kinematics2d
{

struct Bounds
{
  double min_x = 0, min_y = 0;
  double max_x = 0, max_y = 0;

  void Include(double x, double y, double radius);
};

// Two bodies, first < second; or a body and a static shape, whose number is counted on from the bodies'.
struct Pair
{
  std::uint32_t first;
  std::uint32_t second;
};

// The pairs of some blocks, one block after the other.
struct PairList
{
  std::vector<Pair> pairs;
  std::vector<std::uint32_t> ends;  // of each block: where its pairs end
};

// The cells of a plane.
struct PlaneGrid
{
  Bounds area;
  double edge = 1;                  // of a cell (m)
  double largest_margin = 0;        // the largest margin that FindPairs can take
  double largest_radius = 0;        // bodies of a larger radius are too large for the cells
  double largest_small_radius = 0;  // the largest radius of the other bodies at the start

  // Makes cells for bodies with circles of these radii around them. Bodies may leave `area`; many of them far outside
  // only cost time.
  static PlaneGrid For(const Bounds& area, std::span<const double> radii, double largest_margin);
  // Returns whether Configure can take it.
  bool IsSound() const;
};

// Cells form blocks of kBlock x kBlock whose borders follow from the world's origin alone. Bodies that are paired in a
// block stand in its cells or next to it, so that no two blocks of one colour share a body.
class BroadPhase
{
public:
  static constexpr std::uint32_t kColours = 4;

  // Sets the cells and the bodies. `radii` are those of the circles around the bodies.
  void Configure(const PlaneGrid& grid, std::span<const double> radii);
  const PlaneGrid& Grid() const { return grid_; }
  // Sets the static shapes by their boxes. Call it after Configure.
  void SetStatics(std::span<const Bounds> boxes);
  // Replaces the bodies; the cells stay.
  void SetBodies(std::span<const double> radii);

  // Puts the bodies into cells. A body with present[k] = 0 is not found. The threads of `pool`, if there is one, share
  // the work.
  void Sort(const PoseStore& poses, std::span<const std::uint8_t> present, WorkerPool* pool = nullptr);
  const PlaneCells<double>& Cells() const { return cells_; }
  std::uint32_t BlockCount() const { return block_columns_ * block_rows_; }
  // Returns the numbers of all blocks, ascending.
  std::span<const std::uint32_t> Blocks() const { return blocks_; }
  std::uint32_t BlockColumns() const { return block_columns_; }
  // Calls act(first, last) with the first and the last cell of each row of a block.
  template <class Act>
  void ForEachRowOf(std::uint32_t block, const Act& act) const;
  // Sets the entries of a block's cells in an array of all cells.
  template <class Value>
  void FillBlock(std::uint32_t block, Value value, std::vector<Value>& of_cells) const
  {
    ForEachRowOf(block, [&](std::uint32_t first, std::uint32_t last)
                 { std::fill(of_cells.begin() + first, of_cells.begin() + last + 1, value); });
  }
  // Returns whether a body of this radius is too big for the cells.
  bool IsLarge(double radius) const { return radius > grid_.largest_radius; }
  // The bodies that are too big, ascending.
  std::span<const std::uint32_t> Large() const { return large_; }
  std::uint32_t ColourOf(std::uint32_t block) const
  {
    const std::uint32_t column = block % block_columns_ + first_block_column_;
    const std::uint32_t row = block / block_columns_ + first_block_row_;
    return (row & 1U) * 2 + (column & 1U);
  }
  // Shares blocks out after Sort: part.blocks of the first `sharing` parts become pieces of `blocks`, one after the
  // other, with about as many bodies each. Those of the other parts become empty.
  template <class Part>
  void ShareOut(std::span<const std::uint32_t> blocks, std::size_t sharing, std::vector<Part>& parts) const;
  // Finds, after Sort, bodies whose circles are less than `margin` (m) apart, and bodies with the static shapes near
  // them. They come block by block in the order of their cells. Large bodies are left out.
  void FindPairs(double margin, std::span<const std::uint32_t> blocks, PairList& found) const;
  // Returns whether FindPairs finds this pair when bodies are there: `reach` is that of its margin.
  bool IsNear(const Pair& pair, float reach, const PoseStore& poses) const
  {
    const auto x = static_cast<float>(poses.x[pair.first]);
    const auto y = static_cast<float>(poses.y[pair.first]);
    const float radius = radius_[pair.first];
    if (pair.second >= count_) return static_boxes_[pair.second - count_].IsNear(x, y, radius + reach);
    const float dx = static_cast<float>(poses.x[pair.second]) - x;
    const float dy = static_cast<float>(poses.y[pair.second]) - y;
    const float limit = radius_[pair.second] + radius + reach;
    return dx * dx + dy * dy < limit * limit;
  }
  float ReachOf(double margin) const { return static_cast<float>(margin) + 2 * slack_; }
  double LargestMargin() const { return grid_.largest_margin; }
  // No position is rounded by more than this (m).
  double Rounding() const { return slack_; }
  struct Place
  {
    std::uint32_t cell, block;
  };
  Place PlaceOf(double x, double y) const
  {
    const std::uint32_t column = cells_.columns.CellOf(x);
    const std::uint32_t row = cells_.rows.CellOf(y);
    return {cells_.Cell(column, row),
            (row + missing_rows_) / kBlock * block_columns_ + (column + missing_columns_) / kBlock};
  }
  // Finds the pairs of large bodies with all others.
  void FindPairsOfLarge(double margin, const PoseStore& poses, std::span<const std::uint8_t> present,
                        std::vector<Pair>& pairs) const;

private:
  static constexpr std::uint32_t kBlock = 16;

  struct FloatBox
  {
    float min_x, min_y, max_x, max_y;

    bool IsNear(float x, float y, float reach) const
    {
      return x + reach > min_x && x - reach < max_x && y + reach > min_y && y - reach < max_y;
    }
  };

  // Returns a bit for each of the sorted bodies from `from` to before `to` whose circle is less than `reach` from that
  // of a sorted body, for as many as fit a vector.
  unsigned Within(std::uint32_t body, float reach, std::uint32_t from, std::uint32_t to) const
  {
    const FloatLanes dx = LoadLanes(&x_[from]) - x_[body];
    const FloatLanes dy = LoadLanes(&y_[from]) - y_[body];
    const FloatLanes limit = LoadLanes(&r_[from]) + r_[body] + reach;
    const unsigned hits = LaneMask(dx * dx + dy * dy < limit * limit);
    const std::uint32_t left = to - from;
    return left < kLanes ? hits & ((1U << left) - 1) : hits;
  }
  // Returns the number of bodies that Sort put into a block.
  std::uint32_t BodiesIn(std::uint32_t block) const
  {
    const std::uint32_t* const start = sort_.Starts();
    std::uint32_t bodies = 0;
    ForEachRowOf(block, [&](std::uint32_t first, std::uint32_t last) { bodies += start[last + 1] - start[first]; });
    return bodies;
  }
  void SweepBlock(float reach, std::uint32_t block, std::vector<Pair>& pairs) const;
  void SweepStatics(float reach, std::uint32_t block, std::vector<Pair>& pairs) const;

  std::size_t count_ = 0;
  PlaneCells<double> cells_;
  // Blocks are numbered row by row. The first ones may be cut by the edge of the cells: columns and rows that they
  // lack.
  std::uint32_t block_columns_ = 1, block_rows_ = 1;
  std::uint32_t missing_columns_ = 0, missing_rows_ = 0;
  std::uint32_t first_block_column_ = 0, first_block_row_ = 0;  // counted from the world's origin, modulo 2
  std::vector<std::uint32_t> blocks_;
  PlaneGrid grid_;
  float slack_ = 0;  // covers the rounding of positions to float

  std::vector<float> radius_;         // of each body
  std::vector<std::uint32_t> large_;  // bodies that are too big for the cells, ascending

  CellSort sort_;
  // These arrays are in the order of the cells.
  std::vector<std::uint32_t> body_, sorted_cell_;
  std::vector<float> x_, y_, r_;

  std::vector<FloatBox> static_boxes_;
  CellLists statics_;  // the shapes near each cell
};

template <class Act>
inline void BroadPhase::ForEachRowOf(std::uint32_t block, const Act& act) const
{
  const auto begin = [](std::uint32_t number, std::uint32_t missing)
  { return std::max(number * kBlock, missing) - missing; };
  const std::uint32_t column = block % block_columns_;
  const std::uint32_t row = block / block_columns_;
  const std::uint32_t last_column = std::min((column + 1) * kBlock - missing_columns_, cells_.columns.Count()) - 1;
  const std::uint32_t row_end = std::min((row + 1) * kBlock - missing_rows_, cells_.rows.Count());
  for (std::uint32_t r = begin(row, missing_rows_); r < row_end; ++r)
    act(cells_.Cell(begin(column, missing_columns_), r), cells_.Cell(last_column, r));
}

template <class Part>
void BroadPhase::ShareOut(std::span<const std::uint32_t> blocks, std::size_t sharing, std::vector<Part>& parts) const
{
  std::uint64_t all = 0;
  if (sharing > 1)
    for (const std::uint32_t block : blocks) all += BodiesIn(block);
  std::size_t begin = 0;
  std::uint64_t bodies = 0;
  for (std::size_t k = 0; k < parts.size(); ++k)
  {
    std::size_t end = k + 1 >= sharing ? blocks.size() : begin;
    for (const std::uint64_t before = all * (k + 1) / sharing; end < blocks.size() && bodies < before; ++end)
      bodies += BodiesIn(blocks[end]);
    parts[k].blocks = blocks.subspan(begin, end - begin);
    begin = end;
  }
}

}  // namespace swarmanoid::kinematics2d

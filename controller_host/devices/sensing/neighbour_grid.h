// NeighbourGrid: finds bodies near a position. The bodies of a space are on two flat grids in the xy plane, rebuilt
// from the pose arrays once a tick. Movable bodies are counting-sorted by cell. The others are listed in every cell
// that they come near. Searches may report bodies that are slightly too far (single precision with a margin), so the
// caller must test exactly. In steady running it allocates nothing.
//
// GridIndex (common/space/index) has the same cells (common/math/cells.h) for other questions. It finds the origins of
// all entities, exactly and in entity order, behind an interface that an oct-tree implements too. Sensors need bodies
// by their outlines, eight at a time, in the order of the cells, so that neighbours stay in the cache. One class for
// both would lose speed or these promises. A search of 3 m among one body per square metre takes 80 ns here and 620 ns
// with GridIndex.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "common/math/cells.h"
#include "common/math/lanes.h"
#include "common/threads/worker_pool.h"
#include "controller_host/devices/sensing/body_shapes.h"

namespace swarmanoid
{

// Cells in single precision, and the cells along a way or around a point.
struct CellFrame : PlaneCells<float>
{
  using PlaneCells::PlaneCells;

  // Calls visit(first, last) with the range of cells, row by row, that come within `width` of the segment between two
  // points.
  template <class Visit>
  void ForEachSpanAlong(float x0, float y0, float x1, float y1, float width, Visit&& visit) const;
  // The first and the last cells that come within `reach` of a point, for kLanes rows; a few are farther.
  struct Chords
  {
    std::array<std::int32_t, kLanes> first, last;
  };
  Chords ChordsFrom(std::uint32_t row, float x, float y, float reach) const;
};

// The cells that come within some reach of kLanes points: rows, and columns as counted from the start of a row.
struct CellWindows
{
  std::array<std::int32_t, kLanes> first_row, last_row, first_column, last_column;
};

// Movable bodies around a point, by lanes: room for 2 * kLanes more behind `count`.
struct NearBodies
{
  std::size_t count = 0;
  bool are_alike = false;        // all have one radius, one low and one high
  std::size_t alike = 0;         // so many places hold the radius, low and high of the first
  std::vector<float> x, y;       // m, of the origin of the body from the point
  std::vector<float> radius;     // m
  std::vector<float> low, high;  // m, in the space, where the body is upright
  std::vector<std::int32_t> entity;
  std::vector<std::int32_t> place;  // in the order of the cells; only if the grid filled it

  void Reserve(std::size_t bodies);
};

class NeighbourGrid
{
public:
  NeighbourGrid(const CSwarmanoidSpace& space, const BodyShapes& shapes);

  // Sorts the movable bodies in the arena from the poses of the space. Bodies outside it sense nothing and are not
  // sensed. The threads of `pool`, if it is given, share the work.
  void Rebuild(WorkerPool* pool = nullptr);

  // Returns how often Rebuild was called.
  std::uint64_t Rebuilds() const { return rebuilds_; }

  // Returns the bodies that may be sorted: the movable entities with a body, ascending.
  std::span<const std::uint32_t> Bodies() const { return bodies_; }
  // Returns the movable bodies in the order of their cells: entity indices.
  std::span<const std::uint32_t> Sorted() const { return {entity_.data(), count_}; }

  // Returns the middles of the circles around kLanes bodies, given by their places.
  std::pair<FloatLanes, FloatLanes> MiddlesAt(const std::int32_t* places) const
  {
    const IntLanes at = LoadLanes(places);
    return {Gathered(x_.data(), at), Gathered(y_.data(), at)};
  }
  // Return the positions of the bodies in the same order (m in the space).
  const double* OriginX() const { return origin_x_.data(); }
  const double* OriginY() const { return origin_y_.data(); }
  const double* OriginZ() const { return origin_z_.data(); }

  // No movable body is tilted.
  bool AllUpright() const { return all_upright_; }
  // All movable bodies have their origins at one height.
  bool AllLevel() const { return all_level_; }
  // No movable body is a box.
  bool AllCylinders() const { return all_cylinders_; }
  // The body of all of them, if they are cylinders of one size; else nullptr.
  const BodyShape* ShapeOfAll() const { return shape_of_all_; }
  // All have one radius and stand at one height, if they are upright.
  bool AreAlike() const { return are_alike_; }

  // Calls visit(entity) for every movable body whose circle in the xy plane comes within `reach` m of (x, y), in the
  // order of the cells, and for few others.
  template <class Visit>
  void ForEachNear(double x, double y, double reach, Visit&& visit) const
  {
    ForEachPlaceNear(x, y, reach, [&](std::size_t place) { visit(entity_[place]); });
  }
  // Calls visit(place) for the same bodies, in the order of Sorted().
  template <class Visit>
  void ForEachPlaceNear(double x, double y, double reach, Visit&& visit) const;
  // Finds the cells around kLanes bodies, given by their places, for ForEachOtherNear.
  void FindWindows(const std::int32_t* places, double reach, CellWindows& windows) const;
  // Works as ForEachPlaceNear around the body at a place, without that body, which must be upright. `windows` and
  // `lane` are its cells for this reach or more.
  template <class Visit>
  void ForEachOtherNear(std::size_t place, double reach, const CellWindows& windows, std::size_t lane,
                        Visit&& visit) const;
  // Calls visit(first, behind) with the places, row by row of the cells, of all these bodies and others.
  template <class Visit>
  void ForEachSpanNear(double x, double y, double reach, Visit&& visit) const;
  // Fills `near` with these bodies, without `left_out`; it needs room for all.
  void CollectNear(double x, double y, double reach, std::uint32_t left_out, NearBodies& near) const;
  // Works as ForEachNear for bodies whose circle comes near the segment between two points in the xy plane.
  template <class Visit>
  void ForEachAlong(const Vector3& from, const Vector3& to, Visit&& visit) const;

private:
  // Properties of all bodies in the part of a thread.
  struct Facts
  {
    float largest = 0;
    bool upright = true;
    bool level = true;
    bool alike = true;
  };

  // Combines part(begin, end) of all threads.
  template <class Part>
  Facts InAllParts(WorkerPool* pool, const Part& part);
  // FindCells finds the cells of the bodies from `begin` to before `end`. Gather copies positions and outlines in the
  // order of the cells; the outline functions do it for upright bodies of one shape and for any bodies.
  Facts FindCells(std::size_t begin, std::size_t end, std::uint32_t* cells) const;
  Facts Gather(std::size_t begin, std::size_t end);
  void OutlineAlike(const BodyShape& shape, std::size_t begin, std::size_t end);
  bool OutlineEach(std::size_t begin, std::size_t end);
  template <bool kAlike>
  std::size_t Collect(double x, double y, double reach, std::uint32_t left_out, NearBodies& near) const;

  const CSwarmanoidSpace& space_;
  const BodyShapes& shapes_;
  const BodyShape* shape_of_all_ = nullptr;  // if the movable bodies have one, and it stays as it is
  CellFrame frame_;
  std::vector<std::uint32_t> bodies_;  // movable entities with a body, ascending
  std::vector<std::uint32_t> here_;    // the bodies in the arena, if some are outside
  std::size_t count_ = 0;
  std::uint64_t rebuilds_ = 0;
  float margin_ = 0;          // covers the rounding to single precision
  float largest_radius_ = 0;  // of this tick
  bool all_upright_ = true;
  bool all_cylinders_ = true;
  bool all_level_ = true;
  bool are_alike_ = true;  // as in NearBodies

  CellSort sort_;
  std::span<const std::uint32_t> sorted_from_;  // bodies_ or here_
  std::vector<Facts> facts_;                    // of each part
  // Values by place in the sorted order, with far-away padding at the end.
  std::vector<float> x_, y_, radius_, low_, high_;
  std::vector<double> origin_x_, origin_y_, origin_z_;
  std::vector<std::uint32_t> entity_;
};

// The bodies that never move, listed in every cell from which some point is within `reach` of them.
class FixedBodies
{
public:
  FixedBodies(const CSwarmanoidSpace& space, const BodyShapes& shapes, double reach);

  // Returns the entities, ascending, that come within the reach of (x, y), and possibly others.
  std::span<const std::uint32_t> Near(double x, double y) const
  {
    return lists_.In(frame_.CellOf(static_cast<float>(x), static_cast<float>(y)));
  }

  // Returns the bodies listed in the cell of a point.
  std::span<const std::uint32_t> InCell(std::int32_t cell) const { return lists_.In(static_cast<std::uint32_t>(cell)); }
  // Finds the cells of kLanes points.
  void FindCells(const NeighbourGrid& grid, const std::int32_t* places, std::int32_t* cells) const;

  // Calls visit(entity), perhaps more than once, for every body that the segment may touch if the reach is at least 0.
  template <class Visit>
  void ForEachAlong(const Vector3& from, const Vector3& to, Visit&& visit) const
  {
    frame_.ForEachSpanAlong(static_cast<float>(from.x()), static_cast<float>(from.y()), static_cast<float>(to.x()),
                            static_cast<float>(to.y()), margin_,
                            [&](std::uint32_t first, std::uint32_t last)
                            {
                              for (const std::uint32_t body : lists_.In(first, last)) visit(body);
                            });
  }
  // Calls visit for every listed body that comes near the square of half side `reach` around (x, y).
  template <class Visit>
  void ForEachInSquare(double x, double y, double reach, Visit&& visit) const
  {
    const double wide = reach + static_cast<double>(margin_);
    frame_.ForEachRow(static_cast<float>(x - wide), static_cast<float>(y - wide), static_cast<float>(x + wide),
                      static_cast<float>(y + wide),
                      [&](std::uint32_t first, std::uint32_t last)
                      {
                        for (const std::uint32_t body : lists_.In(first, last)) visit(body);
                      });
  }

private:
  CellFrame frame_;
  float margin_ = 0;
  CellLists lists_;
};

inline CellFrame::Chords CellFrame::ChordsFrom(std::uint32_t row, float x, float y, float reach) const
{
  // How far each row is from the point along y, border rows reaching to infinity; a little less covers the rounding.
  const float size = 1 / rows.inverse_edge;
  const IntLanes number = static_cast<int>(row) + LaneNumbers();
  const FloatLanes low = rows.start + __builtin_convertvector(number, FloatLanes) * size;
  const FloatLanes above = number == static_cast<int>(rows.last) ? Everywhere(0.0F) : y - (low + size);
  const FloatLanes below = number == 0 ? Everywhere(0.0F) : low - y;
  const FloatLanes away = Maximum(Maximum(above, below) - 1e-3F * size, FloatLanes{});
  const FloatLanes half = SquareRoot(Maximum(reach * reach - away * away, FloatLanes{})) + 1e-3F * size;

  const auto column = [&](FloatLanes at)
  {
    const FloatLanes cell = (at - columns.start) * columns.inverse_edge;
    return Truncated(Minimum(Maximum(cell, FloatLanes{}), Everywhere(columns.last)));
  };
  const IntLanes line = number * static_cast<int>(stride);
  Chords chords;
  StoreLanes(line + column(x - half), chords.first.data());
  StoreLanes(line + column(x + half), chords.last.data());
  return chords;
}

template <class Visit>
void CellFrame::ForEachSpanAlong(float x0, float y0, float x1, float y1, float width, Visit&& visit) const
{
  if (y0 > y1)
  {
    std::swap(x0, x1);
    std::swap(y0, y1);
  }
  const std::uint32_t first_row = rows.CellOf(y0 - width);
  const std::uint32_t last_row = rows.CellOf(y1 + width);
  const std::uint32_t border = rows.Count() - 1;
  const float size = 1 / rows.inverse_edge;
  const float slope = y1 > y0 ? (x1 - x0) / (y1 - y0) : 0;
  for (std::uint32_t row = first_row; row <= last_row; ++row)
  {
    // The part of the segment within `width` of this row, border rows reaching to infinity.
    const float low = rows.start + static_cast<float>(row) * size - width;
    const float high = rows.start + static_cast<float>(row + 1) * size + width;
    const float from = row == 0 || low <= y0 ? x0 : x0 + (low - y0) * slope;
    const float to = row == border || high >= y1 ? x1 : x0 + (high - y0) * slope;
    // One more cell at either end covers the rounding of the slope.
    const std::uint32_t first_column = columns.CellOf(std::min(from, to) - width);
    const std::uint32_t last_column = columns.CellOf(std::max(from, to) + width);
    visit(Cell(first_column - (first_column > 0 ? 1 : 0), row),
          Cell(std::min(last_column + 1, columns.Count() - 1), row));
  }
}

template <class Visit>
void NeighbourGrid::ForEachAlong(const Vector3& from, const Vector3& to, Visit&& visit) const
{
  const auto x0 = static_cast<float>(from.x());
  const auto y0 = static_cast<float>(from.y());
  const auto step_x = static_cast<float>(to.x() - from.x());
  const auto step_y = static_cast<float>(to.y() - from.y());
  const float length = __builtin_sqrtf(step_x * step_x + step_y * step_y);
  const std::uint32_t* const start = sort_.Starts();
  frame_.ForEachSpanAlong(x0, y0, static_cast<float>(to.x()), static_cast<float>(to.y()), largest_radius_ + margin_,
                          [&](std::uint32_t first, std::uint32_t last)
                          {
                            const std::size_t end = start[last + 1];
                            for (std::size_t i = start[first]; i < end; i += kLanes)
                            {
                              const FloatLanes dx = LoadLanes(&x_[i]) - x0;
                              const FloatLanes dy = LoadLanes(&y_[i]) - y0;
                              const FloatLanes cut = LoadLanes(&radius_[i]) + margin_;
                              // The body must be within the cut of the line, and not beyond either end.
                              const FloatLanes across = dx * step_y - dy * step_x;
                              const FloatLanes along = dx * step_x + dy * step_y;
                              const FloatLanes beyond = cut * length;
                              unsigned hits = LaneMask((across <= beyond) & (across >= -beyond) & (along >= -beyond) &
                                                       (along <= length * length + beyond));
                              if (end - i < kLanes) hits &= (1U << (end - i)) - 1U;
                              ForEachBit(hits, [&](unsigned bit) { visit(entity_[i + bit]); });
                            }
                          });
}

// Always inline: else what visit() changes would stand in memory.
template <class Visit>
[[gnu::always_inline]] inline void NeighbourGrid::ForEachSpanNear(double x, double y, double reach, Visit&& visit) const
{
  const auto fx = static_cast<float>(x);
  const auto fy = static_cast<float>(y);
  const float widest = static_cast<float>(reach) + margin_ + largest_radius_;
  const std::uint32_t first_row = frame_.rows.CellOf(fy - widest);
  const std::uint32_t last_row = frame_.rows.CellOf(fy + widest);
  const std::uint32_t* const start = sort_.Starts();
  // In few rows there are no corners to cut off.
  if (last_row - first_row < 3)
    return frame_.ForEachRow(fx - widest, fy - widest, fx + widest, fy + widest,
                             [&](std::uint32_t first, std::uint32_t last) { visit(start[first], start[last + 1]); });
  for (std::uint32_t row = first_row; row <= last_row; row += kLanes)
  {
    const CellFrame::Chords chords = frame_.ChordsFrom(row, fx, fy, widest);
    const std::uint32_t count = std::min<std::uint32_t>(kLanes, last_row - row + 1);
    for (std::uint32_t i = 0; i < count; ++i) visit(start[chords.first[i]], start[chords.last[i] + 1]);
  }
}

template <class Visit>
void NeighbourGrid::ForEachPlaceNear(double x, double y, double reach, Visit&& visit) const
{
  const auto fx = static_cast<float>(x);
  const auto fy = static_cast<float>(y);
  const float own = static_cast<float>(reach) + margin_;
  // These local copies are needed because the compiler cannot know that visit() leaves the members alone.
  const float* const body_x = x_.data();
  const float* const body_y = y_.data();
  const float* const body_radius = radius_.data();
  ForEachSpanNear(x, y, reach,
                  [&](std::size_t first, std::size_t behind)
                  {
                    for (std::size_t i = first; i < behind; i += kLanes)
                    {
                      const FloatLanes dx = LoadLanes(body_x + i) - fx;
                      const FloatLanes dy = LoadLanes(body_y + i) - fy;
                      const FloatLanes cut = LoadLanes(body_radius + i) + own;
                      unsigned hits = LaneMask(dx * dx + dy * dy <= cut * cut);
                      if (behind - i < kLanes) hits &= (1U << (behind - i)) - 1U;
                      ForEachBit(hits, [&](unsigned bit) { visit(i + bit); });
                    }
                  });
}

template <class Visit>
[[gnu::always_inline]] inline void NeighbourGrid::ForEachOtherNear(std::size_t place, double reach,
                                                                   const CellWindows& windows, std::size_t lane,
                                                                   Visit&& visit) const
{
  const float own = static_cast<float>(reach) + margin_;
  const float* const body_x = x_.data();
  const float* const body_y = y_.data();
  const float* const body_radius = radius_.data();
  const float x = body_x[place];
  const float y = body_y[place];
  const std::uint32_t* const start = sort_.Starts();
  const std::uint32_t* row = start + std::size_t{frame_.stride} * static_cast<std::uint32_t>(windows.first_row[lane]);
  for (std::int32_t rows = windows.last_row[lane] - windows.first_row[lane]; rows >= 0; --rows, row += frame_.stride)
  {
    const std::size_t behind = row[windows.last_column[lane] + 1];
    for (std::size_t i = row[windows.first_column[lane]]; i < behind; i += kLanes)
    {
      const FloatLanes dx = LoadLanes(body_x + i) - x;
      const FloatLanes dy = LoadLanes(body_y + i) - y;
      const FloatLanes cut = LoadLanes(body_radius + i) + own;
      unsigned hits = LaneMask(dx * dx + dy * dy <= cut * cut);
      if (behind - i < kLanes) hits &= (1U << (behind - i)) - 1U;
      if (place - i < kLanes) hits &= ~(1U << (place - i));
      ForEachBit(hits, [&](unsigned bit) { visit(i + bit); });
    }
  }
}

}  // namespace swarmanoid

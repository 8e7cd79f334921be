// Divides space into equal cells and sorts entities into them. All searches by position use it: the indexes of the
// space, the sensors' grids, the engines' broad phase, and the placing of bodies. Points outside belong to the nearest
// cell; NaN belongs to the first cell.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/math/lanes.h"

namespace swarmanoid
{

// Returns how many cells of an edge cover a length (m): at least one.
inline double CellsAcross(double length, double edge) { return std::max(1.0, std::ceil(length / edge)); }

// Returns the edge (m) of cells that cut a rectangle or a box into at most `most` cells: `smallest` if possible.
template <std::size_t kAxes>
double CellEdge(std::array<double, kAxes> extent, double smallest, double most)
{
  static_assert(kAxes == 2 || kAxes == 3);
  double content = 1;
  for (double& length : extent) content *= length = std::max(smallest, length);
  const auto cells = [&](double edge)
  {
    double count = 1;
    for (const double length : extent) count *= CellsAcross(length, edge);
    return count;
  };
  double edge = std::max(smallest, kAxes == 2 ? std::sqrt(content / most) : std::cbrt(content / most));
  while (cells(edge) > most) edge *= 1.2;
  return edge;
}

// A line that is cut into cells.
template <class Number>
struct CellAxis
{
  Number start = 0;         // m
  Number inverse_edge = 1;  // 1/m
  Number last = 0;          // the number of the last cell

  CellAxis() = default;
  CellAxis(double from, double length, double edge)
      : start(static_cast<Number>(from)),
        inverse_edge(static_cast<Number>(1 / edge)),
        last(static_cast<Number>(CellsAcross(length, edge) - 1))
  {
  }

  std::uint32_t Count() const { return static_cast<std::uint32_t>(last) + 1; }
  std::uint32_t CellOf(Number at) const
  {
    // The value is clamped before the conversion, since a position may be any number.
    const Number cell = (at - start) * inverse_edge;
    return static_cast<std::uint32_t>(std::min(cell > 0 ? cell : Number{0}, last));
  }
};

// A rectangle that is cut into squares, numbered row by row.
template <class Number>
struct PlaneCells
{
  CellAxis<Number> columns, rows;
  std::uint32_t stride = 1;  // from a cell to the one above it
  std::uint32_t first = 0;   // the cell at the lower left

  PlaneCells() = default;
  // `ring`: adds empty cells around all others, so that each of the others has eight neighbours.
  PlaneCells(double left, double bottom, double width, double height, double edge, bool ring = false)
      : columns(left, width, edge),
        rows(bottom, height, edge),
        stride(columns.Count() + (ring ? 2 : 0)),
        first(ring ? stride + 1 : 0)
  {
  }

  // Returns the number of cells, including those of the ring.
  std::size_t Count() const { return std::size_t{stride} * (rows.Count() + (first > 0 ? 2 : 0)); }
  std::uint32_t Cell(std::uint32_t column, std::uint32_t row) const { return first + row * stride + column; }
  std::uint32_t CellOf(Number x, Number y) const { return Cell(columns.CellOf(x), rows.CellOf(y)); }
  // Finds the cells of many points.
  void FindCells(std::span<const double> x, std::span<const double> y,
                 std::uint32_t* cells) const requires std::same_as<Number, double>
  {
    const auto lanes_of = [](const CellAxis<double>& axis, const double* at)
    {
      const DoubleLanes cell = (LoadLanes(at) - axis.start) * axis.inverse_edge;
      return Truncated(Minimum(Maximum(cell, DoubleLanes{}), Everywhere(axis.last)));
    };
    std::size_t i = 0;
    for (; i + kDoubleLanes <= x.size(); i += kDoubleLanes)
      StoreLanes(lanes_of(rows, &y[i]) * static_cast<std::int32_t>(stride) + lanes_of(columns, &x[i]) +
                     static_cast<std::int32_t>(first),
                 reinterpret_cast<std::int32_t*>(cells + i));
    for (; i < x.size(); ++i) cells[i] = CellOf(x[i], y[i]);
  }

  // Calls visit(first, last) with the cells of each row that a rectangle touches, from the lowest row.
  template <class Visit>
  void ForEachRow(Number left, Number bottom, Number right, Number top, const Visit& visit) const
  {
    const std::uint32_t first_column = columns.CellOf(left);
    const std::uint32_t last_column = columns.CellOf(right);
    const std::uint32_t last_row = rows.CellOf(top);
    for (std::uint32_t row = rows.CellOf(bottom); row <= last_row; ++row)
      visit(Cell(first_column, row), Cell(last_column, row));
  }
};

// A box that is cut into cubes: layers of a plane, numbered from the lowest. A single layer is a plane whose cells are
// columns.
struct BoxCells
{
  PlaneCells<double> plane;
  CellAxis<double> layers;

  std::size_t Count() const { return plane.Count() * layers.Count(); }
  // Finds the cells of many points, as for the plane.
  void FindCells(std::span<const double> x, std::span<const double> y, std::span<const double> z,
                 std::uint32_t* cells) const
  {
    plane.FindCells(x, y, cells);
    if (layers.last == 0) return;
    const auto in_layer = static_cast<std::uint32_t>(plane.Count());
    for (std::size_t i = 0; i < z.size(); ++i) cells[i] += layers.CellOf(z[i]) * in_layer;
  }
  template <class Point, class Visit>
  void ForEachRow(const Point& low, const Point& high, const Visit& visit) const
  {
    const auto in_layer = static_cast<std::uint32_t>(plane.Count());
    const std::uint32_t last_layer = layers.CellOf(high.z());
    for (std::uint32_t layer = layers.CellOf(low.z()); layer <= last_layer; ++layer)
      plane.ForEachRow(low.x(), low.y(), high.x(), high.y(),
                       [&](std::uint32_t first, std::uint32_t last)
                       { visit(layer * in_layer + first, layer * in_layer + last); });
  }
};

// It sorts by counting. It assigns each member an index so that the members of a cell are adjacent, in their original
// order. Sorting again allocates nothing.
class CellSort
{
public:
  void SetCells(std::size_t cells) { start_.assign(cells + 2, 0); }
  // Returns an array to be filled with the cell of each member before Sort.
  std::span<std::uint32_t> Cells(std::size_t members)
  {
    cell_.resize(members);
    return cell_;
  }
  // Calls put(member, index) for all members.
  template <class Put>
  void Sort(const Put& put)
  {
    // Counts are stored two entries up, so that after the last loop start_[c] is the first index of cell c.
    std::fill(start_.begin(), start_.end(), 0U);
    std::uint32_t* const start = start_.data();
    for (const std::uint32_t cell : cell_) ++start[cell + 2];
    for (std::size_t c = 2; c < start_.size(); ++c) start[c] += start[c - 1];
    for (std::size_t member = 0; member < cell_.size(); ++member) put(member, start[cell_[member] + 1]++);
  }
  // Returns the first index of each cell; the next entry is one past its last index.
  const std::uint32_t* Starts() const { return start_.data(); }

private:
  std::vector<std::uint32_t> start_;  // by cell, and two more
  std::vector<std::uint32_t> cell_;   // by member
};

// Lists of static members in any number of cells. Each cell lists its members in the order of their arrival.
class CellLists
{
public:
  void Add(std::uint32_t cell, std::uint32_t member)
  {
    cells_.push_back(cell);
    members_.push_back(member);
  }
  // Completes the lists after all members were added.
  void Close(std::size_t cells)
  {
    sort_.SetCells(cells);
    std::ranges::copy(cells_, sort_.Cells(cells_.size()).begin());
    listed_.resize(members_.size());
    sort_.Sort([this](std::size_t member, std::uint32_t place) { listed_[place] = members_[member]; });
    cells_ = members_ = {};
  }
  // Returns the lists of a range of cells, one behind the other.
  std::span<const std::uint32_t> In(std::uint32_t first, std::uint32_t last) const
  {
    const std::uint32_t* const start = sort_.Starts();
    return {listed_.data() + start[first], start[last + 1] - start[first]};
  }
  std::span<const std::uint32_t> In(std::uint32_t cell) const { return In(cell, cell); }
  // Prefetches the entries that In will read.
  void Prefetch(std::uint32_t cell) const { __builtin_prefetch(sort_.Starts() + cell); }

private:
  CellSort sort_;
  std::vector<std::uint32_t> cells_, members_;
  std::vector<std::uint32_t> listed_;
};

}  // namespace swarmanoid

#include "common/space/index/grid_index.h"

#include <algorithm>
#include <cmath>

namespace swarmanoid
{
namespace
{

constexpr double kSmallestCell = 0.25;       // metres
constexpr double kLargestLayeredCell = 1.0;  // metres
constexpr double kMostCells = 4e6;

std::size_t CellCount(double length, double cell)
{
  return std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(length / cell)));
}

}  // namespace

double GridIndex::CellSize(const Vector3& size, std::size_t points, bool layered)
{
  // About one point in each cell; layered ones stay within the reach of sensors, since 3D arenas are seldom evenly
  // filled.
  const double count = std::max<double>(1, static_cast<double>(points));
  const double area = std::max(size.x() * size.y(), 1e-6);
  if (layered)
    return std::clamp(std::cbrt(area * std::max(size.z(), 1e-3) / count), kSmallestCell, kLargestLayeredCell);
  // However large the arena: never more cells than memory is good for.
  return std::max({std::sqrt(area / count), kSmallestCell, std::sqrt(area / kMostCells)});
}

double GridIndex::LayeredCells(const Vector3& size, std::size_t points)
{
  const double cell = CellSize(size, points, true);
  return std::ceil(size.x() / cell) * std::ceil(size.y() / cell) * std::ceil(size.z() / cell);
}

GridIndex::GridIndex(const Vector3& arena_size, std::size_t expected_points, bool layered)
    : layered_(layered),
      cell_m_(CellSize(arena_size, expected_points, layered)),
      nx_(CellCount(arena_size.x(), cell_m_)),
      ny_(CellCount(arena_size.y(), cell_m_)),
      nz_(layered ? CellCount(arena_size.z(), cell_m_) : 1),
      start_(nx_ * ny_ * nz_ + 1)
{
}

std::size_t GridIndex::CellOf(double coordinate, std::size_t count) const
{
  const double cell = coordinate / cell_m_;
  if (!(cell > 0)) return 0;  // also what is not a number
  return cell >= static_cast<double>(count) ? count - 1 : static_cast<std::size_t>(cell);
}

GridIndex::Range GridIndex::CellsOf(double low, double high, std::size_t count) const
{
  return {CellOf(low, count), CellOf(high, count)};
}

void GridIndex::Update(const PointArrays& points)
{
  points_ = points;
  const std::size_t count = points.Size();
  cell_.resize(count);
  id_.resize(count);
  x_.resize(count);
  y_.resize(count);
  z_.resize(count);

  // Counting sort: how many in each cell, where each cell starts, each point to its place.
  std::fill(start_.begin(), start_.end(), 0U);
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::size_t z = layered_ ? CellOf(points.z[i], nz_) : 0;
    const std::size_t cell = (z * ny_ + CellOf(points.y[i], ny_)) * nx_ + CellOf(points.x[i], nx_);
    cell_[i] = static_cast<std::uint32_t>(cell);
    ++start_[cell + 1];
  }
  for (std::size_t c = 1; c < start_.size(); ++c) start_[c] += start_[c - 1];
  for (std::size_t i = count; i-- > 0;)
  {
    // Backwards, so that start_ ends as the start of each cell and points of a cell stay ascending.
    const std::uint32_t place = --start_[cell_[i] + 1];
    id_[place] = static_cast<std::uint32_t>(i);
    x_[place] = points.x[i];
    y_[place] = points.y[i];
    z_[place] = points.z[i];
  }
  // start_[c + 1] is now the start of cell c.
  std::copy(start_.begin() + 1, start_.end(), start_.begin());
  start_.back() = static_cast<std::uint32_t>(count);
}

template <class Accept>
void GridIndex::Collect(const Vector3& low, const Vector3& high, Accept accept, std::vector<std::uint32_t>& found) const
{
  found.clear();
  const Range xs = CellsOf(low.x(), high.x(), nx_);
  const Range ys = CellsOf(low.y(), high.y(), ny_);
  const Range zs = layered_ ? CellsOf(low.z(), high.z(), nz_) : Range{0, 0};
  for (std::size_t z = zs.first; z <= zs.last; ++z)
    for (std::size_t y = ys.first; y <= ys.last; ++y)
    {
      // The cells of a row are neighbours in memory.
      const std::size_t row = (z * ny_ + y) * nx_;
      for (std::size_t k = start_[row + xs.first]; k < start_[row + xs.last + 1]; ++k)
        if (accept(x_[k], y_[k], z_[k])) found.push_back(id_[k]);
    }
  std::sort(found.begin(), found.end());
}

void GridIndex::FindWithin(const Vector3& centre, double radius, std::vector<std::uint32_t>& found) const
{
  const Vector3 reach = Vector3::Constant(radius);
  const double limit = radius * radius;
  Collect(
      centre - reach, centre + reach,
      [&](double x, double y, double z)
      {
        const double dx = x - centre.x();
        const double dy = y - centre.y();
        const double dz = z - centre.z();
        return dx * dx + dy * dy + dz * dz <= limit;
      },
      found);
}

void GridIndex::FindInBox(const Vector3& low, const Vector3& high, std::vector<std::uint32_t>& found) const
{
  Collect(
      low, high,
      [&](double x, double y, double z)
      { return x >= low.x() && x <= high.x() && y >= low.y() && y <= high.y() && z >= low.z() && z <= high.z(); },
      found);
}

}  // namespace swarmanoid

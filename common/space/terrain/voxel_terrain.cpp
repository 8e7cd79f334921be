// The map is an octree of occupied cubes of several sizes. Searching it at each step would be slow, so the constructor
// paints all cubes into a bitmap of the smallest cells. A search for a hit then walks from cell to cell.
//
// Invariant: a cell outside the box of the map is free.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "common/space/terrain/octomap_file.h"
#include "common/space/terrain/rectangles.h"
#include "common/space/terrain/terrain.h"

namespace swarmanoid
{
namespace
{

// A bitmap of more cells than this (512 MiB of bits) is refused.
constexpr double kMostCells = 4.0e9;

}  // namespace

VoxelTerrain::VoxelTerrain(const std::string& path)
{
  const auto tree = ReadOctoMap(path);
  cell_ = tree->getResolution();

  // It is an occupied leaf, in units of the smallest cell. A large leaf covers many cells.
  struct Cube
  {
    long x, y, z, width;
  };
  std::vector<Cube> cubes;
  std::array<long, 3> low{std::numeric_limits<long>::max(), std::numeric_limits<long>::max(),
                          std::numeric_limits<long>::max()};
  std::array<long, 3> high{std::numeric_limits<long>::min(), std::numeric_limits<long>::min(),
                           std::numeric_limits<long>::min()};
  for (auto leaf = tree->begin_leafs(); leaf != tree->end_leafs(); ++leaf)
  {
    if (!tree->isNodeOccupied(*leaf)) continue;
    const double half = leaf.getSize() / 2;
    const auto cell_of = [&](double centre) { return std::lround((centre - half) / cell_); };
    const Cube cube{cell_of(leaf.getX()), cell_of(leaf.getY()), cell_of(leaf.getZ()),
                    std::lround(leaf.getSize() / cell_)};
    const std::array<long, 3> corner{cube.x, cube.y, cube.z};
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      low[axis] = std::min(low[axis], corner[axis]);
      high[axis] = std::max(high[axis], corner[axis] + cube.width);
    }
    cubes.push_back(cube);
  }
  if (cubes.empty()) throw std::runtime_error("'" + path + "' holds no occupied cell");

  nx_ = static_cast<int>(high[0] - low[0]);
  ny_ = static_cast<int>(high[1] - low[1]);
  nz_ = static_cast<int>(high[2] - low[2]);
  if (static_cast<double>(nx_) * ny_ * nz_ > kMostCells)
    throw std::runtime_error(
        fmt::format("'{}' spans {} x {} x {} cells; {} are the most", path, nx_, ny_, nz_, kMostCells));
  low_ = cell_ * Vector3(static_cast<double>(low[0]), static_cast<double>(low[1]), static_cast<double>(low[2]));
  occupied_.assign(static_cast<std::size_t>(nx_) * static_cast<std::size_t>(ny_) * static_cast<std::size_t>(nz_),
                   false);
  for (const Cube& cube : cubes)
    for (long z = cube.z; z < cube.z + cube.width; ++z)
      for (long y = cube.y; y < cube.y + cube.width; ++y)
      {
        const std::size_t first =
            Bit(static_cast<int>(cube.x - low[0]), static_cast<int>(y - low[1]), static_cast<int>(z - low[2]));
        std::fill_n(occupied_.begin() + static_cast<std::ptrdiff_t>(first), cube.width, true);
      }
}

bool VoxelTerrain::IsOccupied(int x, int y, int z) const
{
  if (x < 0 || y < 0 || z < 0 || x >= nx_ || y >= ny_ || z >= nz_) return false;
  return occupied_[Bit(x, y, z)];
}

bool VoxelTerrain::IsSolid(const Vector3& point) const
{
  const Vector3 cell = (point - low_) / cell_;
  if (!(cell.minCoeff() >= 0) || cell.maxCoeff() > 1e9) return false;
  return IsOccupied(static_cast<int>(cell.x()), static_cast<int>(cell.y()), static_cast<int>(cell.z()));
}

std::optional<double> VoxelTerrain::GroundBelow(const Vector3& point) const
{
  const Vector3 cell = (point - low_) / cell_;
  if (!(cell.x() >= 0 && cell.y() >= 0 && cell.x() < nx_ && cell.y() < ny_ && cell.z() >= 0)) return std::nullopt;
  for (int z = std::min(nz_, static_cast<int>(std::min(cell.z(), 1e9)) + 1) - 1; z >= 0; --z)
    if (IsOccupied(static_cast<int>(cell.x()), static_cast<int>(cell.y()), z))
      return std::min(point.z(), low_.z() + (z + 1) * cell_);
  return std::nullopt;
}

// Walks through the cells along the segment: J. Amanatides and A. Woo, "A fast voxel traversal algorithm for ray
// tracing", Eurographics 1987.
std::optional<double> VoxelTerrain::SegmentHit(const Vector3& from, const Vector3& to) const
{
  const Vector3 start = (from - low_) / cell_;
  const Vector3 step = (to - from) / cell_;
  const std::array<int, 3> cells{nx_, ny_, nz_};

  // The segment is first shortened to the part inside the map.
  double enter = 0;
  double leave = 1;
  for (int axis = 0; axis < 3; ++axis)
  {
    if (step[axis] == 0)
    {
      if (start[axis] < 0 || start[axis] > cells[axis]) return std::nullopt;
      continue;
    }
    const double a = -start[axis] / step[axis];
    const double b = (cells[axis] - start[axis]) / step[axis];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  if (!(enter <= leave)) return std::nullopt;

  std::array<int, 3> cell{};
  std::array<int, 3> direction{};
  std::array<double, 3> next{};   // the fraction at which the next cell begins, by axis
  std::array<double, 3> width{};  // the width of one cell as a fraction, by axis
  for (int axis = 0; axis < 3; ++axis)
  {
    const double at = start[axis] + enter * step[axis];
    cell[axis] = std::clamp(static_cast<int>(std::floor(at)), 0, cells[axis] - 1);
    direction[axis] = step[axis] > 0 ? 1 : -1;
    const bool moves = step[axis] != 0;
    width[axis] = moves ? 1 / std::abs(step[axis]) : std::numeric_limits<double>::infinity();
    next[axis] = moves ? (cell[axis] + (step[axis] > 0 ? 1 : 0) - start[axis]) / step[axis]
                       : std::numeric_limits<double>::infinity();
  }
  double at = enter;
  while (true)
  {
    if (IsOccupied(cell[0], cell[1], cell[2])) return at;
    const auto axis = static_cast<std::size_t>(std::min_element(next.begin(), next.end()) - next.begin());
    at = next[axis];
    if (at > leave) return std::nullopt;
    cell[axis] += direction[axis];
    if (cell[axis] < 0 || cell[axis] >= cells[axis]) return std::nullopt;
    next[axis] += width[axis];
  }
}

std::vector<TerrainRectangle> VoxelTerrain::Section(double height) const
{
  std::vector<TerrainRectangle> section;
  const double layer = (height - low_.z()) / cell_;
  if (!(layer >= 0 && layer < nz_)) return section;
  const int z = static_cast<int>(layer);
  for (const CellRectangle& r : CoverCells(nx_, ny_, [&](int x, int y) { return IsOccupied(x, y, z); }))
    section.push_back({{low_.x() + r.first_x * cell_, low_.y() + r.first_y * cell_},
                       {low_.x() + (r.last_x + 1) * cell_, low_.y() + (r.last_y + 1) * cell_}});
  return section;
}

}  // namespace swarmanoid

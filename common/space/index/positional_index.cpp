#include "common/space/index/positional_index.h"

#include <algorithm>

#include "common/space/index/grid_index.h"
#include "common/space/index/octree_index.h"

namespace swarmanoid
{
namespace
{

// The number of layered cells for each point above which the oct-tree is faster (docs/architecture.md, "Cost of the
// space"). Each cell costs half a nanosecond in each update; a search in the oct-tree takes at least 400 ns more. With
// one search for every five moved points, both cost the same at about 170 cells.
constexpr double kMostLayeredCells = 128;

}  // namespace

std::optional<std::uint32_t> PositionalIndex::FindNearest(const Vector3& centre, double radius,
                                                          std::uint32_t excluded) const
{
  const PointArrays& points = Points();
  std::vector<std::uint32_t> found;
  // The search widens until it finds a point; then that search also contains the nearest point.
  for (double reach = std::min(Spacing(), radius);; reach = std::min(2 * reach, radius))
  {
    FindWithin(centre, reach, found);
    std::optional<std::uint32_t> nearest;
    double nearest_distance = std::numeric_limits<double>::infinity();
    for (const std::uint32_t i : found)
    {
      const double distance = (Vector3(points.x[i], points.y[i], points.z[i]) - centre).squaredNorm();
      if (i == excluded || distance >= nearest_distance) continue;
      nearest = i;
      nearest_distance = distance;
    }
    if (nearest || reach >= radius) return nearest;
    // All points were in reach, so only the excluded one exists.
    if (found.size() == points.Size()) return std::nullopt;
  }
}

std::unique_ptr<PositionalIndex> MakePositionalIndex(SpaceOptimization optimization, const Vector3& arena_size,
                                                     std::size_t expected_points)
{
  const double most_cells = std::max(4096.0, kMostLayeredCells * static_cast<double>(expected_points));
  const bool sparse = GridIndex::LayeredCells(arena_size, expected_points) > most_cells;
  switch (optimization)
  {
    case SpaceOptimization::k2D:
      return std::make_unique<GridIndex>(arena_size, expected_points, false);
    case SpaceOptimization::k3D:
      if (sparse) return std::make_unique<OctreeIndex>();
      return std::make_unique<GridIndex>(arena_size, expected_points, true);
    default:
      return std::make_unique<OctreeIndex>();
  }
}

}  // namespace swarmanoid

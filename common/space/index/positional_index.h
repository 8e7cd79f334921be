// PositionalIndex: finds the entities near a position without a test of all. There are several forms with equal
// results: a flat grid (2D), a layered grid (3D), an oct-tree (large, sparse or uneven 3D).
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "common/experiment/experiment.h"
#include "common/math/pose.h"

namespace swarmanoid
{

// The positions of n points, one array for each component, all of the same length.
struct PointArrays
{
  std::span<const double> x;
  std::span<const double> y;
  std::span<const double> z;

  std::size_t Size() const { return x.size(); }
};

class PositionalIndex
{
public:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  virtual ~PositionalIndex() = default;

  // Uses these positions; the arrays must stay valid until the next call. Points may be anywhere; a point with a NaN
  // coordinate is never found. The cost is O(n), in an oct-tree only for points that changed their leaf.
  virtual void Update(const PointArrays& points) = 0;

  // Finds the points whose distance to the centre is at most `radius` metres, ascending. `found` is cleared first.
  virtual void FindWithin(const Vector3& centre, double radius, std::vector<std::uint32_t>& found) const = 0;
  // Finds the points in a closed box, ascending. `found` is cleared first.
  virtual void FindInBox(const Vector3& low, const Vector3& high, std::vector<std::uint32_t>& found) const = 0;
  // Returns the nearest point within `radius` other than `excluded`, or nullopt if there is no such point. If several
  // are equally near, it is the one with the lowest number.
  std::optional<std::uint32_t> FindNearest(const Vector3& centre, double radius, std::uint32_t excluded = kNone) const;

  // Returns the kind of index, for benchmarks and tests.
  virtual const char* Name() const = 0;

protected:
  // Returns a first guess at the distance between neighbours, where the search for the nearest starts.
  virtual double Spacing() const = 0;
  virtual const PointArrays& Points() const = 0;
};

// Returns the index for an arena: as <arena optimization> says; 3D takes the oct-tree if a layered grid would be mostly
// empty.
std::unique_ptr<PositionalIndex> MakePositionalIndex(SpaceOptimization optimization, const Vector3& arena_size,
                                                     std::size_t expected_points);

}  // namespace swarmanoid

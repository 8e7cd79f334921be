// GridIndex: the grid forms of PositionalIndex, with points counting-sorted by cell. Points outside the arena are in
// border cells.
#pragma once

#include "common/math/cells.h"
#include "common/space/index/positional_index.h"

namespace swarmanoid
{

class GridIndex : public PositionalIndex
{
public:
  // `layered` makes cells in z too; otherwise each cell is a column.
  GridIndex(const Vector3& arena_size, std::size_t expected_points, bool layered);

  void Update(const PointArrays& points) override;
  void FindWithin(const Vector3& centre, double radius, std::vector<std::uint32_t>& found) const override;
  void FindInBox(const Vector3& low, const Vector3& high, std::vector<std::uint32_t>& found) const override;
  const char* Name() const override { return layered_ ? "layered grid" : "flat grid"; }

  // Returns the number of cells of a layered grid for these sizes.
  static double LayeredCells(const Vector3& arena_size, std::size_t expected_points);

protected:
  double Spacing() const override { return edge_; }
  const PointArrays& Points() const override { return points_; }

private:
  template <class Accept>
  void Collect(const Vector3& low, const Vector3& high, Accept accept, std::vector<std::uint32_t>& found) const;

  bool layered_;
  double edge_;  // m
  BoxCells cells_;
  PointArrays points_;
  CellSort sort_;
  std::vector<std::uint32_t> id_;  // sorted by cell, then ascending
  std::vector<double> x_, y_, z_;  // in the same order
};

}  // namespace swarmanoid

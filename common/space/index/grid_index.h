// The grid arrangements of PositionalIndex: points counting-sorted by cell. Points outside the arena stand in border
// cells.
#pragma once

#include "common/space/index/positional_index.h"

namespace swarmanoid
{

class GridIndex : public PositionalIndex
{
public:
  // layered: cells in z too; otherwise each cell is a column.
  GridIndex(const Vector3& arena_size, std::size_t expected_points, bool layered);

  void Update(const PointArrays& points) override;
  void FindWithin(const Vector3& centre, double radius, std::vector<std::uint32_t>& found) const override;
  void FindInBox(const Vector3& low, const Vector3& high, std::vector<std::uint32_t>& found) const override;
  const char* Name() const override { return layered_ ? "layered grid" : "flat grid"; }

  // Cells that a layered grid for these sizes would have.
  static double LayeredCells(const Vector3& arena_size, std::size_t expected_points);

protected:
  double Spacing() const override { return cell_m_; }
  const PointArrays& Points() const override { return points_; }

private:
  struct Range
  {
    std::size_t first, last;
  };

  static double CellSize(const Vector3& arena_size, std::size_t expected_points, bool layered);
  std::size_t CellOf(double coordinate, std::size_t count) const;
  Range CellsOf(double low, double high, std::size_t count) const;
  template <class Accept>
  void Collect(const Vector3& low, const Vector3& high, Accept accept, std::vector<std::uint32_t>& found) const;

  bool layered_;
  double cell_m_;
  std::size_t nx_, ny_, nz_;
  PointArrays points_;
  std::vector<std::uint32_t> start_;  // of each cell within the sorted arrays
  std::vector<std::uint32_t> cell_;   // of each point
  std::vector<std::uint32_t> id_;     // sorted by cell, then ascending
  std::vector<double> x_, y_, z_;     // sorted likewise
};

}  // namespace swarmanoid

// FloorField: an amount per m² on the floor, in square cells, that evaporates and diffuses (docs/floor_fields.md). It
// computes only tiles of cells that hold something, or border on such a tile. The bits of the values follow from the
// values before and the deposits in their order, not from the tiles. One thread at a time may use it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/experiment/experiment.h"
#include "common/math/zeroed_vector.h"

namespace swarmanoid
{

class FloorField
{
public:
  static constexpr std::size_t kTile = 16;  // cells along the edge of a tile
  // No cell holds more, so that sums stay finite.
  static constexpr float kMost = 1e30F;

  // Makes an empty field. `step_s`: the time of one Step. The configuration must outlive the field.
  FloorField(const FloorFieldConfiguration& configuration, double step_s);

  const FloorFieldConfiguration& GetConfiguration() const { return configuration_; }
  std::size_t Columns() const { return columns_; }
  std::size_t Rows() const { return rows_; }
  std::size_t Cells() const { return columns_ * rows_; }
  // Returns the values (1/m²) of a row of cells, from x = 0 on. Row 0 begins at y = 0.
  std::span<const float> Row(std::size_t row) const { return {&values_[PlaceOf(0, row)], columns_}; }
  // Returns the value (1/m²) of a cell: row · Columns() + column.
  float ValueOf(std::size_t cell) const { return values_[PlaceOf(cell % columns_, cell / columns_)]; }
  // Returns the value (1/m²) at a point (m), interpolated between the four nearest middles of cells. Points outside the
  // field have the value of the nearest point in it.
  double ValueAt(double x, double y) const;
  // Returns the derivative (1/m³) of that value along x and y, as its difference over one cell.
  Vector2 GradientAt(double x, double y) const;
  // Returns the cell that holds a point (m), or Cells() if the field has none.
  std::size_t CellAt(double x, double y) const;
  // Returns the largest value (1/m²).
  float Largest() const;
  // Returns the amount of the whole field: the integral over the floor.
  double Total() const;

  // Adds an amount to the cell that holds the point (m), at most so much that the value is from 0 to kMost. Points
  // outside the field get nothing.
  void Add(double x, double y, double amount);
  // Sets the value (1/m²) of a cell, from 0 to kMost.
  void Set(std::size_t cell, float value);
  void Clear();
  // Lets evaporation and diffusion act for the time of one step. Nothing flows over the border of the field.
  void Step();

  // Calls use(cell, values) for runs of cells of one row that are not 0, ascending.
  template <class Use>
  void VisitRuns(Use use) const
  {
    for (std::size_t row = 0; row < rows_; ++row)
    {
      if (!HoldsRow(row / kTile)) continue;
      const std::span<const float> values = Row(row);
      for (std::size_t first = 0, end = 0; first < columns_; first = end + 1)
      {
        while (first < columns_ && values[first] == 0) ++first;
        for (end = first; end < columns_ && values[end] != 0;) ++end;
        if (end > first) use(row * columns_ + first, values.subspan(first, end - first));
      }
    }
  }

private:
  // The values have a border of one cell on each side.
  std::size_t PlaceOf(std::size_t column, std::size_t row) const { return (row + 1) * stride_ + column + 1; }
  std::size_t TileOf(std::size_t column, std::size_t row) const { return row / kTile * tile_columns_ + column / kTile; }
  bool HoldsRow(std::size_t tile_row) const;
  std::size_t EndColumn(std::size_t tile_column) const { return std::min((tile_column + 1) * kTile, columns_); }
  std::size_t EndRow(std::size_t tile_row) const { return std::min((tile_row + 1) * kTile, rows_); }
  void Evaporate();
  void FindTiles();
  void FillBorder();
  void StepTiles(std::size_t tile_row, std::size_t first, std::size_t end);
  bool IsZero(const ZeroedVector<float>& values, std::size_t tile_column, std::size_t tile_row) const;
  void Zero(ZeroedVector<float>& values, std::size_t tile_column, std::size_t tile_row) const;

  const FloorFieldConfiguration& configuration_;
  std::size_t columns_, rows_, stride_, tile_columns_, tile_rows_;
  float flow_;   // the share of a difference that flows between two cells in a step: diffusion · step / cell²
  float stays_;  // the share that evaporation leaves in a step
  float least_;
  ZeroedVector<float> values_, next_;
  // By tile. Tiles that hold nothing are 0 in both arrays.
  std::vector<std::uint8_t> holds_, is_due_;
};

}  // namespace swarmanoid

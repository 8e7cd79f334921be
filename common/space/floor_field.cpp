// A step is one of the explicit scheme of the diffusion equation on a grid, forward in time and centred in space
// (Press et al., Numerical Recipes, third edition, 20.2), times the exponential of evaporation:
//
//   next = stays · (c + flow · ((left + right) + (below + above) − 4 c))
//
// It is stable and keeps values above 0 for flow ≤ 1/4, which the reader of experiments checks. Cells outside the
// border have the value of the cell inside, so nothing flows over it and the amount stays.
//
// Invariants: a tile whose `holds_` is 0 has only zeros, in both arrays; a cell that becomes more than 0 is in a tile
// that holds something or has a neighbour whose edge does, so the tiles that are computed change no bit.
#include "common/space/floor_field.h"

#include <algorithm>
#include <cmath>

#include "common/math/elementary.h"
#include "common/math/lanes.h"

namespace swarmanoid
{

FloorField::FloorField(const FloorFieldConfiguration& configuration, double step_s)
    : configuration_(configuration),
      columns_(configuration.columns),
      rows_(configuration.rows),
      stride_(columns_ + 2),
      tile_columns_((columns_ + kTile - 1) / kTile),
      tile_rows_((rows_ + kTile - 1) / kTile),
      flow_(static_cast<float>(configuration.diffusion_m2_per_s * step_s /
                               (configuration.cell_m * configuration.cell_m))),
      stays_(static_cast<float>(Exp(-configuration.evaporation_per_s * step_s))),
      least_(static_cast<float>(configuration.least)),
      values_(stride_ * (rows_ + 2)),
      next_(flow_ > 0 ? stride_ * (rows_ + 2) : 0),
      holds_(tile_columns_ * tile_rows_),
      is_due_(tile_columns_ * tile_rows_)
{
}

std::size_t FloorField::CellAt(double x, double y) const
{
  const double column = std::floor(x / configuration_.cell_m);
  const double row = std::floor(y / configuration_.cell_m);
  const bool is_inside =
      column >= 0 && row >= 0 && column < static_cast<double>(columns_) && row < static_cast<double>(rows_);
  return is_inside ? static_cast<std::size_t>(row) * columns_ + static_cast<std::size_t>(column) : Cells();
}

double FloorField::ValueAt(double x, double y) const
{
  // In cells, from the middle of the first one.
  const double u = std::clamp(x / configuration_.cell_m - 0.5, 0.0, static_cast<double>(columns_ - 1));
  const double v = std::clamp(y / configuration_.cell_m - 0.5, 0.0, static_cast<double>(rows_ - 1));
  const auto column = static_cast<std::size_t>(u);
  const auto row = static_cast<std::size_t>(v);
  const double right = u - static_cast<double>(column);
  const double above = v - static_cast<double>(row);
  const std::size_t next_column = std::min(column + 1, columns_ - 1);
  const std::size_t next_row = std::min(row + 1, rows_ - 1);
  const auto between = [&](std::size_t in_row)
  {
    const double left_value = values_[PlaceOf(column, in_row)];
    return left_value + right * (values_[PlaceOf(next_column, in_row)] - left_value);
  };
  const double below = between(row);
  return below + above * (between(next_row) - below);
}

Vector2 FloorField::GradientAt(double x, double y) const
{
  const double half = configuration_.cell_m / 2;
  return {(ValueAt(x + half, y) - ValueAt(x - half, y)) / configuration_.cell_m,
          (ValueAt(x, y + half) - ValueAt(x, y - half)) / configuration_.cell_m};
}

float FloorField::Largest() const
{
  float largest = 0;
  VisitRuns([&](std::size_t, std::span<const float> run)
            { largest = std::max(largest, *std::ranges::max_element(run)); });
  return largest;
}

double FloorField::Total() const
{
  double sum = 0;
  VisitRuns(
      [&](std::size_t, std::span<const float> run)
      {
        for (const float value : run) sum += value;
      });
  return sum * configuration_.cell_m * configuration_.cell_m;
}

void FloorField::Add(double x, double y, double amount)
{
  const std::size_t cell = CellAt(x, y);
  if (cell == Cells()) return;
  const double value = ValueOf(cell) + amount / (configuration_.cell_m * configuration_.cell_m);
  Set(cell, static_cast<float>(std::clamp(value, 0.0, static_cast<double>(kMost))));
}

void FloorField::Set(std::size_t cell, float value)
{
  const std::size_t column = cell % columns_;
  const std::size_t row = cell / columns_;
  values_[PlaceOf(column, row)] = value;
  if (value != 0) holds_[TileOf(column, row)] = 1;
}

void FloorField::Clear()
{
  for (std::size_t row = 0; row < tile_rows_; ++row)
    for (std::size_t column = 0; column < tile_columns_; ++column)
    {
      std::uint8_t& holds = holds_[row * tile_columns_ + column];
      if (holds == 0) continue;
      holds = 0;
      Zero(values_, column, row);
      if (!next_.empty()) Zero(next_, column, row);
    }
}

bool FloorField::HoldsRow(std::size_t tile_row) const
{
  const auto first = holds_.begin() + static_cast<std::ptrdiff_t>(tile_row * tile_columns_);
  return std::any_of(first, first + static_cast<std::ptrdiff_t>(tile_columns_),
                     [](std::uint8_t holds) { return holds != 0; });
}

bool FloorField::IsZero(const ZeroedVector<float>& values, std::size_t tile_column, std::size_t tile_row) const
{
  const std::size_t first = tile_column * kTile;
  const std::size_t count = EndColumn(tile_column) - first;
  float largest = 0;
  for (std::size_t row = tile_row * kTile; row < EndRow(tile_row); ++row)
  {
    const float* from = &values[PlaceOf(first, row)];
    if (count == kTile)
    {
      FloatLanes most = LoadLanes(from);
      for (std::size_t k = kLanes; k < kTile; k += kLanes) most = Maximum(most, LoadLanes(from + k));
      if (Highest(most) > 0) return false;
    }
    else
      for (std::size_t k = 0; k < count; ++k) largest = std::max(largest, from[k]);
  }
  return largest == 0;
}

void FloorField::Zero(ZeroedVector<float>& values, std::size_t tile_column, std::size_t tile_row) const
{
  const std::size_t first = tile_column * kTile;
  for (std::size_t row = tile_row * kTile; row < EndRow(tile_row); ++row)
    std::fill_n(&values[PlaceOf(first, row)], EndColumn(tile_column) - first, 0.0F);
}

void FloorField::Step()
{
  if (flow_ == 0) return Evaporate();
  FindTiles();
  FillBorder();
  for (std::size_t row = 0; row < tile_rows_; ++row)
    for (std::size_t first = 0, end = 0; first < tile_columns_; first = end + 1)
    {
      const std::uint8_t* due = &is_due_[row * tile_columns_];
      while (first < tile_columns_ && due[first] == 0) ++first;
      for (end = first; end < tile_columns_ && due[end] != 0;) ++end;
      if (end > first) StepTiles(row, first, end);
    }
  values_.swap(next_);
  for (std::size_t row = 0; row < tile_rows_; ++row)
    for (std::size_t column = 0; column < tile_columns_; ++column)
    {
      const std::size_t tile = row * tile_columns_ + column;
      if (is_due_[tile] == 0) continue;
      holds_[tile] = IsZero(values_, column, row) ? 0 : 1;
      if (holds_[tile] == 0) Zero(next_, column, row);
    }
}

void FloorField::Evaporate()
{
  for (std::size_t tile_row = 0; tile_row < tile_rows_; ++tile_row)
    for (std::size_t tile_column = 0; tile_column < tile_columns_; ++tile_column)
    {
      std::uint8_t& holds = holds_[tile_row * tile_columns_ + tile_column];
      if (holds == 0) continue;
      for (std::size_t row = tile_row * kTile; row < EndRow(tile_row); ++row)
      {
        float* const from = &values_[PlaceOf(0, row)];
        for (std::size_t column = tile_column * kTile; column < EndColumn(tile_column); ++column)
        {
          const float value = from[column] * stays_;
          from[column] = value < least_ ? 0 : value;
        }
      }
      holds = IsZero(values_, tile_column, tile_row) ? 0 : 1;
    }
}

// Finds the tiles to compute: those that hold something, and those beside an edge that does.
void FloorField::FindTiles()
{
  std::copy(holds_.begin(), holds_.end(), is_due_.begin());
  const auto edge = [&](std::size_t column, std::size_t row, std::size_t step, std::size_t count)
  {
    for (std::size_t place = PlaceOf(column, row); count > 0; --count, place += step)
      if (values_[place] != 0) return true;
    return false;
  };
  for (std::size_t row = 0; row < tile_rows_; ++row)
    for (std::size_t column = 0; column < tile_columns_; ++column)
    {
      const std::size_t tile = row * tile_columns_ + column;
      if (holds_[tile] == 0) continue;
      const std::size_t left = column * kTile, right = EndColumn(column);
      const std::size_t bottom = row * kTile, top = EndRow(row);
      const auto mark =
          [&](std::size_t other, std::size_t at_column, std::size_t at_row, std::size_t step, std::size_t count)
      {
        if (is_due_[other] == 0 && edge(at_column, at_row, step, count)) is_due_[other] = 1;
      };
      if (column > 0) mark(tile - 1, left, bottom, stride_, top - bottom);
      if (column + 1 < tile_columns_) mark(tile + 1, right - 1, bottom, stride_, top - bottom);
      if (row > 0) mark(tile - tile_columns_, left, bottom, 1, right - left);
      if (row + 1 < tile_rows_) mark(tile + tile_columns_, left, top - 1, 1, right - left);
    }
}

// Gives the cells outside the border the values of those inside, beside the tiles to compute.
void FloorField::FillBorder()
{
  for (std::size_t row = 0; row < tile_rows_; ++row)
  {
    const std::uint8_t* due = &is_due_[row * tile_columns_];
    for (std::size_t y = row * kTile; y < EndRow(row); ++y)
    {
      if (due[0] != 0) values_[PlaceOf(0, y) - 1] = values_[PlaceOf(0, y)];
      if (due[tile_columns_ - 1] != 0) values_[PlaceOf(columns_, y)] = values_[PlaceOf(columns_ - 1, y)];
    }
  }
  for (std::size_t column = 0; column < tile_columns_; ++column)
  {
    const std::size_t first = column * kTile;
    const std::size_t count = EndColumn(column) - first;
    if (is_due_[column] != 0) std::copy_n(&values_[PlaceOf(first, 0)], count, &values_[PlaceOf(first, 0) - stride_]);
    if (is_due_[(tile_rows_ - 1) * tile_columns_ + column] != 0)
      std::copy_n(&values_[PlaceOf(first, rows_ - 1)], count, &values_[PlaceOf(first, rows_)]);
  }
}

// Computes the tiles from `first` to the one before `end` in a row of tiles.
void FloorField::StepTiles(std::size_t tile_row, std::size_t first, std::size_t end)
{
  const std::size_t left = first * kTile;
  const std::size_t count = EndColumn(end - 1) - left;
  const FloatLanes flow = Everywhere(flow_), stays = Everywhere(stays_), least = Everywhere(least_);
  for (std::size_t row = tile_row * kTile; row < EndRow(tile_row); ++row)
  {
    const float* const here = &values_[PlaceOf(left, row)];
    const float* const below = here - stride_;
    const float* const above = here + stride_;
    float* const to = &next_[PlaceOf(left, row)];
    std::size_t k = 0;
    for (; k + kLanes <= count; k += kLanes)
    {
      const FloatLanes c = LoadLanes(here + k);
      const FloatLanes around =
          (LoadLanes(here + k - 1) + LoadLanes(here + k + 1)) + (LoadLanes(below + k) + LoadLanes(above + k));
      const FloatLanes value = stays * (c + flow * (around - 4.0F * c));
      StoreLanes(value < least ? FloatLanes{} : value, to + k);
    }
    for (; k < count; ++k)
    {
      const float c = here[k];
      const float around = (here[k - 1] + here[k + 1]) + (below[k] + above[k]);
      const float value = stays_ * (c + flow_ * (around - 4.0F * c));
      to[k] = value < least_ ? 0 : value;
    }
  }
}

}  // namespace swarmanoid

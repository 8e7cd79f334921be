#include "common/space/drawn_fields.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "common/space/space.h"

namespace swarmanoid
{
namespace
{

constexpr double kMostBlocks = 128;  // along each edge, for all fields together
constexpr int kShades = 8;
constexpr double kMostOpacity = 0.8;
constexpr double kHeight_m = 0.002;  // above the floor

// Returns the largest value of each block of `step` by `step` cells, row after row.
std::vector<float> BlocksOf(const FloorField& field, std::size_t step, std::size_t columns, std::size_t rows)
{
  std::vector<float> blocks(columns * rows);
  field.VisitRuns(
      [&](std::size_t cell, std::span<const float> run)
      {
        float* const row = &blocks[cell / field.Columns() / step * columns];
        std::size_t column = cell % field.Columns();
        for (const float value : run)
        {
          float& block = row[column++ / step];
          block = std::max(block, value);
        }
      });
  return blocks;
}

void DrawField(const FloorField& field, std::size_t most_blocks, Drawing& drawing)
{
  const FloorFieldConfiguration& configuration = field.GetConfiguration();
  const std::size_t step = (std::max(field.Columns(), field.Rows()) + most_blocks - 1) / most_blocks;
  const std::size_t columns = (field.Columns() + step - 1) / step;
  const std::size_t rows = (field.Rows() + step - 1) / step;
  const std::vector<float> blocks = BlocksOf(field, step, columns, rows);
  const double full = configuration.full > 0 ? configuration.full : *std::ranges::max_element(blocks);
  if (full <= 0) return;
  const auto shade = [&](float value)
  { return static_cast<int>(std::lround(kShades * std::sqrt(std::min(1.0, value / full)))); };
  const auto x = [&](std::size_t column)
  { return static_cast<double>(std::min(column * step, field.Columns())) * configuration.cell_m; };
  const auto y = [&](std::size_t row)
  { return static_cast<double>(std::min(row * step, field.Rows())) * configuration.cell_m; };
  for (std::size_t row = 0; row < rows; ++row)
    for (std::size_t first = 0, end = 0; first < columns; first = end)
    {
      const int shown = shade(blocks[row * columns + first]);
      for (end = first + 1; end < columns && shade(blocks[row * columns + end]) == shown;) ++end;
      if (shown == 0) continue;
      const std::array<Vector3, 4> corners{Vector3(x(first), y(row), kHeight_m), Vector3(x(end), y(row), kHeight_m),
                                           Vector3(x(end), y(row + 1), kHeight_m),
                                           Vector3(x(first), y(row + 1), kHeight_m)};
      drawing.Polygon(corners, {configuration.colour, kMostOpacity * shown / kShades, 1});
    }
}

}  // namespace

void DrawFields(const CSwarmanoidSpace& space, Drawing& drawing)
{
  const FloorFields& fields = space.Fields();
  if (fields.empty()) return;
  const auto most = static_cast<std::size_t>(kMostBlocks / std::sqrt(static_cast<double>(fields.size())));
  for (std::size_t k = 0; k < fields.size(); ++k) DrawField(fields[k], std::max<std::size_t>(most, 1), drawing);
}

}  // namespace swarmanoid

// The ground is a surface through the heights of a picture. Each cell between four pixels is split into two triangles,
// so that the surface has no gaps and its height is linear in each triangle. The height above the ground along a
// segment is then linear between the crossings of grid lines and diagonals. The first hit is where it falls to zero,
// without a search by small steps.
//
// Invariant: HeightAt and SegmentHit use the same diagonals.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "common/space/terrain/png_picture.h"
#include "common/space/terrain/rectangles.h"
#include "common/space/terrain/terrain.h"

namespace swarmanoid
{

HeightTerrain::HeightTerrain(const std::string& path, double size_x, double size_y, double height)
    : size_x_(size_x), size_y_(size_y)
{
  const GreyPicture picture = ReadGreyPicture(path);
  columns_ = picture.columns;
  rows_ = picture.rows;
  if (columns_ < 2 || rows_ < 2) throw std::runtime_error("the PNG '" + path + "' must have at least 2 by 2 pixels");
  heights_.resize(picture.values.size());
  const auto columns = static_cast<std::size_t>(columns_);
  for (std::size_t row = 0; row < static_cast<std::size_t>(rows_); ++row)
    for (std::size_t column = 0; column < columns; ++column)
      heights_[row * columns + column] =
          height * picture.values[(static_cast<std::size_t>(rows_) - 1 - row) * columns + column];
  FindExtremes();
}

HeightTerrain::HeightTerrain(std::vector<double> heights, int columns, int rows, double size_x, double size_y)
    : heights_(std::move(heights)), columns_(columns), rows_(rows), size_x_(size_x), size_y_(size_y)
{
  if (columns < 2 || rows < 2 || heights_.size() != static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows))
    throw std::runtime_error("a height field needs at least 2 by 2 heights, columns times rows of them");
  FindExtremes();
}

void HeightTerrain::FindExtremes()
{
  const auto [low, high] = std::minmax_element(heights_.begin(), heights_.end());
  lowest_ = *low;
  highest_ = *high;
}

std::optional<double> HeightTerrain::HeightAt(double x, double y) const
{
  const double u = x / size_x_ * (columns_ - 1);
  const double v = y / size_y_ * (rows_ - 1);
  if (!(u >= 0 && v >= 0 && u <= columns_ - 1 && v <= rows_ - 1)) return std::nullopt;
  const int column = std::min(static_cast<int>(u), columns_ - 2);
  const int row = std::min(static_cast<int>(v), rows_ - 2);
  const double a = u - column;
  const double b = v - row;
  const double h00 = Height(column, row);
  const double h10 = Height(column + 1, row);
  const double h01 = Height(column, row + 1);
  const double h11 = Height(column + 1, row + 1);
  // The diagonal goes from (1, 0) to (0, 1).
  if (a + b <= 1) return h00 + a * (h10 - h00) + b * (h01 - h00);
  return h11 + (1 - a) * (h01 - h11) + (1 - b) * (h10 - h11);
}

bool HeightTerrain::IsSolid(const Vector3& point) const
{
  const auto height = HeightAt(point.x(), point.y());
  return height && point.z() <= *height;
}

std::optional<double> HeightTerrain::GroundBelow(const Vector3& point) const
{
  const auto height = HeightAt(point.x(), point.y());
  return height ? std::optional(std::min(*height, point.z())) : std::nullopt;
}

std::optional<double> HeightTerrain::SegmentHit(const Vector3& from, const Vector3& to) const
{
  // The segment is first cut to its part above or below the field. The height over the field is piecewise linear: its
  // kinks are where the segment crosses a line of the grid or a diagonal.
  const double u0 = from.x() / size_x_ * (columns_ - 1);
  const double v0 = from.y() / size_y_ * (rows_ - 1);
  const double du = (to.x() - from.x()) / size_x_ * (columns_ - 1);
  const double dv = (to.y() - from.y()) / size_y_ * (rows_ - 1);
  double enter = 0;
  double leave = 1;
  const auto clip = [&](double start, double step, double last)
  {
    if (step == 0) return start >= 0 && start <= last;
    const double a = -start / step;
    const double b = (last - start) / step;
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
    return true;
  };
  if (!clip(u0, du, columns_ - 1) || !clip(v0, dv, rows_ - 1) || !(enter <= leave)) return std::nullopt;

  std::vector<double> kinks{enter, leave};
  const auto add_crossings = [&](double start, double step)
  {
    if (step == 0) return;
    const double first = start + enter * step;
    const double last = start + leave * step;
    for (double line = std::ceil(std::min(first, last)); line <= std::max(first, last); ++line)
      kinks.push_back(std::clamp((line - start) / step, enter, leave));
  };
  add_crossings(u0, du);
  add_crossings(v0, dv);
  add_crossings(u0 + v0, du + dv);
  std::sort(kinks.begin(), kinks.end());

  // The clearance is linear between kinks, so the segment enters where it falls to zero.
  double before_at = enter;
  double before = 0;
  bool first = true;
  for (const double at : kinks)
  {
    const Vector3 point = from + at * (to - from);
    const double x = std::clamp(point.x(), 0.0, size_x_);
    const double y = std::clamp(point.y(), 0.0, size_y_);
    const double clearance = point.z() - HeightAt(x, y).value_or(lowest_);
    if (clearance <= 0) return first ? at : before_at + (at - before_at) * before / (before - clearance);
    before_at = at;
    before = clearance;
    first = false;
  }
  return std::nullopt;
}

std::vector<TerrainRectangle> HeightTerrain::Section(double height) const
{
  // A cell is solid if any of its corners reaches the height.
  const auto reaches = [&](int x, int y) {
    return std::max({Height(x, y), Height(x + 1, y), Height(x, y + 1), Height(x + 1, y + 1)}) > height;
  };
  const double cell_x = size_x_ / (columns_ - 1);
  const double cell_y = size_y_ / (rows_ - 1);
  std::vector<TerrainRectangle> section;
  for (const CellRectangle& r : CoverCells(columns_ - 1, rows_ - 1, reaches))
    section.push_back({{r.first_x * cell_x, r.first_y * cell_y}, {(r.last_x + 1) * cell_x, (r.last_y + 1) * cell_y}});
  return section;
}

}  // namespace swarmanoid

// Covers a bitmap with few rectangles: runs along x, with equal runs of neighbouring rows joined.
#pragma once

#include <functional>
#include <vector>

namespace swarmanoid
{

// The cells first_x..last_x, first_y..last_y inclusive.
struct CellRectangle
{
  int first_x, first_y, last_x, last_y;
};

std::vector<CellRectangle> CoverCells(int columns, int rows, const std::function<bool(int x, int y)>& is_set);

}  // namespace swarmanoid

// Two-dimensional engines need the solid cells of a terrain as few large obstacles. The fewest rectangles are hard to
// find. One pass over the rows joins a run of cells with the run above it if both begin and end at the same columns.
//
// Invariants: each set cell is in exactly one rectangle, and no other cell is in any. The order depends only on the
// cells.
#include "common/space/terrain/rectangles.h"

namespace swarmanoid
{

std::vector<CellRectangle> CoverCells(int columns, int rows, const std::function<bool(int x, int y)>& is_set)
{
  std::vector<CellRectangle> rectangles;
  std::vector<std::size_t> open;  // rectangles that reach the row before
  for (int y = 0; y < rows; ++y)
  {
    std::vector<std::size_t> still_open;
    for (int x = 0; x < columns; ++x)
    {
      if (!is_set(x, y)) continue;
      const int first = x;
      while (x + 1 < columns && is_set(x + 1, y)) ++x;
      bool joined = false;
      for (const std::size_t k : open)
      {
        CellRectangle& above = rectangles[k];
        if (above.first_x != first || above.last_x != x) continue;
        above.last_y = y;
        still_open.push_back(k);
        joined = true;
      }
      if (joined) continue;
      still_open.push_back(rectangles.size());
      rectangles.push_back({first, y, x, y});
    }
    open = std::move(still_open);
  }
  return rectangles;
}

}  // namespace swarmanoid

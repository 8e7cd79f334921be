// The spacing of the floor's lines, with one rule for all renderers. visualiser/web/page/src/view/look.js has the same
// rule for the page.
#pragma once

#include <algorithm>
#include <array>

#include "common/math/pose.h"

namespace swarmanoid
{

inline constexpr std::array kFloorSpacings{0.1, 0.25, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0};  // m
inline constexpr int kMostFloorCells = 14;  // along the longer side of the arena

// Returns the metres between the lines of the floor: about ten cells across an arena.
inline double FloorSpacing(const Vector3& arena)
{
  const double side = std::max(arena.x(), arena.y());
  for (const double spacing : kFloorSpacings)
    if (side <= kMostFloorCells * spacing) return spacing;
  return kFloorSpacings.back();
}

}  // namespace swarmanoid

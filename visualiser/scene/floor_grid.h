// The lines of the floor: one rule for all renderers; the page has the same in visualiser/web/page/src/view/look.js.
#pragma once

#include <algorithm>
#include <array>

#include "common/math/pose.h"

namespace swarmanoid
{

inline constexpr std::array kFloorSpacings{0.1, 0.25, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0};  // m
inline constexpr int kMostFloorCells = 14;  // along the longer side of the arena

// Metres between the lines of the floor: about ten cells across an arena.
inline double FloorSpacing(const Vector3& arena)
{
  const double side = std::max(arena.x(), arena.y());
  for (const double spacing : kFloorSpacings)
    if (side <= kMostFloorCells * spacing) return spacing;
  return kFloorSpacings.back();
}

}  // namespace swarmanoid

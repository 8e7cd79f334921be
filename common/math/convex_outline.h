// The convex hull of points in a plane, for the engines on planes and for drawing plans.
#pragma once

#include <vector>

#include "common/math/pose.h"

namespace swarmanoid
{

// Returns the hull counter-clockwise from the leftmost point, by A. M. Andrew's monotone chain (1979). Points on an
// edge, to a square micrometre, are dropped. Empty for less than two points.
std::vector<Vector2> ConvexOutline(std::vector<Vector2> points);

}  // namespace swarmanoid

// The convex hull of points of a plane: what the engines of planes cut, and what plans draw.
#pragma once

#include <vector>

#include "common/math/pose.h"

namespace swarmanoid
{

// Counter-clockwise from the point that is farthest to the left, by A. M. Andrew's monotone chain (1979); points on an
// edge, to a square micrometre, are dropped. Empty for less than two points.
std::vector<Vector2> ConvexOutline(std::vector<Vector2> points);

}  // namespace swarmanoid

// The hull is built by the monotone chain of A. M. Andrew, "Another efficient algorithm for convex hulls in two
// dimensions", Information Processing Letters 9(5), 1979: the points are sorted, and the lower and the upper chain drop
// each corner that does not turn left. It takes O(n log n) steps.
//
// Invariant: the corners go counter-clockwise, and none lies on the line between its neighbours.
#include "common/math/convex_outline.h"

#include <algorithm>

namespace swarmanoid
{
namespace
{

double Cross(const Vector2& origin, const Vector2& a, const Vector2& b)
{
  return (a.x() - origin.x()) * (b.y() - origin.y()) - (a.y() - origin.y()) * (b.x() - origin.x());
}

}  // namespace

std::vector<Vector2> ConvexOutline(std::vector<Vector2> points)
{
  if (points.empty()) return {};
  std::sort(points.begin(), points.end(),
            [](const Vector2& a, const Vector2& b) { return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y()); });
  std::vector<Vector2> hull;
  const auto add = [&](const Vector2& point, std::size_t fixed)
  {
    while (hull.size() >= fixed + 2 && Cross(hull[hull.size() - 2], hull.back(), point) <= 1e-12) hull.pop_back();
    hull.push_back(point);
  };
  for (const Vector2& point : points) add(point, 0);
  const std::size_t lower = hull.size() - 1;
  for (auto point = points.rbegin() + 1; point != points.rend(); ++point) add(*point, lower);
  hull.pop_back();
  return hull;
}

}  // namespace swarmanoid

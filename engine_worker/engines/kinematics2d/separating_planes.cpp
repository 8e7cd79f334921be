// Problem: two convex parts want to move. Find a plane between them where the step begins, and bound how much nearer
// each motion brings them along its normal n, in proportion to the part t (0 to 1) of the motion that is done.
//
// Method: a way d brings its part t d . n nearer: exact. For a turn by w about the axis, a point p from the axis comes
// f(t) = n . R(t w) p - n . p nearer. While n . p stays positive, f is concave and f(t) <= t w (n . p'), where p' is p
// turned by 90 degrees. Otherwise (t w)^2 |p| / 2 is added, and t^2 <= t. For a polygon the corner that comes furthest
// counts. That is a maximum of lines in t, convex, so it lies below the line to its value at t = 1.
//
// Any direction along which the parts are apart will do. The shortest distance comes first. If that limits a motion,
// the direction at the nearest point of their ways past each other is tried, and the normals of the faces.
//
// Invariant: if the sum of rate * t over the approaches is at most the gap, the parts do not overlap deeper than
// allowed, whatever parts of their motions are done. Source: docs/engines.md, "Crowds: how".
#include "engine_worker/engines/kinematics2d/separating_planes.h"

#include <algorithm>
#include <cmath>

namespace swarmanoid::kinematics2d
{
namespace
{

struct Extent
{
  double at_start;
  double turn_rate;
};

// Returns how far a part reaches along (x, y) from its body, and how much further, at most, for each part of its turn.
Extent ExtentAlong(const MovingPart& side, double x, double y)
{
  double at_start = -1e300;
  double at_end = -1e300;
  const auto consider = [&](double local_x, double local_y)
  {
    const double own_x = side.cos * local_x - side.sin * local_y;
    const double own_y = side.sin * local_x + side.cos * local_y;
    const double px = side.from_x + own_x;
    const double py = side.from_y + own_y;
    const double along = own_x * x + own_y * y;
    const double bend = 0.5 * side.turn * side.turn;
    const double further = side.turn * (px * y - py * x);
    const double axial = px * x + py * y;
    const bool stays = bend < 1 && axial > 0 && axial + further - bend * axial > 0;
    at_start = std::max(at_start, along);
    at_end = std::max(at_end, along + further + (stays ? 0 : bend * std::sqrt(px * px + py * py)));
  };
  const CollisionModel& model = *side.model;
  if (const Polygon* const polygon = side.OwnPolygon())
  {
    for (int k = 0; k < polygon->count; ++k) consider(polygon->x[k], polygon->y[k]);
    return {at_start, at_end - at_start};
  }
  consider(model.part_x[side.part], model.part_y[side.part]);
  return {at_start + model.part_radius[side.part], at_end - at_start};
}

// Returns the plane that leaves most room, among `shortest`, along (x, y), and planes with other normals.
SeparatingPlane BestPlane(const MovingPart& first, const MovingPart& second, double x, double y,
                          const SeparatingPlane& shortest, double allowed)
{
  SeparatingPlane best = shortest;
  const auto consider = [&](double to_x, double to_y)
  {
    const SeparatingPlane plane = PlaneAlong(first, second, to_x, to_y, allowed);
    if (plane.gap >= 0 && plane.left > best.left) best = plane;
  };
  // The normal at the nearest point of the way of (from_x, from_y) past the other part.
  const double way_x = first.way_x + first.centre_way_x - second.way_x - second.centre_way_x;
  const double way_y = first.way_y + first.centre_way_y - second.way_y - second.centre_way_y;
  const double squared = way_x * way_x + way_y * way_y;
  const auto consider_nearest = [&](double from_x, double from_y)
  {
    const double at = squared > 0 ? std::clamp(-(from_x * way_x + from_y * way_y) / squared, 0.0, 1.0) : 0;
    consider(from_x + at * way_x, from_y + at * way_y);
  };

  if (first.OwnPolygon() == nullptr && second.OwnPolygon() == nullptr) consider_nearest(x, y);
  const auto consider_faces = [&](const MovingPart& side, const MovingPart& other, double sign)
  {
    const Polygon* const polygon = side.OwnPolygon();
    for (int n = 0; polygon != nullptr && n < polygon->count; ++n)
    {
      consider(sign * (side.cos * polygon->nx[n] - side.sin * polygon->ny[n]),
               sign * (side.sin * polygon->nx[n] + side.cos * polygon->ny[n]));
      if (other.OwnPolygon() != nullptr) continue;
      // The axis points from the corner to the middle of the circle, or back.
      const double corner_x = side.x + side.cos * polygon->x[n] - side.sin * polygon->y[n];
      const double corner_y = side.y + side.sin * polygon->x[n] + side.cos * polygon->y[n];
      consider_nearest(sign * (other.centre_x - corner_x), sign * (other.centre_y - corner_y));
    }
  };
  consider_faces(first, second, -1);
  consider_faces(second, first, 1);
  return best;
}

}  // namespace

SeparatingPlane PlaneAlong(const MovingPart& first, const MovingPart& second, double x, double y, double allowed)
{
  const double length = std::sqrt(x * x + y * y);
  x = length > 0 ? x / length : 1;
  y = length > 0 ? y / length : 0;
  const Extent a = ExtentAlong(first, -x, -y);
  const Extent b = ExtentAlong(second, x, y);
  SeparatingPlane plane{(first.x - second.x) * x + (first.y - second.y) * y - a.at_start - b.at_start + allowed, 0, {}};
  if (first.can_move)
  {
    plane.approaches[0] = {WayMotion(first.leader), -first.way_x * x - first.way_y * y};
    plane.approaches[1] = {TurnMotion(first.leader), a.turn_rate};
  }
  if (second.can_move)
  {
    plane.approaches[2] = {WayMotion(second.leader), second.way_x * x + second.way_y * y};
    plane.approaches[3] = {TurnMotion(second.leader), b.turn_rate};
  }
  plane.left = plane.gap;
  for (const Approach& approach : plane.approaches) plane.left -= approach.rate;
  return plane;
}

MovingPart PartAt(const Placed& body, std::size_t part)
{
  const CollisionModel& model = *body.model;
  MovingPart side{.model = &model, .part = part, .x = body.x, .y = body.y, .cos = body.cos, .sin = body.sin};
  if (model.on_turret[part])
  {
    side.cos = body.cos * body.turret_cos - body.sin * body.turret_sin;
    side.sin = body.sin * body.turret_cos + body.cos * body.turret_sin;
  }
  side.centre_x = side.x + side.cos * model.part_x[part] - side.sin * model.part_y[part];
  side.centre_y = side.y + side.sin * model.part_x[part] + side.cos * model.part_y[part];
  return side;
}

SeparatingPlane PlaneBetween(const MovingPart& first, const MovingPart& second, const Touch& touch, double allowed)
{
  double x = touch.x;
  double y = touch.y;
  if (!touch.face)
  {
    x += first.x - second.x;
    y += first.y - second.y;
    // Two centres at one place part as they want to go.
    if (x == 0 && y == 0)
    {
      x = first.way_x - second.way_x;
      y = first.way_y - second.way_y;
    }
  }
  const SeparatingPlane plane = PlaneAlong(first, second, x, y, allowed);
  return plane.left < 0 ? BestPlane(first, second, x, y, plane, allowed) : plane;
}

}  // namespace swarmanoid::kinematics2d

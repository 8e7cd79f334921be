// Problem: find where two parts of bodies meet, also shortly before they do, so that the solver can keep them from
// overlapping.
//
// Method: two discs meet on the line of their middles. A disc meets a polygon at the edge with the largest distance, or
// at the nearer end of it. Box2D finds the points of two polygons (separating axes, then the incident edge clipped to
// the sides of the reference edge) in the frame of the first one, with a skin that is as thick as the margin. It clips
// wider by that, so that points beyond the ends of the reference edge are moved to its ends, and left out if all are
// beyond the same end.
#include "engine_worker/engines/dynamics2d/manifold.h"

#include <box2d/b2_collision.h>
#include <box2d/b2_polygon_shape.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace swarmanoid::dynamics2d
{
namespace
{

double Square(double x) { return x * x; }

Manifold DiscOnPolygon(const PartShape& polygon, const BodyPlace& at, const BodyPlace& disc, double radius,
                       double margin)
{
  Manifold manifold;
  const double dx = disc.x - at.x;
  const double dy = disc.y - at.y;
  const double x = at.cos * dx + at.sin * dy;
  const double y = at.cos * dy - at.sin * dx;
  const double reach = radius + polygon.radius + margin;
  int edge = 0;
  double distance = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < polygon.count; ++i)
  {
    const Corner& corner = polygon.corners[i];
    const double outside = corner.normal_x * (x - corner.x) + corner.normal_y * (y - corner.y);
    if (outside > reach) return manifold;
    if (outside <= distance) continue;
    distance = outside;
    edge = i;
  }
  const Corner& first = polygon.corners[edge];
  const Corner& second = polygon.corners[edge + 1 < polygon.count ? edge + 1 : 0];
  manifold.points = 1;
  manifold.x[0] = manifold.y[0] = 0;
  manifold.normal_x = first.normal_x;
  manifold.normal_y = first.normal_y;
  manifold.plane_x = first.x;
  manifold.plane_y = first.y;
  if (distance <= 0) return manifold;  // the middle of the disc is inside
  const double edge_x = second.x - first.x;
  const double edge_y = second.y - first.y;
  const bool is_before = (x - first.x) * edge_x + (y - first.y) * edge_y <= 0;
  const bool is_after = (x - second.x) * edge_x + (y - second.y) * edge_y >= 0;
  if (!is_before && !is_after) return manifold;
  const Corner& corner = is_before ? first : second;
  const double away = std::sqrt(Square(x - corner.x) + Square(y - corner.y));
  if (away > reach)
  {
    manifold.points = 0;
    return manifold;
  }
  if (away <= 0) return manifold;
  manifold.normal_x = (x - corner.x) / away;
  manifold.normal_y = (y - corner.y) / away;
  manifold.plane_x = corner.x;
  manifold.plane_y = corner.y;
  return manifold;
}

// Compares the circle around `other` with the edges of `polygon`.
bool AreFar(const PartShape& polygon, const BodyPlace& at, const PartShape& other, const BodyPlace& at_other,
            double margin)
{
  return IsBeyondEdge(polygon, at, at_other.x + at_other.cos * other.x - at_other.sin * other.y,
                      at_other.y + at_other.sin * other.x + at_other.cos * other.y,
                      other.reach + polygon.radius + margin);
}

b2PolygonShape ShapeOf(const PartShape& part, double margin)
{
  b2PolygonShape shape;
  shape.m_count = part.count;
  shape.m_radius = static_cast<float>(part.radius + margin / 2);
  for (int i = 0; i < part.count; ++i)
  {
    const Corner& corner = part.corners[i];
    shape.m_vertices[i].Set(static_cast<float>(corner.x), static_cast<float>(corner.y));
    shape.m_normals[i].Set(static_cast<float>(corner.normal_x), static_cast<float>(corner.normal_y));
  }
  return shape;
}

// Moves the points to the ends of the edge with the plane, in whose frame `to_x` and `to_y` are.
void KeepOnEdge(const PartShape& reference, Manifold& manifold, std::array<double, 2>& to_x,
                std::array<double, 2>& to_y)
{
  int edge = 0;
  double most = -2;
  for (int i = 0; i < reference.count; ++i)
  {
    const Corner& corner = reference.corners[i];
    const double along = corner.normal_x * manifold.normal_x + corner.normal_y * manifold.normal_y;
    if (along <= most) continue;
    most = along;
    edge = i;
  }
  const Corner& first = reference.corners[edge];
  const Corner& second = reference.corners[edge + 1 < reference.count ? edge + 1 : 0];
  const double along_x = -manifold.normal_y;
  const double along_y = manifold.normal_x;
  const double begin = along_x * first.x + along_y * first.y - kPolygonSkin;
  const double end = along_x * second.x + along_y * second.y + kPolygonSkin;
  int before = 0;
  int after = 0;
  for (int k = 0; k < manifold.points; ++k)
  {
    const auto i = static_cast<std::size_t>(k);
    const double along = along_x * to_x[i] + along_y * to_y[i];
    before += along < begin ? 1 : 0;
    after += along > end ? 1 : 0;
    const double moved = std::clamp(along, begin, end) - along;
    to_x[i] += moved * along_x;
    to_y[i] += moved * along_y;
  }
  if (before == manifold.points || after == manifold.points) manifold.points = 0;
}

Manifold PolygonOnPolygon(const PartShape& a, const BodyPlace& at_a, const PartShape& b, const BodyPlace& at_b,
                          double margin)
{
  if (AreFar(a, at_a, b, at_b, margin) || AreFar(b, at_b, a, at_a, margin)) return {};
  const double dx = at_b.x - at_a.x;
  const double dy = at_b.y - at_a.y;
  const BodyPlace relative{at_a.cos * dx + at_a.sin * dy, at_a.cos * dy - at_a.sin * dx,
                           at_a.cos * at_b.cos + at_a.sin * at_b.sin, at_a.cos * at_b.sin - at_a.sin * at_b.cos};
  b2Transform origin, place;
  origin.SetIdentity();
  place.p.Set(static_cast<float>(relative.x), static_cast<float>(relative.y));
  place.q.c = static_cast<float>(relative.cos);
  place.q.s = static_cast<float>(relative.sin);
  const b2PolygonShape shape_a = ShapeOf(a, margin);
  const b2PolygonShape shape_b = ShapeOf(b, margin);
  b2Manifold found;
  found.pointCount = 0;
  b2CollidePolygons(&found, &shape_a, origin, &shape_b, place);
  Manifold manifold;
  manifold.points = found.pointCount;
  if (manifold.points == 0) return manifold;
  manifold.is_plane_of_b = found.type == b2Manifold::e_faceB;
  manifold.normal_x = found.localNormal.x;
  manifold.normal_y = found.localNormal.y;
  manifold.plane_x = found.localPoint.x;
  manifold.plane_y = found.localPoint.y;
  std::array<double, 2> to_x{}, to_y{};  // the points in the frame with the plane
  const auto points = static_cast<std::size_t>(manifold.points);
  for (std::size_t i = 0; i < points; ++i)
  {
    const double x = found.points[i].localPoint.x;
    const double y = found.points[i].localPoint.y;
    manifold.features[i] = found.points[i].id.key;
    to_x[i] = manifold.is_plane_of_b ? relative.cos * (x - relative.x) + relative.sin * (y - relative.y)
                                     : relative.x + relative.cos * x - relative.sin * y;
    to_y[i] = manifold.is_plane_of_b ? relative.cos * (y - relative.y) - relative.sin * (x - relative.x)
                                     : relative.y + relative.sin * x + relative.cos * y;
  }
  KeepOnEdge(manifold.is_plane_of_b ? b : a, manifold, to_x, to_y);
  for (std::size_t i = 0; i < points; ++i)
  {
    manifold.x[i] = manifold.is_plane_of_b
                        ? relative.x + relative.cos * to_x[i] - relative.sin * to_y[i]
                        : relative.cos * (to_x[i] - relative.x) + relative.sin * (to_y[i] - relative.y);
    manifold.y[i] = manifold.is_plane_of_b
                        ? relative.y + relative.sin * to_x[i] + relative.cos * to_y[i]
                        : relative.cos * (to_y[i] - relative.y) - relative.sin * (to_x[i] - relative.x);
  }
  return manifold;
}

}  // namespace

bool IsBeyondEdge(const PartShape& polygon, const BodyPlace& at, double x, double y, double radius)
{
  const double dx = x - at.x;
  const double dy = y - at.y;
  const double u = at.cos * dx + at.sin * dy;
  const double v = at.cos * dy - at.sin * dx;
  for (int i = 0; i < polygon.count; ++i)
  {
    const Corner& corner = polygon.corners[i];
    if (corner.normal_x * (u - corner.x) + corner.normal_y * (v - corner.y) > radius) return true;
  }
  return false;
}

Manifold Collide(const PartShape& a, const BodyPlace& at_a, const PartShape& b, const BodyPlace& at_b, double margin)
{
  if (a.count > 0 && b.count > 0) return PolygonOnPolygon(a, at_a, b, at_b, margin);
  if (a.count > 0) return DiscOnPolygon(a, at_a, at_b, b.radius, margin);
  if (b.count > 0)
  {
    Manifold manifold = DiscOnPolygon(b, at_b, at_a, a.radius, margin);
    manifold.is_plane_of_b = true;
    return manifold;
  }
  Manifold manifold;
  const double distance = Square(at_b.x - at_a.x) + Square(at_b.y - at_a.y);
  if (distance > Square(a.radius + b.radius + margin)) return manifold;
  manifold.points = 1;
  manifold.are_discs = true;
  return manifold;
}

Meeting MeetingOf(const Manifold& manifold, int point, const PartShape& a, const BodyPlace& at_a, const PartShape& b,
                  const BodyPlace& at_b)
{
  if (manifold.are_discs)
  {
    const double dx = at_b.x - at_a.x;
    const double dy = at_b.y - at_a.y;
    const double distance = std::sqrt(dx * dx + dy * dy);
    const double gap = distance - a.radius - b.radius;
    const double normal_x = distance > 0 ? dx / distance : 1;
    const double normal_y = distance > 0 ? dy / distance : 0;
    const double to_point = a.radius + gap / 2;
    return {normal_x, normal_y, at_a.x + to_point * normal_x, at_a.y + to_point * normal_y, gap};
  }
  const BodyPlace& plane = manifold.is_plane_of_b ? at_b : at_a;
  const BodyPlace& other = manifold.is_plane_of_b ? at_a : at_b;
  const double plane_radius = manifold.is_plane_of_b ? b.radius : a.radius;
  const double other_radius = manifold.is_plane_of_b ? a.radius : b.radius;
  const double normal_x = plane.cos * manifold.normal_x - plane.sin * manifold.normal_y;
  const double normal_y = plane.sin * manifold.normal_x + plane.cos * manifold.normal_y;
  const auto i = static_cast<std::size_t>(point);
  const double x = other.x + other.cos * manifold.x[i] - other.sin * manifold.y[i];
  const double y = other.y + other.sin * manifold.x[i] + other.cos * manifold.y[i];
  const double from_x = plane.x + plane.cos * manifold.plane_x - plane.sin * manifold.plane_y;
  const double from_y = plane.y + plane.sin * manifold.plane_x + plane.cos * manifold.plane_y;
  const double distance = (x - from_x) * normal_x + (y - from_y) * normal_y;
  const double gap = distance - plane_radius - other_radius;
  // From the middle of the other part back to the middle between both surfaces.
  const double back = other_radius + gap / 2;
  const double sign = manifold.is_plane_of_b ? -1 : 1;
  return {sign * normal_x, sign * normal_y, x - back * normal_x, y - back * normal_y, gap};
}

}  // namespace swarmanoid::dynamics2d

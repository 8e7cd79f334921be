#include "engine_worker/engines/kinematics2d/narrow_phase.h"

#include <algorithm>
#include <cmath>

#include "engine_worker/engines/kinematics2d/kinematic_limits.h"
#include "engine_worker/engines/kinematics2d/vectors.h"

namespace swarmanoid::kinematics2d
{
namespace
{

struct Point
{
  double x, y;
};

// The axes of the frame that a polygon is fixed to: the body's or its turret's.
struct Axes
{
  double cos, sin;

  Point ToWorld(double x, double y) const { return {cos * x - sin * y, sin * x + cos * y}; }
  Point ToLocal(double x, double y) const { return {cos * x + sin * y, cos * y - sin * x}; }
};

Axes AxesOf(const Placed& body, const Polygon& polygon)
{
  if (!polygon.on_turret) return {body.cos, body.sin};
  return {body.cos * body.turret_cos - body.sin * body.turret_sin,
          body.sin * body.turret_cos + body.cos * body.turret_sin};
}

constexpr std::size_t kParts = CollisionModel::kMaximumParts;

// For each part of `b`, the parts of `a` that are less than `margin` away from it, one bit each. Polygons count as the
// circles around them.
using NearParts = std::array<unsigned, kParts>;

// The same for one part of `b`: where its centre is from the body `a`, and how far it reaches.
unsigned PartsNear(const Spot& a, double x, double y, double reach)
{
  unsigned hits = 0;
  for (std::size_t k = 0; k < kParts; k += kDoubles)
  {
    const Doubles dx = LoadDoubles(&a.centre_x[k]) - x;
    const Doubles dy = LoadDoubles(&a.centre_y[k]) - y;
    const Doubles limit = LoadDoubles(&a.placed.model->part_radius[k]) + reach;
    hits |= Bits(dx * dx + dy * dy < limit * limit) << k;
  }
  return hits;
}

bool FindNearParts(const Spot& a, const Spot& b, double margin, NearParts& near)
{
  const double dx = b.placed.x - a.placed.x;
  const double dy = b.placed.y - a.placed.y;
  unsigned any = 0;
  for (int m = 0; m < b.placed.model->parts; ++m)
  {
    near[m] = PartsNear(a, dx + b.centre_x[m], dy + b.centre_y[m], b.placed.model->part_radius[m] + margin);
    any |= near[m];
  }
  return any != 0;
}

void CircleWithCircle(const Spot& a, const Spot& b, std::size_t k, std::size_t m, Touches& touches)
{
  const double x = a.centre_x[k] - b.centre_x[m];
  const double y = a.centre_y[k] - b.centre_y[m];
  const double dx = a.placed.x - b.placed.x + x;
  const double dy = a.placed.y - b.placed.y + y;
  const double reach = a.placed.model->part_radius[k] + b.placed.model->part_radius[m];
  const double limit = reach + touches.Margin();
  const double squared = dx * dx + dy * dy;
  if (squared >= limit * limit) return;
  const double depth = reach - std::sqrt(squared);
  touches.Add({x, y, reach, false, depth});
  touches.NoteDepth(depth);
}

void CirclesWithCircles(const Spot& a, const Spot& b, const NearParts& near, Touches& touches)
{
  const unsigned circles = (1U << a.placed.model->circles) - 1;
  for (int m = 0; m < b.placed.model->circles; ++m)
    for (unsigned hits = near[m] & circles; hits != 0; hits &= hits - 1)
      CircleWithCircle(a, b, static_cast<std::size_t>(__builtin_ctz(hits)), static_cast<std::size_t>(m), touches);
}

// The circle around (x, y), relative to the polygon's body, against the polygon. `sign` is 1 where the circle belongs
// to the first body of the pair, else -1.
void CircleWithPolygon(double x, double y, double radius, double offset_x, double offset_y, const Polygon& polygon,
                       const Axes& axes, double sign, Touches& touches)
{
  const Point q = axes.ToLocal(x, y);
  int best = 0;
  double separation = -1e300;
  for (int k = 0; k < polygon.count; ++k)
  {
    const double s = polygon.nx[k] * q.x + polygon.ny[k] * q.y - polygon.offset[k];
    if (s > separation)
    {
      separation = s;
      best = k;
    }
  }
  if (separation > radius + touches.Margin()) return;

  // Outside and beyond an end of the nearest edge: the corner counts, as a circle of radius 0.
  if (separation > 0)
  {
    const int next = best + 1 == polygon.count ? 0 : best + 1;
    const double edge_x = polygon.x[next] - polygon.x[best];
    const double edge_y = polygon.y[next] - polygon.y[best];
    const double along = (q.x - polygon.x[best]) * edge_x + (q.y - polygon.y[best]) * edge_y;
    const bool before = along < 0;
    if (before || along > edge_x * edge_x + edge_y * edge_y)
    {
      const int corner = before ? best : next;
      const double corner_x = q.x - polygon.x[corner];
      const double corner_y = q.y - polygon.y[corner];
      if (corner_x * corner_x + corner_y * corner_y > (radius + touches.Margin()) * (radius + touches.Margin())) return;
      const Point p = axes.ToWorld(polygon.x[corner], polygon.y[corner]);
      touches.Add(sign * (offset_x - p.x), sign * (offset_y - p.y), radius, false);
      return;
    }
  }
  const Point n = axes.ToWorld(polygon.nx[best], polygon.ny[best]);
  const double reach = radius + polygon.offset[best] - (n.x * offset_x + n.y * offset_y);
  touches.Add(sign * n.x, sign * n.y, reach, true);
}

// `near_of`: for polygon p, the circles that are near it.
template <class NearOf>
void CirclesWithPolygons(const Spot& circles, const Spot& polygons, double sign, const NearOf& near_of,
                         Touches& touches)
{
  const CollisionModel& model = *polygons.placed.model;
  const double dx = circles.placed.x - polygons.placed.x;
  const double dy = circles.placed.y - polygons.placed.y;
  for (std::size_t p = 0; p < model.polygons.size(); ++p)
  {
    unsigned near = near_of(static_cast<int>(p));
    if (near == 0) continue;
    const Polygon& polygon = model.polygons[p];
    const Axes axes = AxesOf(polygons.placed, polygon);
    for (; near != 0; near &= near - 1)
    {
      const auto k = static_cast<std::size_t>(__builtin_ctz(near));
      CircleWithPolygon(dx + circles.centre_x[k], dy + circles.centre_y[k], circles.placed.model->part_radius[k],
                        circles.centre_x[k], circles.centre_y[k], polygon, axes, sign, touches);
    }
  }
}

// The largest separation of `other`'s vertices along the normals of `faces`, in the frame of `faces`.
double SeparationAlong(const Polygon& faces, const Polygon& other, const Axes& faces_axes, const Axes& other_axes,
                       double dx, double dy, int& best)
{
  // The vertices of `other` relative to the body of `faces`; (dx, dy): from that body to the other.
  std::array<Point, Polygon::kMaximumVertices> vertices;
  for (int k = 0; k < other.count; ++k)
  {
    const Point p = other_axes.ToWorld(other.x[k], other.y[k]);
    vertices[k] = faces_axes.ToLocal(p.x + dx, p.y + dy);
  }
  double separation = -1e300;
  for (int k = 0; k < faces.count; ++k)
  {
    double nearest = 1e300;
    for (int m = 0; m < other.count; ++m)
      nearest = std::min(nearest, faces.nx[k] * vertices[m].x + faces.ny[k] * vertices[m].y);
    nearest -= faces.offset[k];
    if (nearest > separation)
    {
      separation = nearest;
      best = k;
    }
  }
  return separation;
}

void PolygonWithPolygon(const Placed& a, const Placed& b, const Polygon& pa, const Polygon& pb, Touches& touches)
{
  const double dx = a.x - b.x;
  const double dy = a.y - b.y;
  const Axes axes_a = AxesOf(a, pa);
  const Axes axes_b = AxesOf(b, pb);
  int face_a = 0;
  int face_b = 0;
  const double along_b = SeparationAlong(pb, pa, axes_b, axes_a, dx, dy, face_b);
  if (along_b > touches.Margin()) return;
  const double along_a = SeparationAlong(pa, pb, axes_a, axes_b, -dx, -dy, face_a);
  if (along_a > touches.Margin()) return;
  const bool from_b = along_b >= along_a;
  const Point n =
      from_b ? axes_b.ToWorld(pb.nx[face_b], pb.ny[face_b]) : axes_a.ToWorld(-pa.nx[face_a], -pa.ny[face_a]);
  // depth = -separation at this place; reach makes it so.
  const double separation = from_b ? along_b : along_a;
  touches.Add(n.x, n.y, n.x * dx + n.y * dy - separation, true);
}

}  // namespace

void Touches::DropShallow()
{
  int kept = 0;
  for (int k = 0; k < count_; ++k)
    if (list_[k].depth >= -margin_) list_[kept++] = list_[k];
  count_ = kept;
}

void FindTouches(const Spot& a, const Spot& b, double margin, Touches& touches)
{
  touches.Begin(a.placed.x - b.placed.x, a.placed.y - b.placed.y, margin);
  const CollisionModel& model_a = *a.placed.model;
  const CollisionModel& model_b = *b.placed.model;
  // The first circle of a model is its largest part: where two of them touch, little else counts.
  const bool round = model_a.circles > 0 && model_b.circles > 0;
  if (round) CircleWithCircle(a, b, 0, 0, touches);
  NearParts near;
  if (!FindNearParts(a, b, touches.Margin(), near)) return;
  if (round) near[0] &= ~1U;

  CirclesWithCircles(a, b, near, touches);
  const int circles_a = model_a.circles;
  const int circles_b = model_b.circles;
  const auto circles_near_polygon_of_b = [&](int p) { return near[circles_b + p] & ((1U << circles_a) - 1); };
  CirclesWithPolygons(a, b, 1, circles_near_polygon_of_b, touches);
  const auto circles_near_polygon_of_a = [&](int p)
  {
    unsigned hits = 0;
    for (int m = 0; m < circles_b; ++m) hits |= (near[m] >> (circles_a + p) & 1U) << m;
    return hits;
  };
  CirclesWithPolygons(b, a, -1, circles_near_polygon_of_a, touches);
  for (std::size_t pa = 0; pa < model_a.polygons.size(); ++pa)
    for (std::size_t pb = 0; pb < model_b.polygons.size(); ++pb)
      if ((near[circles_b + pb] >> (circles_a + pa) & 1U) != 0)
        PolygonWithPolygon(a.placed, b.placed, model_a.polygons[pa], model_b.polygons[pb], touches);
  if (touches.Count() > 1) touches.DropShallow();
}

double Overlap(const Placed& a, const Placed& b)
{
  Touches touches;
  Spot spot_a{a, {}, {}};
  Spot spot_b{b, {}, {}};
  Spread(spot_a);
  Spread(spot_b);
  FindTouches(spot_a, spot_b, 0, touches);
  return std::max(0.0, touches.Deepest());
}

}  // namespace swarmanoid::kinematics2d

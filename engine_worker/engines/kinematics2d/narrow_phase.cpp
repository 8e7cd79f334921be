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

constexpr std::size_t kCircles = CollisionModel::kMaximumCircles;

// The centres of a body's circles, relative to the body, along the axes of the world.
struct Centres
{
  alignas(kVectorBytes) std::array<double, kCircles> x, y;
};

void FindCentres(const Placed& body, Centres& centres)
{
  for (std::size_t k = 0; k < kCircles; k += kDoubles)
  {
    const Doubles x = LoadDoubles(&body.model->circle_x[k]);
    const Doubles y = LoadDoubles(&body.model->circle_y[k]);
    Store(&centres.x[k], body.cos * x - body.sin * y);
    Store(&centres.y[k], body.sin * x + body.cos * y);
  }
}

// The circles that are less than `radius` away from the point (x, y), one bit each.
unsigned CirclesNear(const CollisionModel& model, const Centres& centres, double x, double y, double radius)
{
  unsigned hits = 0;
  for (std::size_t k = 0; k < kCircles; k += kDoubles)
  {
    const Doubles dx = LoadDoubles(&centres.x[k]) - x;
    const Doubles dy = LoadDoubles(&centres.y[k]) - y;
    const Doubles limit = LoadDoubles(&model.circle_radius[k]) + radius;
    hits |= Bits(dx * dx + dy * dy < limit * limit) << k;
  }
  return hits;
}

// All depths at once, without branches; then the few that count.
void CirclesWithCircles(const Placed& a, const Placed& b, const Centres& of_a, const Centres& of_b, Touches& touches)
{
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  alignas(kVectorBytes) std::array<double, kCircles * kCircles> depths;
  Doubles deepest = touches.Deepest() + Doubles{};
  for (int m = 0; m < b.model->circles; ++m)
    for (std::size_t k = 0; k < kCircles; k += kDoubles)
    {
      const Doubles x = LoadDoubles(&of_a.x[k]) - (dx + of_b.x[m]);
      const Doubles y = LoadDoubles(&of_a.y[k]) - (dy + of_b.y[m]);
      const Doubles reach = LoadDoubles(&a.model->circle_radius[k]) + b.model->circle_radius[m];
      const Doubles depth = reach - SquareRoots(x * x + y * y);
      Store(&depths[m * kCircles + k], depth);
      deepest = depth > deepest ? depth : deepest;
    }
  for (std::size_t lane = 0; lane < kDoubles; ++lane) touches.NoteDepth(deepest[lane]);

  const double shallowest = -touches.Margin();
  for (int m = 0; m < b.model->circles; ++m)
  {
    unsigned hits = 0;
    for (std::size_t k = 0; k < kCircles; k += kDoubles)
      hits |= Bits(LoadDoubles(&depths[m * kCircles + k]) > shallowest) << k;
    for (; hits != 0; hits &= hits - 1)
    {
      const auto k = static_cast<std::size_t>(__builtin_ctz(hits));
      touches.Add({of_a.x[k] - of_b.x[m], of_a.y[k] - of_b.y[m], a.model->circle_radius[k] + b.model->circle_radius[m],
                   false, depths[m * kCircles + k]});
    }
  }
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

void CirclesWithPolygons(const Placed& circles, const Placed& polygons, const Centres& centres, double sign,
                         Touches& touches)
{
  const double dx = circles.x - polygons.x;
  const double dy = circles.y - polygons.y;
  for (const Polygon& polygon : polygons.model->polygons)
  {
    const Axes axes = AxesOf(polygons, polygon);
    const Point centre = axes.ToWorld(polygon.centre_x, polygon.centre_y);
    unsigned near =
        CirclesNear(*circles.model, centres, centre.x - dx, centre.y - dy, polygon.radius + touches.Margin());
    for (; near != 0; near &= near - 1)
    {
      const auto k = static_cast<std::size_t>(__builtin_ctz(near));
      CircleWithPolygon(dx + centres.x[k], dy + centres.y[k], circles.model->circle_radius[k], centres.x[k],
                        centres.y[k], polygon, axes, sign, touches);
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

void PolygonsWithPolygons(const Placed& a, const Placed& b, Touches& touches)
{
  const double dx = a.x - b.x;
  const double dy = a.y - b.y;
  for (const Polygon& pa : a.model->polygons)
  {
    const Axes axes_a = AxesOf(a, pa);
    const Point centre_a = axes_a.ToWorld(pa.centre_x, pa.centre_y);
    for (const Polygon& pb : b.model->polygons)
    {
      const Axes axes_b = AxesOf(b, pb);
      const Point centre_b = axes_b.ToWorld(pb.centre_x, pb.centre_y);
      const double x = dx + centre_a.x - centre_b.x;
      const double y = dy + centre_a.y - centre_b.y;
      const double limit = pa.radius + pb.radius + touches.Margin();
      if (x * x + y * y > limit * limit) continue;

      int face_a = 0;
      int face_b = 0;
      const double along_b = SeparationAlong(pb, pa, axes_b, axes_a, dx, dy, face_b);
      if (along_b > touches.Margin()) continue;
      const double along_a = SeparationAlong(pa, pb, axes_a, axes_b, -dx, -dy, face_a);
      if (along_a > touches.Margin()) continue;
      const bool from_b = along_b >= along_a;
      const Point n =
          from_b ? axes_b.ToWorld(pb.nx[face_b], pb.ny[face_b]) : axes_a.ToWorld(-pa.nx[face_a], -pa.ny[face_a]);
      // depth = -separation at this place; reach makes it so.
      const double separation = from_b ? along_b : along_a;
      touches.Add(n.x, n.y, n.x * dx + n.y * dy - separation, true);
    }
  }
}

}  // namespace

void Touches::DropShallow()
{
  int kept = 0;
  for (int k = 0; k < count_; ++k)
    if (list_[k].depth >= -margin_) list_[kept++] = list_[k];
  count_ = kept;
}

void FindTouches(const Placed& a, const Placed& b, double margin, Touches& touches)
{
  touches.Begin(a.x - b.x, a.y - b.y, margin);
  Centres of_a, of_b;
  FindCentres(a, of_a);
  FindCentres(b, of_b);
  CirclesWithCircles(a, b, of_a, of_b, touches);
  CirclesWithPolygons(a, b, of_a, 1, touches);
  CirclesWithPolygons(b, a, of_b, -1, touches);
  PolygonsWithPolygons(a, b, touches);
  if (touches.Count() > 1) touches.DropShallow();
}

double Overlap(const Placed& a, const Placed& b)
{
  Touches touches;
  FindTouches(a, b, 0, touches);
  return std::max(0.0, touches.Deepest());
}

}  // namespace swarmanoid::kinematics2d

// Builds outlines of circles and convex polygons. For each part it computes what the tests need: faces with outward
// normals and offsets, and the circle around the part. For the whole it computes the circle that contains all parts at
// every angle of the turret, and the core, a circle about the origin that the outline fills. A step never leads further
// than half of the core's radius (step_constants.h).
#include "engine_worker/engines/kinematics2d/collision_model.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace swarmanoid::kinematics2d
{
namespace
{

double Distance(double x, double y) { return std::sqrt(x * x + y * y); }

}  // namespace

Polygon MakePolygon(std::span<const Vector2> points)
{
  if (points.size() < 3 || points.size() > Polygon::kMaximumVertices)
    throw std::invalid_argument("a collision polygon has 3 to 8 vertices");
  Polygon polygon;
  polygon.count = static_cast<int>(points.size());
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    const Vector2& a = points[k];
    const Vector2& b = points[(k + 1) % points.size()];
    const double length = Distance(b.x() - a.x(), b.y() - a.y());
    if (!(length > 0)) throw std::invalid_argument("a collision polygon has two equal vertices");
    polygon.x[k] = a.x();
    polygon.y[k] = a.y();
    polygon.nx[k] = (b.y() - a.y()) / length;
    polygon.ny[k] = (a.x() - b.x()) / length;
    polygon.offset[k] = polygon.nx[k] * a.x() + polygon.ny[k] * a.y();
    polygon.centre_x += a.x() / polygon.count;
    polygon.centre_y += a.y() / polygon.count;
  }
  for (const Vector2& point : points)
    polygon.radius = std::max(polygon.radius, Distance(point.x() - polygon.centre_x, point.y() - polygon.centre_y));
  return polygon;
}

double DistanceTo(const Polygon& polygon, double x, double y)
{
  double beyond = -1e30;  // the faces
  for (std::size_t k = 0; k < static_cast<std::size_t>(polygon.count); ++k)
    beyond = std::max(beyond, polygon.nx[k] * x + polygon.ny[k] * y - polygon.offset[k]);
  if (beyond <= 0) return beyond;
  double nearest = 1e30;
  for (std::size_t k = 0; k < static_cast<std::size_t>(polygon.count); ++k)
  {
    const std::size_t next = (k + 1) % static_cast<std::size_t>(polygon.count);
    const double length_x = polygon.x[next] - polygon.x[k];
    const double length_y = polygon.y[next] - polygon.y[k];
    const double along =
        ((x - polygon.x[k]) * length_x + (y - polygon.y[k]) * length_y) / (length_x * length_x + length_y * length_y);
    const double part = std::clamp(along, 0.0, 1.0);
    nearest = std::min(nearest, Distance(x - polygon.x[k] - part * length_x, y - polygon.y[k] - part * length_y));
  }
  return nearest;
}

CollisionModel MakeModel(std::span<const Circle> circles, std::vector<Polygon> polygons)
{
  if (circles.size() + polygons.size() > CollisionModel::kMaximumParts)
    throw std::invalid_argument("a collision model has up to 4 circles and polygons");
  CollisionModel model;
  model.circles = static_cast<int>(circles.size());
  model.parts = static_cast<int>(circles.size() + polygons.size());
  for (std::size_t k = 0; k < circles.size(); ++k)
  {
    model.part_x[k] = circles[k].x;
    model.part_y[k] = circles[k].y;
    model.part_radius[k] = circles[k].radius;
    const double centre = Distance(circles[k].x, circles[k].y);
    model.bounding_radius = std::max(model.bounding_radius, centre + circles[k].radius);
    model.core_radius = std::max(model.core_radius, circles[k].radius - centre);
  }
  for (std::size_t p = 0; p < polygons.size(); ++p)
  {
    const Polygon& polygon = polygons[p];
    const std::size_t part = circles.size() + p;
    model.part_x[part] = polygon.centre_x;
    model.part_y[part] = polygon.centre_y;
    model.part_radius[part] = polygon.radius;
    model.on_turret[part] = polygon.on_turret ? 1 : 0;
    double inside = 1e30;
    for (int k = 0; k < polygon.count; ++k)
    {
      model.bounding_radius = std::max(model.bounding_radius, Distance(polygon.x[k], polygon.y[k]));
      inside = std::min(inside, polygon.offset[k]);
    }
    model.core_radius = std::max(model.core_radius, inside);
  }
  model.polygons = std::move(polygons);
  return model;
}

CollisionModel CircleModel(double radius)
{
  const Circle circle{0, 0, radius};
  return MakeModel({&circle, 1}, {});
}

CollisionModel RectangleModel(double length_x, double length_y)
{
  const double x = length_x / 2;
  const double y = length_y / 2;
  const std::array<Vector2, 4> corners{Vector2(x, -y), Vector2(x, y), Vector2(-x, y), Vector2(-x, -y)};
  return MakeModel({}, {MakePolygon(corners)});
}

CollisionModel FootbotModel()
{
  const std::array<Circle, 3> circles{Circle{0, 0, kFootbotRadius},
                                      Circle{0, kFootbotInterWheel / 2, kFootbotWheelRadius},
                                      Circle{0, -kFootbotInterWheel / 2, kFootbotWheelRadius}};
  constexpr double kFront = kFootbotGripperReach;
  constexpr double kBack = kFootbotGripperReach - kFootbotGripperSide;
  constexpr double kHalf = kFootbotGripperSide / 2;
  const std::array<Vector2, 4> corners{Vector2(kFront, -kHalf), Vector2(kFront, kHalf), Vector2(kBack, kHalf),
                                       Vector2(kBack, -kHalf)};
  Polygon gripper = MakePolygon(corners);
  gripper.on_turret = true;
  return MakeModel(circles, {gripper});
}

}  // namespace swarmanoid::kinematics2d

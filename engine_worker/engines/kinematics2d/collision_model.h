// The outlines of bodies on the plane: circles and convex polygons in the frame of the body (metres, forward is x).
// Immutable once made; shared by all bodies of one kind.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "common/math/pose.h"
#include "common/plugin_descriptions/robot_parts.h"

namespace swarmanoid::kinematics2d
{

struct Circle
{
  double x = 0;
  double y = 0;
  double radius = 0;
};

// A convex polygon with counter-clockwise vertices. Edge k runs from vertex k to the next one; its outward normal is
// (nx, ny).
struct Polygon
{
  static constexpr int kMaximumVertices = 8;
  using Values = std::array<double, kMaximumVertices>;

  int count = 0;
  Values x{}, y{};
  Values nx{}, ny{}, offset{};                    // offset: normal times any point of the edge
  double centre_x = 0, centre_y = 0, radius = 0;  // a circle around it
  bool on_turret = false;                         // turns with the turret about the origin of the body
};

// A model without its polygons, as it also goes to regions.
struct ModelParts
{
  static constexpr int kMaximumParts = 4;
  using PartValues = std::array<double, kMaximumParts>;

  // The circles, then circles around the polygons.
  PartValues part_x{}, part_y{}, part_radius{};
  std::array<std::uint8_t, kMaximumParts> on_turret{};
  int parts = 0;
  int circles = 0;
  double bounding_radius = 0;  // about the origin of the body, at every angle of the turret
  double core_radius = 0;      // of a circle about the origin that the model fills
  double friction = 0;         // of contacts between a body and a static shape, which use the geometric mean of both
};

struct CollisionModel : ModelParts
{
  std::vector<Polygon> polygons;
};

// Makes a polygon from 3 to kMaximumVertices points of a convex outline, counter-clockwise. Throws
// std::invalid_argument for other numbers, and for equal neighbours.
Polygon MakePolygon(std::span<const Vector2> points);
// Returns the distance from a point in the frame of the polygon, negative inside.
double DistanceTo(const Polygon& polygon, double x, double y);
// Makes a model from up to kMaximumParts circles and polygons together. Throws std::invalid_argument for more.
CollisionModel MakeModel(std::span<const Circle> circles, std::vector<Polygon> polygons);

CollisionModel CircleModel(double radius);
CollisionModel RectangleModel(double length_x, double length_y);
// Returns the footbot of figure 3.9 of the documentation: the body, the two wheels, and the gripper's square at the
// front of the turret.
CollisionModel FootbotModel();

// The geometry of the footbot in metres. Radius, wheel distance and wheel radius are those of the ARGoS3 model.
inline constexpr double kFootbotRadius = 0.085036758;
inline constexpr double kFootbotInterWheel = 0.14;
inline constexpr double kFootbotWheelRadius = 0.029112741;
// The square's outer face stands this far from the axis of the turret.
inline constexpr double kFootbotGripperSide = GripperSquare::kSide;
inline constexpr double kFootbotGripperReach = GripperSquare::kReach;

}  // namespace swarmanoid::kinematics2d

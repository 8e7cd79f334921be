// The camera: its position, its direction, and the effect of mouse moves. z is up; heading, pitch and roll are those of
// the experiment files: heading 0 looks along x, 90 along y; a positive pitch looks upwards.
#pragma once

#include <utility>

#include "common/math/pose.h"

namespace swarmanoid
{

struct Ray
{
  Vector3 origin;
  Vector3 direction;  // unit vector
};

struct Camera
{
  Vector3 position = Vector3::Zero();
  double heading = 0;  // degrees
  double pitch = 0;
  double roll = 0;
  double field_of_view = 45;  // vertical, in degrees

  // Return the unit vectors of the camera in the space.
  Vector3 Forward() const;
  Vector3 Right() const;
  Vector3 Up() const;

  // Returns the matrix in columns, as OpenGL takes it. The view looks along -z of its frame.
  Eigen::Matrix4f View() const;
  // Returns a projection with depth -1..1 between two distances (m).
  Eigen::Matrix4f Projection(double aspect, double near, double far) const;
  // Returns distances (m) of a near and a far plane that fit a box and the ground around it. A wider range costs
  // precision of depth: surfaces that are close to each other would flicker.
  std::pair<double, double> DepthRange(const Vector3& low, const Vector3& high) const;

  // Returns the ray through a point of the picture: x, y from its upper left corner, in the same unit as its size.
  Ray RayThrough(double x, double y, double width, double height) const;
  // Returns the point in the picture, in the unit of its size. z is its distance along the line of sight, at most 0
  // behind the camera.
  Vector3 Project(const Vector3& point, double width, double height) const;

  // Handles mouse moves, with angles in degrees. Orbit keeps the distance from the point, and the pitch between -89.5
  // and 89.5.
  void Orbit(const Vector3& about, double right, double up);
  // Moves across the picture, by metres.
  void Pan(double right, double up);
  // Moves to or from a point; factor 0.5 halves the distance, which stays at least 5 cm.
  void Zoom(const Vector3& at, double factor);
};

// Returns where a ray meets the plane of a height, or the point `otherwise` metres along it if it does not meet the
// plane.
Vector3 PointOnFloor(const Ray& ray, double height, double otherwise);

// The parts of a picture that panels hide, as shares of its width and height.
struct HiddenEdges
{
  double left = 0, right = 0, bottom = 0;
};

// Returns a view from outside, above the corner of smallest x and y, in which the whole box is visible beside the
// hidden edges.
Camera FrameBox(const Vector3& low, const Vector3& high, double aspect, double heading = 62, double pitch = -38,
                double field_of_view = 45, const HiddenEdges& hidden = {});

}  // namespace swarmanoid

// The camera keeps angles as in experiment files, and computes its axes from them. Orbit turns the camera about a point
// and keeps its distance, Pan moves it in the plane of the picture, Zoom changes the distance from a point by a factor,
// but not below kNearest. FrameBox finds the nearest position from which a box is in the picture.
#include "visualiser/scene/camera.h"

#include <algorithm>
#include <cmath>

#include "common/math/elementary.h"

namespace swarmanoid
{
namespace
{

constexpr double kSteepest = 89.5;  // degrees
constexpr double kNearest = 0.05;   // m

Quaternion TurnOf(const Camera& camera)
{
  return Quaternion(Eigen::AngleAxisd(DegreesToRadians(camera.heading), Vector3::UnitZ()) *
                    Eigen::AngleAxisd(-DegreesToRadians(camera.pitch), Vector3::UnitY()) *
                    Eigen::AngleAxisd(DegreesToRadians(camera.roll), Vector3::UnitX()));
}

double HalfHeight(const Camera& camera) { return std::tan(DegreesToRadians(camera.field_of_view) / 2); }

}  // namespace

Vector3 Camera::Forward() const { return TurnOf(*this) * Vector3::UnitX(); }
Vector3 Camera::Right() const { return TurnOf(*this) * -Vector3::UnitY(); }
Vector3 Camera::Up() const { return TurnOf(*this) * Vector3::UnitZ(); }

Eigen::Matrix4f Camera::View() const
{
  Eigen::Matrix3d rows;
  rows.row(0) = Right();
  rows.row(1) = Up();
  rows.row(2) = -Forward();
  Eigen::Matrix4f view = Eigen::Matrix4f::Identity();
  view.topLeftCorner<3, 3>() = rows.cast<float>();
  view.topRightCorner<3, 1>() = (rows * -position).cast<float>();
  return view;
}

Eigen::Matrix4f Camera::Projection(double aspect, double near, double far) const
{
  const double scale = 1 / HalfHeight(*this);
  Eigen::Matrix4d projection = Eigen::Matrix4d::Zero();
  projection(0, 0) = scale / aspect;
  projection(1, 1) = scale;
  projection(2, 2) = (far + near) / (near - far);
  projection(2, 3) = 2 * far * near / (near - far);
  projection(3, 2) = -1;
  return projection.cast<float>();
}

std::pair<double, double> Camera::DepthRange(const Vector3& low, const Vector3& high) const
{
  double nearest = 1e300;
  double farthest = 1;
  for (int corner = 0; corner < 8; ++corner)
  {
    const Vector3 point(corner & 1 ? high.x() : low.x(), corner & 2 ? high.y() : low.y(),
                        corner & 4 ? high.z() : low.z());
    const double depth = (point - position).dot(Forward());
    nearest = std::min(nearest, depth);
    farthest = std::max(farthest, depth);
  }
  const double size = (high - low).norm();
  // The ground in front of the arena must be included.
  const double above = std::abs(position.z() - low.z());
  return {std::max({0.02, std::min(nearest * 0.9, above * 0.5), 1e-4 * size}), 4 * farthest + 10 * size};
}

Ray Camera::RayThrough(double x, double y, double width, double height) const
{
  const double half = HalfHeight(*this);
  const double right = (2 * x / width - 1) * half * width / height;
  const double up = (1 - 2 * y / height) * half;
  return {position, (Forward() + right * Right() + up * Up()).normalized()};
}

Vector3 Camera::Project(const Vector3& point, double width, double height) const
{
  const Vector3 to = point - position;
  const double distance = to.dot(Forward());
  if (distance <= 0) return {0, 0, distance};
  const double scale = height / (2 * HalfHeight(*this) * distance);
  return {width / 2 + scale * to.dot(Right()), height / 2 - scale * to.dot(Up()), distance};
}

void Camera::Orbit(const Vector3& about, double right, double up)
{
  const Vector3 away = TurnOf(*this).conjugate() * (position - about);
  heading = RadiansToDegrees(WrapAngle(DegreesToRadians(heading - right)));
  pitch = std::clamp(pitch - up, -kSteepest, kSteepest);
  position = about + TurnOf(*this) * away;
}

void Camera::Pan(double right, double up) { position += right * Right() + up * Up(); }

void Camera::Zoom(const Vector3& at, double factor)
{
  const Vector3 away = position - at;
  const double distance = away.norm();
  if (distance > 0) position = at + away * (std::max(distance * factor, kNearest) / distance);
}

Vector3 PointOnFloor(const Ray& ray, double height, double otherwise)
{
  const double distance = (height - ray.origin.z()) / ray.direction.z();
  return ray.origin + ray.direction * (distance > 0 && std::isfinite(distance) ? distance : otherwise);
}

Camera FrameBox(const Vector3& low, const Vector3& high, double aspect, double heading, double pitch,
                double field_of_view, const HiddenEdges& hidden)
{
  Camera camera;
  camera.heading = heading;
  camera.pitch = pitch;
  camera.field_of_view = field_of_view;
  const Vector3 forward = camera.Forward();
  const Vector3 right = camera.Right();
  const Vector3 up = camera.Up();
  // A corner is in the free part of the picture if |right - shift * depth| <= slope * depth, and up the same. The
  // planes of the four sides are pushed out until the box is inside. Each pair meets in a line, and the camera is at
  // the greater depth of the two.
  constexpr double kMargin = 1.06;
  const double half_up = HalfHeight(camera);
  const double half_right = half_up * aspect;
  const double shift_right = half_right * (hidden.left - hidden.right);
  const double shift_up = half_up * hidden.bottom;
  const double slope_right = half_right * (1 - hidden.left - hidden.right) / kMargin;
  const double slope_up = half_up * (1 - hidden.bottom) / kMargin;
  double most_right = -1e300, most_left = -1e300, most_up = -1e300, most_down = -1e300;
  for (int corner = 0; corner < 8; ++corner)
  {
    const Vector3 point(corner & 1 ? high.x() : low.x(), corner & 2 ? high.y() : low.y(),
                        corner & 4 ? high.z() : low.z());
    const double depth = point.dot(forward);
    const double to_right = point.dot(right) - shift_right * depth;
    const double to_up = point.dot(up) - shift_up * depth;
    most_right = std::max(most_right, to_right - slope_right * depth);
    most_left = std::max(most_left, -to_right - slope_right * depth);
    most_up = std::max(most_up, to_up - slope_up * depth);
    most_down = std::max(most_down, -to_up - slope_up * depth);
  }
  const double back = std::max((most_right + most_left) / (2 * slope_right), (most_up + most_down) / (2 * slope_up));
  camera.position = -back * forward + ((most_right - most_left) / 2 - back * shift_right) * right +
                    ((most_up - most_down) / 2 - back * shift_up) * up;
  return camera;
}

}  // namespace swarmanoid

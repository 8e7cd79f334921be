// ViewVolume computes the frustum of the camera as five planes without a far plane; a sphere is visible if it is
// outside of none. SunVolume is an orthographic view along the light, fitted to the visible part of the ground, so that
// the shadow map spends its texels there.
#include "visualiser/gl/view_volume.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "common/math/elementary.h"

namespace swarmanoid
{

ViewVolume::ViewVolume(const Camera& camera, int width, int height, const Vector3& low, const Vector3& high)
    : eye(camera.position.cast<float>()), forward(camera.Forward().cast<float>())
{
  std::tie(near, far) = camera.DepthRange(low, high);

  const double aspect = static_cast<double>(width) / height;
  view_projection = camera.Projection(aspect, near, far) * camera.View();
  pixels_per_slope = static_cast<float>(height / (2 * std::tan(DegreesToRadians(camera.field_of_view) / 2)));
  const Eigen::Vector4f x = view_projection.row(0);
  const Eigen::Vector4f y = view_projection.row(1);
  const Eigen::Vector4f z = view_projection.row(2);
  const Eigen::Vector4f w = view_projection.row(3);
  planes = {w + x, w - x, w + y, w - y, w + z};
  for (Eigen::Vector4f& plane : planes) plane /= plane.head<3>().norm();

  // The visible ground is bounded by the points where sight lines through the picture's edge meet it, or by their ends
  // above the horizon.
  seen_low = high;
  seen_high = low;
  constexpr int kSteps = 4;
  for (int i = 0; i <= kSteps; ++i)
    for (int j = 0; j <= kSteps; ++j)
      for (const double ground : {low.z(), high.z()})
      {
        const Ray ray = camera.RayThrough(static_cast<double>(width) * i / kSteps,
                                          static_cast<double>(height) * j / kSteps, width, height);
        const Vector3 point = PointOnFloor(ray, ground, far).cwiseMax(low).cwiseMin(high);
        seen_low = seen_low.cwiseMin(point);
        seen_high = seen_high.cwiseMax(point);
      }
  const Vector3 inside = camera.position.cwiseMax(low).cwiseMin(high);
  if (camera.position == inside)
  {
    seen_low = seen_low.cwiseMin(inside);
    seen_high = seen_high.cwiseMax(inside);
  }
  const Vector3 margin(0.5, 0.5, 0);
  seen_low = (seen_low - margin).cwiseMax(low);
  seen_high = (seen_high + margin).cwiseMin(high);
  seen_low.z() = low.z();
  seen_high.z() = high.z();
}

bool ViewVolume::Sees(const Eigen::Vector3f& centre, float radius) const
{
  for (const Eigen::Vector4f& plane : planes)
    if (plane.head<3>().dot(centre) + plane.w() < -radius) return false;
  return true;
}

float ViewVolume::PixelsOf(const Eigen::Vector3f& centre, float radius) const
{
  return pixels_per_slope * radius / std::max((centre - eye).dot(forward), 1e-3F);
}

SunVolume::SunVolume(const Vector3& towards_sun, const Vector3& low, const Vector3& high)
{
  const Vector3 right = Vector3::UnitZ().cross(towards_sun).normalized();
  const Vector3 up = towards_sun.cross(right);
  Eigen::Matrix3d rows;
  rows << right.transpose(), up.transpose(), towards_sun.transpose();
  Vector3 least = Vector3::Constant(1e300);
  Vector3 most = Vector3::Constant(-1e300);
  for (int corner = 0; corner < 8; ++corner)
  {
    const Vector3 point = rows * Vector3(corner & 1 ? high.x() : low.x(), corner & 2 ? high.y() : low.y(),
                                         corner & 4 ? high.z() : low.z());
    least = least.cwiseMin(point);
    most = most.cwiseMax(point);
  }
  // Bodies that throw a shadow into the box may be nearer to the sun.
  most.z() += 1;
  least -= Vector3::Constant(0.05);
  most += Vector3::Constant(0.05);
  const Vector3 size = most - least;
  Eigen::Matrix4d projection = Eigen::Matrix4d::Identity();
  for (Eigen::Index axis = 0; axis < 3; ++axis)
  {
    const double sign = axis == 2 ? -1 : 1;  // the depth is smaller towards the sun
    projection.block<1, 3>(axis, 0) = sign * 2 / size[axis] * rows.row(axis);
    projection(axis, 3) = -sign * (most[axis] + least[axis]) / size[axis];
  }
  Eigen::Matrix4d half = Eigen::Matrix4d::Identity();
  half.topLeftCorner<3, 3>() *= 0.5;
  half.topRightCorner<3, 1>().setConstant(0.5);
  view_projection = projection.cast<float>();
  to_texture = (half * projection).cast<float>();
  depth = static_cast<float>(size.z());
  width = static_cast<float>(std::max(size.x(), size.y()));
}

bool SunVolume::Holds(const Eigen::Vector3f& centre, float radius) const
{
  const Eigen::Vector4f place = view_projection * centre.homogeneous();
  for (Eigen::Index axis = 0; axis < 2; ++axis)
  {
    const float reach = 1 + radius * view_projection.row(axis).head<3>().norm();
    if (std::abs(place[axis]) > reach) return false;
  }
  return true;
}

}  // namespace swarmanoid

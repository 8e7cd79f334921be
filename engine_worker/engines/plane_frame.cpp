#include "engine_worker/engines/plane_frame.h"

#include <algorithm>
#include <array>

#include "common/math/elementary.h"

namespace swarmanoid
{
namespace
{

// A body that is no farther than this from the plane touches it.
constexpr double kTouch_m = 1e-3;

Pose AxisFrame(PlaneAxis axis, double distance)
{
  // Turns by 120 degrees about (1, 1, 1) exchange the axes in a circle; their quaternions are exact.
  switch (axis)
  {
    case PlaneAxis::kX:
      return {Vector3(distance, 0, 0), Quaternion(0.5, 0.5, 0.5, 0.5)};
    case PlaneAxis::kY:
      return {Vector3(0, distance, 0), Quaternion(0.5, -0.5, -0.5, -0.5)};
    default:
      return {Vector3(0, 0, distance), Quaternion::Identity()};
  }
}

double Cross(const Vector2& origin, const Vector2& a, const Vector2& b)
{
  return (a.x() - origin.x()) * (b.y() - origin.y()) - (a.y() - origin.y()) * (b.x() - origin.x());
}

// Counter-clockwise hull by Andrew's monotone chain; points on an edge are dropped.
std::vector<Vector2> ConvexHull(std::vector<Vector2> points)
{
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

}  // namespace

PlaneFrame::PlaneFrame(PlaneAxis axis, double distance) : PlaneFrame(AxisFrame(axis, distance)) {}

PlanePose PlaneFrame::ToPlane(const Pose& pose) const
{
  const Pose local = inverse_.Compose(pose);
  return {local.position.x(), local.position.y(), YawOf(local.orientation)};
}

PlaneStance PlaneFrame::StanceOf(const Pose& pose) const
{
  const Pose local = inverse_.Compose(pose);
  return {local.position.z(), QuaternionFromYaw(YawOf(local.orientation)).conjugate() * local.orientation};
}

Pose PlaneFrame::ToSpace(const PlanePose& pose, const PlaneStance& stance) const
{
  return frame_.Compose({Vector3(pose.u, pose.v, stance.height), QuaternionFromYaw(pose.heading) * stance.lean});
}

std::vector<Vector2> PlaneFrame::CutBox(const Pose& pose, const Vector3& size) const
{
  const Pose local = inverse_.Compose(pose);
  std::array<Vector3, 8> corners;
  for (unsigned i = 0; i < 8; ++i)
  {
    const Vector3 signs((i & 1) != 0 ? 0.5 : -0.5, (i & 2) != 0 ? 0.5 : -0.5, (i & 4) != 0 ? 0.5 : -0.5);
    corners[i] = local.Apply(size.cwiseProduct(signs));
  }
  const auto [lowest, highest] = std::minmax_element(corners.begin(), corners.end(),
                                                     [](const Vector3& a, const Vector3& b) { return a.z() < b.z(); });
  if (lowest->z() > kTouch_m || highest->z() < -kTouch_m) return {};

  // Cut a little inside a face that lies in the plane, so that rounding cannot lose it.
  const double inset = std::min(kTouch_m, 0.25 * (highest->z() - lowest->z()));
  const double level = std::clamp(0.0, lowest->z() + inset, highest->z() - inset);
  std::vector<Vector2> points;
  for (unsigned i = 0; i < 8; ++i)
  {
    for (const unsigned bit : {1U, 2U, 4U})
    {
      if ((i & bit) != 0) continue;
      const Vector3& a = corners[i];
      const Vector3& b = corners[i | bit];
      if ((a.z() < level) == (b.z() < level)) continue;
      const double part = (level - a.z()) / (b.z() - a.z());
      points.emplace_back(a.x() + part * (b.x() - a.x()), a.y() + part * (b.y() - a.y()));
    }
  }
  return points.size() < 3 ? std::vector<Vector2>{} : ConvexHull(std::move(points));
}

bool PlaneFrame::CutsUpright(const Pose& pose, double height) const
{
  const Pose local = inverse_.Compose(pose);
  const double top = local.Apply(Vector3(0, 0, height)).z() - local.position.z();
  const double base = local.position.z();
  return std::min(base, base + top) <= kTouch_m && std::max(base, base + top) >= -kTouch_m;
}

PlaneFrame PlaneFrom(const Parameters& parameters)
{
  const std::string axis = parameters.Text("perpendicular_axis");
  const PlaneFrame plain(axis == "x"   ? PlaneAxis::kX
                         : axis == "y" ? PlaneAxis::kY
                                       : PlaneAxis::kZ,
                         parameters.Number("distance"));
  const Vector3 tilt = parameters.Vector3Of("tilt");
  if (tilt == Vector3::Zero()) return plain;
  const Quaternion turn =
      QuaternionFromEuler({DegreesToRadians(tilt.x()), DegreesToRadians(tilt.y()), DegreesToRadians(tilt.z())});
  return PlaneFrame(Pose{Vector3::Zero(), turn}.Compose(plain.Frame()));
}

}  // namespace swarmanoid

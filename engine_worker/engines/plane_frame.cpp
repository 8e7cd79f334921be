// Problem: relate the poses of a plane at any place in the space to poses in the space, and find what the plane cuts.
//
// Method: the frame of the plane has u, v and the normal as its axes. The heading of a pose is its yaw in this frame,
// and the rest of the orientation is the lean. A cut goes through the edges of a body: each edge with ends on both
// sides gives a point, and the convex outline of all points is the cut.
//
// Invariant: a face that only touches the plane within kTouch_m (m) is cut too, a little inside the body, so that
// rounding cannot lose it.
#include "engine_worker/engines/plane_frame.h"

#include <algorithm>
#include <array>

#include "common/math/convex_outline.h"
#include "common/math/elementary.h"
#include "common/mesh/convex_hull.h"

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

// Returns the outline with at most kMostCutCorners corners, without those that stand out least.
std::vector<Vector2> Simplified(std::vector<Vector2> outline)
{
  while (outline.size() > kMostCutCorners)
  {
    const std::size_t count = outline.size();
    const auto area = [&](std::size_t k)
    {
      const Vector2 before = outline[(k + count - 1) % count] - outline[k];
      const Vector2 after = outline[(k + 1) % count] - outline[k];
      return after.x() * before.y() - after.y() * before.x();
    };
    std::size_t least = 0;
    for (std::size_t k = 1; k < count; ++k)
      if (area(k) < area(least)) least = k;
    outline.erase(outline.begin() + static_cast<std::ptrdiff_t>(least));
  }
  return outline;
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
  std::array<Vector3, 8> corners;
  std::array<std::array<std::uint32_t, 2>, 12> edges;
  std::size_t edge = 0;
  for (std::uint32_t i = 0; i < 8; ++i)
  {
    const Vector3 signs((i & 1) != 0 ? 0.5 : -0.5, (i & 2) != 0 ? 0.5 : -0.5, (i & 4) != 0 ? 0.5 : -0.5);
    corners[i] = size.cwiseProduct(signs);
    for (const std::uint32_t bit : {1U, 2U, 4U})
      if ((i & bit) == 0) edges[edge++] = {i, i | bit};
  }
  return Cut(pose, corners, edges);
}

std::vector<Vector2> PlaneFrame::CutBody(const CSwarmanoidSpaceEntity& entity, const Pose& pose) const
{
  const EntityConfiguration& configuration = entity.GetConfiguration();
  const Vector3 centre(0, 0,
                       DescriptionOf(entity.GetKind()).origin == BodyOrigin::kBase ? entity.GetSize().z() / 2 : 0);
  if (!configuration.hull) return CutBox({pose.Apply(centre), pose.orientation}, entity.GetSize());
  std::vector<std::array<std::uint32_t, 2>> edges;
  for (const ConvexHull::Edge& edge : configuration.hull->edges) edges.push_back(edge.corners);
  return Simplified(Cut(pose, configuration.hull->corners, edges));
}

std::vector<Vector2> PlaneFrame::Cut(const Pose& pose, std::span<const Vector3> in_body,
                                     std::span<const std::array<std::uint32_t, 2>> edges) const
{
  const Pose local = inverse_.Compose(pose);
  std::vector<Vector3> corners;
  for (const Vector3& corner : in_body) corners.push_back(local.Apply(corner));
  const auto [lowest, highest] = std::minmax_element(corners.begin(), corners.end(),
                                                     [](const Vector3& a, const Vector3& b) { return a.z() < b.z(); });
  if (lowest->z() > kTouch_m || highest->z() < -kTouch_m) return {};

  // Cut a little inside a face that lies in the plane, so that rounding cannot lose it.
  const double inset = std::min(kTouch_m, 0.25 * (highest->z() - lowest->z()));
  const double level = std::clamp(0.0, lowest->z() + inset, highest->z() - inset);
  std::vector<Vector2> points;
  for (const auto& [from, to] : edges)
  {
    const Vector3& a = corners[from];
    const Vector3& b = corners[to];
    if ((a.z() < level) == (b.z() < level)) continue;
    const double part = (level - a.z()) / (b.z() - a.z());
    points.emplace_back(a.x() + part * (b.x() - a.x()), a.y() + part * (b.y() - a.y()));
  }
  return points.size() < 3 ? std::vector<Vector2>{} : ConvexOutline(std::move(points));
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

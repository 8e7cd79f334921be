// Problem: a body that goes farther in a step than it is wide passes through what is thin, such as a floor of cells.
//
// Method: a step is cut into so many equal parts that no solid goes farther in one of them than a quarter of the sum of
// its own least width and that of the solid that it may meet. Then the solids overlap by less than half of that sum,
// and the shortest way out leads back. Only solids count whose boxes meet when both are grown by their ways.
//
// Invariants: the number of parts follows from the bodies at the start of the step. Planes have no back and never
// count. Source: docs/engines.md, "Fast bodies" of `dynamics3d`.
#include <algorithm>
#include <cmath>
#include <limits>

#include "engine_worker/engines/dynamics3d/solver_world.h"
#include "engine_worker/engines/dynamics3d/terrain_shape.h"

namespace swarmanoid::dynamics3d
{
namespace
{

constexpr int kMostParts = 64;

double LeastWidthOfHull(const ConvexHull& hull)
{
  double least = std::numeric_limits<double>::infinity();
  for (const ConvexHull::Face& face : hull.faces)
  {
    double width = 0;
    for (const Vector3& corner : hull.corners) width = std::max(width, face.distance - face.normal.dot(corner));
    least = std::min(least, width);
  }
  return least;
}

}  // namespace

double LeastWidth(const Solid& solid)
{
  dReal radius = 0;
  dReal length = 0;
  dVector3 sides;
  switch (dGeomGetClass(solid.geom))
  {
    case dSphereClass:
      return 2 * dGeomSphereGetRadius(solid.geom);
    case dBoxClass:
      dGeomBoxGetLengths(solid.geom, sides);
      return std::min({sides[0], sides[1], sides[2]});
    case dCylinderClass:
      dGeomCylinderGetParams(solid.geom, &radius, &length);
      return std::min(2 * radius, length);
    case dCapsuleClass:
      dGeomCapsuleGetParams(solid.geom, &radius, &length);
      return 2 * radius;
    case dConvexClass:
      return LeastWidthOfHull(solid.shape->Hull());
    default:
      return solid.layer == ELayer::kVoxels ? CellSizeOf(solid.geom) : std::numeric_limits<double>::infinity();
  }
}

// Returns how far (m) any point of a solid can move within the step.
double SolverWorld::LargestWay(const Solid& solid, double seconds) const
{
  if (!IsAwake(solid)) return 0;
  const dBodyID body = all_.Body(solid.body);
  const Box box = BoxAround(solid.geom);
  const Vector3 centre = VectorOf(dBodyGetPosition(body));
  double square = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto k = 2 * static_cast<std::size_t>(axis);
    const double arm = std::max(std::abs(box[k] - centre[axis]), std::abs(box[k + 1] - centre[axis]));
    square += arm * arm;
  }
  const double speed = std::sqrt(VectorOf(dBodyGetLinearVel(body)).squaredNorm()) +
                       std::sqrt(VectorOf(dBodyGetAngularVel(body)).squaredNorm() * square) +
                       std::sqrt(settings_.gravity.squaredNorm()) * seconds;
  return speed * seconds;
}

int SolverWorld::PartsOfStep(double seconds)
{
  const auto is_fast = [&](const Solid& solid, double way)
  { return solid.layer != ELayer::kWheel && way > kPartOfWidth * solid.least_width; };
  bool is_any_fast = false;
  for (const std::uint32_t member : members_)
  {
    const Assembly& assembly = all_.AssemblyAt(member);
    for (std::uint32_t k = assembly.first_solid; k < assembly.end_solid && !all_.IsLeftOut(assembly); ++k)
      if (const Solid& solid = SolidAt(k); solid.layer != ELayer::kWheel)
        is_any_fast = is_any_fast || is_fast(solid, LargestWay(solid, seconds));
  }
  if (!is_any_fast) return 1;

  boxes_.resize(members_.size());
  for (const std::uint32_t member : members_)
  {
    const Assembly& assembly = all_.AssemblyAt(member);
    double way = 0;
    for (std::uint32_t k = assembly.first_solid; k < assembly.end_solid; ++k)
      way = std::max(way, LargestWay(SolidAt(k), seconds));
    boxes_[assembly.position] = Grown(all_.BoxOf(assembly.first_body), way);
  }
  double parts = 1;
  ForEachNear(
      [&](const Solid& a, const Solid& b)
      {
        const double way_a = LargestWay(a, seconds), way_b = LargestWay(b, seconds);
        if (!is_fast(a, way_a) && !is_fast(b, way_b)) return;
        const double needed = (way_a + way_b) / (kPartOfWidth * (a.least_width + b.least_width));
        const Box box_a = Grown(BoxOf(a), way_a), box_b = Grown(BoxOf(b), way_b);
        if (needed <= parts || !Overlap(box_a, box_b)) return;
        if (b.layer == ELayer::kVoxels && !ReachesCells(b.geom, box_a)) return;
        parts = needed;
      });
  return static_cast<int>(std::ceil(std::min<double>(parts, kMostParts)));
}

}  // namespace swarmanoid::dynamics3d

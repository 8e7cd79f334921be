// Problem: ODE's general convex algorithm gives robots that stand side by side too few contacts, at arbitrary points.
//
// Method: the common stretch of the mean axis has a contact at each end, along the line between the axes.
//
// Invariant: contacts follow from both poses alone. Their normals point into the first geom, as in ODE.
#include "engine_worker/engines/dynamics3d/cylinder_contacts.h"

#include <algorithm>
#include <cmath>

#include "engine_worker/engines/dynamics3d/collide.h"
#include "engine_worker/engines/dynamics3d/upright_contacts.h"

namespace swarmanoid::dynamics3d
{
namespace
{

constexpr double kParallel = 0.94;  // cosine of 20 degrees

struct Cylinder
{
  Vector3 centre;
  Vector3 axis;
  double radius;
  double half_length;
};

Cylinder CylinderOf(dGeomID geom)
{
  const dReal* p = dGeomGetPosition(geom);
  const dReal* r = dGeomGetRotation(geom);
  dReal radius = 0;
  dReal length = 0;
  dGeomCylinderGetParams(geom, &radius, &length);
  return {Vector3(p[0], p[1], p[2]), Vector3(r[2], r[6], r[10]), radius, length / 2};
}

}  // namespace

int CollideParallelCylinders(dGeomID geom_a, dGeomID geom_b, const Vector3& way, std::span<dContactGeom> contacts)
{
  const Cylinder a = CylinderOf(geom_a);
  const Cylinder b = CylinderOf(geom_b);
  const double cosine = a.axis.dot(b.axis);
  if (std::abs(cosine) < kParallel) return -1;

  // Heights are along the mean axis, so that neither cylinder decides alone.
  Vector3 up = cosine > 0 ? Vector3(a.axis + b.axis) : Vector3(a.axis - b.axis);
  up /= std::sqrt(up.squaredNorm());
  const auto height_of = [&](const Cylinder& cylinder) { return up.dot(cylinder.centre); };
  const auto reach_of = [&](const Cylinder& cylinder)
  { return cylinder.half_length * std::abs(up.dot(cylinder.axis)); };
  const auto at = [&](const Cylinder& cylinder, double height) -> Vector3
  { return cylinder.centre + cylinder.axis * ((height - height_of(cylinder)) / up.dot(cylinder.axis)); };
  const double low = std::max(height_of(a) - reach_of(a), height_of(b) - reach_of(b));
  const double high = std::min(height_of(a) + reach_of(a), height_of(b) + reach_of(b));
  if (low >= high) return 0;

  int count = 0;
  bool touches = false;
  bool side_by_side = true;
  for (const double height : {low, high})
  {
    const Vector3 on_a = at(a, height);
    const Vector3 on_b = at(b, height);
    const Vector3 apart = on_a - on_b;
    const double distance = std::sqrt(apart.squaredNorm());
    const double depth = a.radius + b.radius - distance;
    if (distance < 1e-9) return -1;
    const Vector3 normal = apart / distance;
    if (depth <= -PatchGap(normal, way)) continue;
    touches = touches || depth > 0;
    if (depth > high - low) side_by_side = false;
    contacts[static_cast<std::size_t>(count++)] =
        ContactAt(on_b + normal * (b.radius - depth / 2), normal, depth, geom_a, geom_b);
  }
  // If a contact is deeper than the common height, one cylinder lies on top of the other.
  if (!side_by_side) return -1;
  return touches ? count : 0;
}

}  // namespace swarmanoid::dynamics3d

#include "engine_worker/engines/dynamics3d/cylinder_contacts.h"

#include <algorithm>
#include <cmath>

#include "common/math/pose.h"

namespace swarmanoid::dynamics3d
{
namespace
{

constexpr double kParallel = 0.94;  // cosine of 20 degrees
constexpr double kFlat = 0.99;      // cosine of 8 degrees

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

dContactGeom ContactAt(const Vector3& point, const Vector3& normal, double depth, dGeomID first, dGeomID second)
{
  dContactGeom contact{};
  for (int k = 0; k < 3; ++k)
  {
    contact.pos[k] = point[k];
    contact.normal[k] = normal[k];
  }
  contact.depth = depth;
  contact.g1 = first;
  contact.g2 = second;
  contact.side1 = contact.side2 = -1;
  return contact;
}

}  // namespace

int CollideParallelCylinders(dGeomID geom_a, dGeomID geom_b, std::span<dContactGeom> contacts)
{
  const Cylinder a = CylinderOf(geom_a);
  const Cylinder b = CylinderOf(geom_b);
  const double cosine = a.axis.dot(b.axis);
  if (std::abs(cosine) < kParallel) return -1;

  // The stretch of a's axis, from low to high, that stands beside b.
  const double middle = (b.centre - a.centre).dot(a.axis);
  const double low = std::max(-a.half_length, middle - b.half_length);
  const double high = std::min(a.half_length, middle + b.half_length);
  if (low >= high) return 0;

  int count = 0;
  bool side_by_side = true;
  for (const double height : {low, high})
  {
    // The point of b's axis at this height along a's.
    const Vector3 on_a = a.centre + a.axis * height;
    const Vector3 on_b = b.centre + b.axis * ((height - middle) / cosine);
    const Vector3 apart = on_a - on_b;
    const double distance = std::sqrt(apart.squaredNorm());
    const double depth = a.radius + b.radius - distance;
    if (distance < 1e-9) return -1;
    if (depth <= 0) continue;
    if (depth > high - low) side_by_side = false;
    const Vector3 normal = apart / distance;
    contacts[static_cast<std::size_t>(count++)] =
        ContactAt(on_b + normal * (b.radius - depth / 2), normal, depth, geom_a, geom_b);
  }
  // Deeper beside than above: one lies on top of the other.
  return side_by_side ? count : -1;
}

int CollideCylinderWithPlane(dGeomID geom, dGeomID plane_geom, std::span<dContactGeom> contacts)
{
  const Cylinder cylinder = CylinderOf(geom);
  dVector4 plane;
  dGeomPlaneGetParams(plane_geom, plane);
  const Vector3 normal(plane[0], plane[1], plane[2]);
  const double along = cylinder.axis.dot(normal);
  const Vector3 lower = cylinder.centre - cylinder.axis * (along > 0 ? cylinder.half_length : -cylinder.half_length);
  const Vector3 upper = cylinder.centre * 2 - lower;

  int count = 0;
  const auto add = [&](const Vector3& point)
  {
    const double depth = plane[3] - normal.dot(point);
    if (depth < 0 || count == static_cast<int>(contacts.size())) return;
    contacts[static_cast<std::size_t>(count++)] = ContactAt(point, normal, depth, geom, plane_geom);
  };

  // The rim's deepest point, of both rims for a cylinder that lies.
  const Vector3 down = cylinder.axis * along - normal;
  const double length = std::sqrt(down.squaredNorm());
  if (length > 1e-9)
  {
    add(lower + down * (cylinder.radius / length));
    add(upper + down * (cylinder.radius / length));
  }
  // A rim that lies flat gets contacts at points fixed to the rim, so that it does not wobble.
  if (std::abs(along) > kFlat)
  {
    const dReal* r = dGeomGetRotation(geom);
    const Vector3 x = Vector3(r[0], r[4], r[8]) * cylinder.radius;
    const Vector3 y = Vector3(r[1], r[5], r[9]) * cylinder.radius;
    add(lower + x);
    add(lower + y);
    add(lower - x);
    add(lower - y);
  }
  return count;
}

}  // namespace swarmanoid::dynamics3d

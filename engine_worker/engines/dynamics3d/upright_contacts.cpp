// Problem: bodies on a floor lean by some 0.02 degrees, as the solver left them. If two of them collide, this lean
// decides at which rim they touch first. A collision at one rim alone kicks both bodies upwards.
//
// Method: both bodies are prisms, with an outline in the plane and a stretch of height. The outlines meet in the plane,
// at the middle of the common height, which gives a horizontal normal and one or two points. Each point counts at both
// ends of the common height, with its depth there. A gap of a point is closed if it is within PatchGap: all such points
// would touch before the step ends, so they share the collision.
//
// Sources: separating axes and clipping of edges as in E. Catto, "Contact manifolds", GDC 2007; contacts that close
// within a step as in E. Catto, "Continuous collision", GDC 2013.
//
// Invariants: contacts follow from both poses and `way`. If no point touches, there is no contact. The normal points
// into the first geom.
#include "engine_worker/engines/dynamics3d/upright_contacts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "engine_worker/engines/dynamics3d/collide.h"

namespace swarmanoid::dynamics3d
{
namespace
{

constexpr double kSameSide = 1e-5;  // m: the first body's face decides, if both overlap by as much

using Corners = Prism::Corners;

}  // namespace

std::optional<Prism> PrismOf(dGeomID geom)
{
  const int kind = dGeomGetClass(geom);
  if (kind != dCylinderClass && kind != dBoxClass) return std::nullopt;
  const dReal* position = dGeomGetPosition(geom);
  const dReal* rotation = dGeomGetRotation(geom);
  const auto axis = [&](int k) -> Vector3 { return {rotation[k], rotation[4 + k], rotation[8 + k]}; };
  int vertical = 2;
  dVector3 sides = {0, 0, 0};
  Prism prism;
  if (kind == dBoxClass)
  {
    dGeomBoxGetLengths(geom, sides);
    while (vertical > 0 && std::abs(axis(vertical).z()) < kFlatCosine) --vertical;
    prism.half_height = sides[vertical] / 2;
  }
  else
  {
    dReal length = 0;
    dGeomCylinderGetParams(geom, &prism.radius, &length);
    prism.half_height = length / 2;
  }
  const Vector3 up = axis(vertical);
  if (std::abs(up.z()) < kFlatCosine) return std::nullopt;
  prism.centre = {position[0], position[1]};
  prism.middle = position[2];
  prism.slope = up.head<2>() / up.z();
  if (kind == dBoxClass)
  {
    const int x = (vertical + 1) % 3;
    const int y = (vertical + 2) % 3;
    prism.half_x = axis(x).head<2>() * (sides[x] / 2);
    prism.half_y = axis(y).head<2>() * (sides[y] / 2);
    if (up.z() < 0) std::swap(prism.half_x, prism.half_y);
  }
  return prism;
}

namespace
{

Vector2 OutwardNormal(const Corners& corners, std::size_t side)
{
  const Vector2 along = corners[(side + 1) % 4] - corners[side];
  return Vector2(along.y(), -along.x()) / std::sqrt(along.squaredNorm());
}

PlaneContact TwoCircles(const Prism& a, const Prism& b)
{
  const Vector2 apart = a.centre - b.centre;
  const double distance = std::sqrt(apart.squaredNorm());
  if (distance < 1e-9) return {};
  PlaneContact contact;
  contact.normal = apart / distance;
  const double depth = a.radius + b.radius - distance;
  contact.points[0] = {b.centre + contact.normal * (b.radius - depth / 2), depth};
  contact.count = 1;
  return contact;
}

// The normal points into the circle.
PlaneContact CircleAtBox(const Prism& circle, const Prism& box)
{
  const Corners corners = box.CornersOfBox();
  std::size_t side = 0;
  double separation = -1e300;
  for (std::size_t k = 0; k < 4; ++k)
  {
    const double here = OutwardNormal(corners, k).dot(circle.centre - corners[k]);
    if (here <= separation) continue;
    separation = here;
    side = k;
  }
  PlaneContact contact;
  contact.normal = OutwardNormal(corners, side);
  Vector2 nearest = circle.centre - contact.normal * separation;
  const Vector2 along = corners[(side + 1) % 4] - corners[side];
  const double part = along.dot(circle.centre - corners[side]) / along.squaredNorm();
  if (separation > 0 && (part < 0 || part > 1))
  {
    nearest = corners[part < 0 ? side : (side + 1) % 4];
    const Vector2 out = circle.centre - nearest;
    separation = std::sqrt(out.squaredNorm());
    contact.normal = out / separation;
  }
  contact.points[0] = {nearest, circle.radius - separation};
  contact.count = 1;
  return contact;
}

// Returns the side of `of` from which `other` is separated most, or which it overlaps least.
std::size_t BestSide(const Corners& of, const Corners& other, double& separation)
{
  std::size_t best = 0;
  separation = -1e300;
  for (std::size_t side = 0; side < 4; ++side)
  {
    const Vector2 normal = OutwardNormal(of, side);
    double here = 1e300;
    for (const Vector2& corner : other) here = std::min(here, normal.dot(corner - of[side]));
    if (here <= separation) continue;
    separation = here;
    best = side;
  }
  return best;
}

PlaneContact TwoBoxes(const Prism& a, const Prism& b)
{
  const Corners corners_a = a.CornersOfBox();
  const Corners corners_b = b.CornersOfBox();
  double separation_a = 0;
  double separation_b = 0;
  const std::size_t side_a = BestSide(corners_a, corners_b, separation_a);
  const std::size_t side_b = BestSide(corners_b, corners_a, separation_b);
  const bool by_b = separation_b > separation_a + kSameSide;
  const Corners& of = by_b ? corners_b : corners_a;
  const Corners& other = by_b ? corners_a : corners_b;
  const std::size_t side = by_b ? side_b : side_a;
  const Vector2 normal = OutwardNormal(of, side);

  // The side of the other box that faces this one, as far as it lies beside it.
  std::size_t facing = 0;
  for (std::size_t k = 1; k < 4; ++k)
    if (OutwardNormal(other, k).dot(normal) < OutwardNormal(other, facing).dot(normal)) facing = k;
  const Vector2 from = other[facing];
  const Vector2 edge = other[(facing + 1) % 4] - from;
  const Vector2 along = of[(side + 1) % 4] - of[side];
  const double start = along.dot(from - of[side]);
  const double rate = along.dot(edge);  // negative: the sides run against each other
  double first = 0;
  double last = 1;
  if (rate != 0)
  {
    first = std::max(first, (along.squaredNorm() - start) / rate);
    last = std::min(last, -start / rate);
  }

  PlaneContact contact;
  contact.normal = by_b ? normal : -normal;
  const auto add = [&](const Vector2& point) {
    contact.points[contact.count++] = {point, -normal.dot(point - of[side])};
  };
  if (first <= last)
  {
    add(from + edge * first);
    add(from + edge * last);
    return contact;
  }
  // They meet at corners.
  const Vector2 far = from + edge;
  add(normal.dot(from) < normal.dot(far) ? from : far);
  return contact;
}

}  // namespace

PlaneContact Meet(const Prism& a, const Prism& b)
{
  if (a.radius > 0 && b.radius > 0) return TwoCircles(a, b);
  if (a.radius == 0 && b.radius == 0) return TwoBoxes(a, b);
  if (a.radius > 0) return CircleAtBox(a, b);
  PlaneContact contact = CircleAtBox(b, a);
  contact.normal = -contact.normal;
  return contact;
}

int CollideUprightPrisms(dGeomID geom_a, dGeomID geom_b, const Vector3& way, std::span<dContactGeom> contacts)
{
  std::optional<Prism> a = PrismOf(geom_a);
  if (!a) return -1;
  std::optional<Prism> b = PrismOf(geom_b);
  if (!b) return -1;
  const double low = std::max(a->middle - a->half_height, b->middle - b->half_height);
  const double high = std::min(a->middle + a->half_height, b->middle + b->half_height);
  if (low >= high) return -1;
  const double middle = (low + high) / 2;
  a->AtHeight(middle);
  b->AtHeight(middle);
  const PlaneContact plane = Meet(*a, *b);
  if (plane.count == 0) return -1;

  const Vector3 normal(plane.normal.x(), plane.normal.y(), 0);
  const double lean = plane.normal.dot(a->slope - b->slope);  // of the gap, per metre of height
  const Vector2 slope = (a->slope + b->slope) / 2;
  double deepest = 0;
  for (const PlanePoint& point : std::span(plane.points).first(plane.count))
    deepest = std::max(deepest, point.depth + std::abs(lean) * (high - low) / 2);
  if (deepest <= 0) return 0;
  if (deepest > high - low) return -1;  // one stands on the other

  const double gap = PatchGap(normal, way);
  std::size_t count = 0;
  for (const PlanePoint& point : std::span(plane.points).first(plane.count))
  {
    for (const double height : {low, high})
    {
      const double depth = point.depth - lean * (height - middle);
      if (depth <= -gap || count == contacts.size()) continue;
      const Vector2 place = point.point + slope * (height - middle);
      contacts[count++] = ContactAt({place.x(), place.y(), height}, normal, depth, geom_a, geom_b);
    }
  }
  return static_cast<int>(count);
}

}  // namespace swarmanoid::dynamics3d

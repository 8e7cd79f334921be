#include "engine_worker/engines/dynamics3d/hull_contacts.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "engine_worker/engines/dynamics3d/collide.h"
#include "engine_worker/engines/dynamics3d/ode_world.h"
#include "engine_worker/engines/dynamics3d/polytope.h"
#include "engine_worker/engines/dynamics3d/upright_contacts.h"

namespace swarmanoid::dynamics3d
{
namespace
{

// A face is chosen as the axis of least overlap unless edges overlap less by this factor and length. So a body that
// rests on a face keeps this axis.
constexpr double kEdgeFactor = 0.95;
constexpr double kEdgeMargin = 1e-5;  // m
constexpr double kSameFace = 1e-6;    // m: the first body's face, if both overlap by as much

struct Touching
{
  Vector3 point;
  double depth;  // m; negative: a gap
};

bool IsTouching(const Touching& point) { return point.depth > 0; }

// The buffers of a thread.
struct Workspace
{
  Polytope a;
  Polytope b;
  Vector3 way;  // of a against b, within the step
  std::vector<Vector3> polygon;
  std::vector<Vector3> clipped;
  std::vector<Touching> found;
};

Workspace& OwnWorkspace()
{
  static thread_local Workspace workspace;
  return workspace;
}

const ConvexHull& HullOfGeom(dGeomID geom) { return static_cast<const Solid*>(dGeomGetData(geom))->shape->Hull(); }

// An axis along which the overlap is least, from the first body to the second one.
struct Parting
{
  double separation = -std::numeric_limits<double>::infinity();  // m; positive: they do not touch
  Vector3 normal = Vector3::UnitZ();
  std::size_t face = 0;
  std::uint32_t edge_a = 0;
  std::uint32_t edge_b = 0;
};

Parting ByFaces(const Polytope& of, const Polytope& other)
{
  Parting best;
  for (std::size_t face = 0; face < of.Normals().size(); ++face)
  {
    const Vector3& normal = of.Normals()[face];
    std::size_t deepest = 0;
    const double separation = -other.Reach(-normal, deepest) - of.Distance(face);
    if (separation <= best.separation) continue;
    best.separation = separation;
    best.normal = normal;
    best.face = face;
    if (separation > 0) break;
  }
  return best;
}

// Returns whether the arcs from a to b and from c to d of the sphere of normals cross.
bool ArcsCross(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d)
{
  const Vector3 across_ab = b.cross(a);
  const Vector3 across_cd = d.cross(c);
  const double cba = c.dot(across_ab);
  const double dba = d.dot(across_ab);
  const double adc = a.dot(across_cd);
  const double bdc = b.dot(across_cd);
  return cba * dba < 0 && adc * bdc < 0 && cba * bdc > 0;
}

Parting ByEdges(const Polytope& a, const Polytope& b)
{
  Parting best;
  const auto& edges_a = a.Topology().edges;
  const auto& edges_b = b.Topology().edges;
  for (std::uint32_t i = 0; i < edges_a.size(); ++i)
  {
    const ConvexHull::Edge& edge_a = edges_a[i];
    const Vector3& from_a = a.Corners()[edge_a.corners[0]];
    const Vector3 along_a = a.Corners()[edge_a.corners[1]] - from_a;
    const Vector3& left = a.Normals()[edge_a.faces[0]];
    const Vector3& right = a.Normals()[edge_a.faces[1]];
    for (std::uint32_t j = 0; j < edges_b.size(); ++j)
    {
      const ConvexHull::Edge& edge_b = edges_b[j];
      if (!ArcsCross(left, right, -b.Normals()[edge_b.faces[0]], -b.Normals()[edge_b.faces[1]])) continue;
      const Vector3& from_b = b.Corners()[edge_b.corners[0]];
      const Vector3 along_b = b.Corners()[edge_b.corners[1]] - from_b;
      Vector3 axis = along_a.cross(along_b);
      const double square = axis.squaredNorm();
      if (square < 1e-6 * along_a.squaredNorm() * along_b.squaredNorm()) continue;
      axis /= std::sqrt(square);
      if (axis.dot(from_a - a.Centre()) < 0) axis = -axis;
      const double separation = axis.dot(from_b - from_a);
      if (separation <= best.separation) continue;
      best = {separation, axis, 0, i, j};
      if (separation > 0) return best;
    }
  }
  return best;
}

// Returns the middle of the shortest connection of two edges.
Vector3 BetweenEdges(const Polytope& a, const Polytope& b, const Parting& parting)
{
  const auto& edge_a = a.Topology().edges[parting.edge_a].corners;
  const auto& edge_b = b.Topology().edges[parting.edge_b].corners;
  const Vector3 from_a = a.Corners()[edge_a[0]];
  const Vector3 from_b = b.Corners()[edge_b[0]];
  const Vector3 u = a.Corners()[edge_a[1]] - from_a;
  const Vector3 v = b.Corners()[edge_b[1]] - from_b;
  const Vector3 w = from_a - from_b;
  const double uu = u.dot(u), uv = u.dot(v), vv = v.dot(v), uw = u.dot(w), vw = v.dot(w);
  const double area = uu * vv - uv * uv;
  const double s = std::clamp((uv * vw - vv * uw) / area, 0.0, 1.0);
  const double t = std::clamp((uu * vw - uv * uw) / area, 0.0, 1.0);
  return (from_a + s * u + from_b + t * v) / 2;
}

// Keeps the part of a polygon on the inner side of a plane, in `inside`.
void Clip(const std::vector<Vector3>& polygon, const Vector3& normal, double distance, std::vector<Vector3>& inner)
{
  inner.clear();
  for (std::size_t k = 0; k < polygon.size(); ++k)
  {
    const Vector3& here = polygon[k];
    const Vector3& next = polygon[(k + 1) % polygon.size()];
    const double out_here = normal.dot(here) - distance;
    const double out_next = normal.dot(next) - distance;
    if (out_here <= 0) inner.push_back(here);
    if ((out_here < 0 && out_next > 0) || (out_here > 0 && out_next < 0))
      inner.push_back(here + (next - here) * (out_here / (out_here - out_next)));
  }
}

// Finds the points at which the other body's opposite face reaches below a face, or nearly: the face is clipped, and
// points above it by more than `gap` (m) are dropped.
void TouchFace(const Polytope& of, const Polytope& other, const Parting& parting, double gap, Workspace& work)
{
  const ConvexHull& shape = of.Topology();
  const ConvexHull& other_shape = other.Topology();
  work.polygon.clear();
  for (const std::uint32_t corner : other_shape.faces[other.FaceAgainst(parting.normal)].corners)
    work.polygon.push_back(other.Corners()[corner]);
  const std::vector<std::uint32_t>& around = shape.faces[parting.face].corners;
  for (std::size_t k = 0; k < around.size(); ++k)
  {
    const Vector3& from = of.Corners()[around[k]];
    const Vector3 along = of.Corners()[around[(k + 1) % around.size()]] - from;
    const Vector3 outwards = along.cross(parting.normal);
    Clip(work.polygon, outwards, outwards.dot(from), work.clipped);
    std::swap(work.polygon, work.clipped);
  }
  for (const Vector3& point : work.polygon)
    if (const double depth = of.Distance(parting.face) - parting.normal.dot(point); depth > -gap)
      work.found.push_back({point, depth});
  if (std::ranges::any_of(work.found, IsTouching)) return;
  work.found.clear();
  std::size_t deepest = 0;
  other.Reach(-parting.normal, deepest);
  work.found.push_back({other.Corners()[deepest], -parting.separation});
}

// Keeps the deepest contact, then the contacts that are farthest from those already kept.
void KeepFew(std::vector<Touching>& found, std::size_t room)
{
  if (found.size() <= room) return;
  std::iter_swap(found.begin(), std::ranges::max_element(found, {}, &Touching::depth));
  for (std::size_t kept = 1; kept < room; ++kept)
  {
    std::size_t farthest = kept;
    double distance = -1;
    for (std::size_t k = kept; k < found.size(); ++k)
    {
      double nearest = std::numeric_limits<double>::infinity();
      for (std::size_t other = 0; other < kept; ++other)
        nearest = std::min(nearest, (found[k].point - found[other].point).squaredNorm());
      if (nearest <= distance) continue;
      distance = nearest;
      farthest = k;
    }
    std::swap(found[kept], found[farthest]);
  }
  found.resize(room);
}

// `normal` points into the first geom.
int Put(std::vector<Touching>& found, const Vector3& normal, dGeomID first, dGeomID second,
        std::span<dContactGeom> contacts)
{
  KeepFew(found, contacts.size());
  for (std::size_t k = 0; k < found.size(); ++k)
    contacts[k] = ContactAt(found[k].point, normal, found[k].depth, first, second);
  return static_cast<int>(found.size());
}

enum class Meeting : std::uint8_t
{
  kApart,
  kFaceOfA,
  kFaceOfB,
  kEdges
};

// Finds where two bodies with faces touch; the normal points from a to b.
Meeting TouchPolytopes(Workspace& work, Vector3& normal)
{
  const Parting by_a = ByFaces(work.a, work.b);
  if (by_a.separation > 0) return Meeting::kApart;
  const Parting by_b = ByFaces(work.b, work.a);
  if (by_b.separation > 0) return Meeting::kApart;
  const Parting by_edges = ByEdges(work.a, work.b);
  if (by_edges.separation > 0) return Meeting::kApart;

  const double by_faces = std::max(by_a.separation, by_b.separation);
  if (by_edges.separation > kEdgeFactor * by_faces + kEdgeMargin)
  {
    normal = by_edges.normal;
    work.found.push_back({BetweenEdges(work.a, work.b, by_edges), -by_edges.separation});
    return Meeting::kEdges;
  }
  if (by_b.separation > by_a.separation + kSameFace)
  {
    normal = -by_b.normal;
    TouchFace(work.b, work.a, by_b, PatchGap(by_b.normal, work.way), work);
    return Meeting::kFaceOfB;
  }
  normal = by_a.normal;
  TouchFace(work.a, work.b, by_a, PatchGap(-by_a.normal, work.way), work);
  return Meeting::kFaceOfA;
}

int CollidePolytopes(Workspace& work, dGeomID hull, dGeomID other, std::span<dContactGeom> contacts)
{
  Vector3 normal;
  return TouchPolytopes(work, normal) == Meeting::kApart ? 0 : Put(work.found, -normal, hull, other, contacts);
}

// The point of a face that is nearest to another one.
Vector3 NearestOfFace(const Polytope& body, std::size_t face, const Vector3& point)
{
  const std::vector<std::uint32_t>& around = body.Topology().faces[face].corners;
  const Vector3& normal = body.Normals()[face];
  Vector3 nearest = point - normal * (normal.dot(point) - body.Distance(face));
  double distance = std::numeric_limits<double>::infinity();
  bool inside = true;
  Vector3 on_edge = nearest;
  for (std::size_t k = 0; k < around.size(); ++k)
  {
    const Vector3& from = body.Corners()[around[k]];
    const Vector3 along = body.Corners()[around[(k + 1) % around.size()]] - from;
    if (along.cross(normal).dot(point - from) <= 0) continue;
    inside = false;
    const Vector3 here = from + along * std::clamp(along.dot(point - from) / along.squaredNorm(), 0.0, 1.0);
    if ((here - point).squaredNorm() >= distance) continue;
    distance = (here - point).squaredNorm();
    on_edge = here;
  }
  return inside ? nearest : on_edge;
}

// The point of the surface that is nearest to another one, and how far that is inside the body; negative outside.
// `normal`: the way out.
Vector3 NearestOfSurface(const Polytope& body, const Vector3& point, double& depth, Vector3& normal)
{
  std::size_t shallowest = 0;
  for (std::size_t face = 1; face < body.Normals().size(); ++face)
    if (body.Normals()[face].dot(point) - body.Distance(face) >
        body.Normals()[shallowest].dot(point) - body.Distance(shallowest))
      shallowest = face;
  depth = body.Distance(shallowest) - body.Normals()[shallowest].dot(point);
  normal = body.Normals()[shallowest];
  if (depth >= 0) return point + normal * depth;
  Vector3 nearest = Vector3::Zero();
  double square = std::numeric_limits<double>::infinity();
  for (std::size_t face = 0; face < body.Normals().size(); ++face)
  {
    if (body.Normals()[face].dot(point) <= body.Distance(face)) continue;
    const Vector3 here = NearestOfFace(body, face, point);
    if ((here - point).squaredNorm() >= square) continue;
    square = (here - point).squaredNorm();
    nearest = here;
  }
  depth = -std::sqrt(square);
  if (square > 0) normal = (point - nearest) / -depth;
  return nearest;
}

int CollideWithBall(const Polytope& body, const Vector3& centre, double radius, dGeomID hull, dGeomID other,
                    std::span<dContactGeom> contacts)
{
  double depth = 0;
  Vector3 normal;
  const Vector3 nearest = NearestOfSurface(body, centre, depth, normal);
  if (depth + radius < 0) return 0;
  std::vector<Touching>& found = OwnWorkspace().found;
  found.assign(1, {nearest, depth + radius});
  return Put(found, -normal, hull, other, contacts);
}

// Treats the capsule as a row of balls, at most half a radius apart. The deepest ball in each half of the capsule gives
// a contact.
int CollideCapsule(const Polytope& body, dGeomID hull, dGeomID capsule, std::span<dContactGeom> contacts)
{
  dReal radius = 0;
  dReal length = 0;
  dGeomCapsuleGetParams(capsule, &radius, &length);
  const Vector3 axis = AxesOf(capsule).col(2);
  const Vector3 centre = VectorOf(dGeomGetPosition(capsule));
  const int balls = 2 + static_cast<int>(std::ceil(2 * length / radius));
  int count = 0;
  for (int k = 0; k < balls && count < static_cast<int>(contacts.size()); ++k)
  {
    const int half = 2 * k < balls ? 0 : 1;
    dContactGeom contact;
    const Vector3 at = centre + axis * (length * (static_cast<double>(k) / (balls - 1) - 0.5));
    if (CollideWithBall(body, at, radius, hull, capsule, {&contact, 1}) == 0) continue;
    if (count > half && contacts[static_cast<std::size_t>(count) - 1].depth >= contact.depth) continue;
    if (count <= half) count = std::min(count + 1, half + 1);
    contacts[static_cast<std::size_t>(count) - 1] = contact;
  }
  return count;
}

int CollidePlane(const Polytope& body, dGeomID hull, dGeomID plane_geom, std::span<dContactGeom> contacts)
{
  dVector4 plane;
  dGeomPlaneGetParams(plane_geom, plane);
  const Vector3 normal(plane[0], plane[1], plane[2]);
  std::vector<Touching>& found = OwnWorkspace().found;
  bool is_flat = false;
  for (const Vector3& face : body.Normals()) is_flat = is_flat || -face.dot(normal) > kFlatCosine;
  const double gap = is_flat ? PatchGap(normal, OwnWorkspace().way) : 0;
  for (const Vector3& corner : body.Corners())
    if (const double depth = plane[3] - normal.dot(corner); depth >= -gap) found.push_back({corner, depth});
  if (std::ranges::none_of(found, [](const Touching& point) { return point.depth >= 0; })) found.clear();
  return Put(found, normal, hull, plane_geom, contacts);
}

// Finds the point at which a ray enters the hull. A ray that begins inside has no contact.
int CollideRay(const Polytope& body, dGeomID hull, dGeomID ray, std::span<dContactGeom> contacts)
{
  dVector3 start;
  dVector3 direction;
  dGeomRayGet(ray, start, direction);
  const Vector3 from = VectorOf(start);
  const Vector3 along = VectorOf(direction);
  double enter = -1;
  double leave = dGeomRayGetLength(ray);
  Vector3 normal = Vector3::Zero();
  for (std::size_t face = 0; face < body.Normals().size(); ++face)
  {
    const double outside = body.Normals()[face].dot(from) - body.Distance(face);
    const double approach = -body.Normals()[face].dot(along);
    if (approach > 0 && outside / approach > enter)
    {
      enter = outside / approach;
      normal = body.Normals()[face];
    }
    if (approach < 0) leave = std::min(leave, outside / approach);
    if (approach == 0 && outside > 0) return 0;
  }
  if (enter < 0 || enter > leave) return 0;
  std::vector<Touching>& found = OwnWorkspace().found;
  found.assign(1, {from + along * enter, enter});
  return Put(found, -normal, hull, ray, contacts);
}

// Contacts with a side of the prism, led back to the round side of the cylinder: a face touches it along a line, a
// corner less deep the farther it is from the middle of the prism's side.
void MakeRound(std::vector<Touching>& found, const Vector3& centre, const Vector3& sideways, double radius, bool flat,
               double gap)
{
  for (Touching& touching : found)
  {
    const double off = sideways.dot(touching.point - centre);
    if (flat)
      touching.point -= sideways * off;
    else
      touching.depth -= radius - std::sqrt(std::max(0.0, radius * radius - off * off));
  }
  std::erase_if(found, [&](const Touching& touching) { return touching.depth <= -gap; });
  if (std::ranges::none_of(found, IsTouching)) found.clear();
  // The corners of a side come together in pairs.
  constexpr double kTwins = 1e-5;  // m
  for (std::size_t k = 0; k < found.size(); ++k)
    found.erase(std::remove_if(found.begin() + static_cast<std::ptrdiff_t>(k) + 1, found.end(),
                               [&](const Touching& other)
                               { return (other.point - found[k].point).squaredNorm() < kTwins * kTwins; }),
                found.end());
}

int CollideCylinder(Workspace& work, dGeomID hull, dGeomID cylinder, std::span<dContactGeom> contacts)
{
  constexpr double kSide = 0.94;           // a normal within 20 degrees of the cylinder's side
  constexpr double kParallelFaces = 1e-3;  // between the normals of two faces
  const Vector3 centre = VectorOf(dGeomGetPosition(cylinder));
  double depth = 0;
  Vector3 out;
  const Vector3 nearest = NearestOfSurface(work.a, centre, depth, out);
  work.b.SetCylinder(cylinder, depth < 0 ? Vector3(nearest - centre) : Vector3(-out));
  Vector3 normal;
  const Meeting meeting = TouchPolytopes(work, normal);
  if (meeting == Meeting::kApart) return 0;
  const Vector3 axis = AxesOf(cylinder).col(2);
  const Vector3 across = normal - axis * axis.dot(normal);
  const double slope = std::sqrt(across.squaredNorm());
  if (slope > kSide && meeting != Meeting::kEdges)
  {
    dReal radius = 0;
    dReal length = 0;
    dGeomCylinderGetParams(cylinder, &radius, &length);
    const Vector3& face = work.a.Normals()[work.a.FaceAgainst(-normal)];
    const bool flat = meeting == Meeting::kFaceOfA || (face - normal).squaredNorm() < kParallelFaces * kParallelFaces;
    MakeRound(work.found, centre, axis.cross(across / slope), radius, flat, PatchGap(-normal, work.way));
  }
  return Put(work.found, -normal, hull, cylinder, contacts);
}

}  // namespace

bool HullMeets(int geom_class)
{
  return geom_class == dConvexClass || geom_class == dBoxClass || geom_class == dCylinderClass ||
         geom_class == dSphereClass || geom_class == dCapsuleClass || geom_class == dPlaneClass ||
         geom_class == dRayClass;
}

int CollideHull(dGeomID hull, dGeomID other, const Vector3& way, std::span<dContactGeom> contacts)
{
  Workspace& work = OwnWorkspace();
  work.way = way;
  work.found.clear();
  work.a.SetHull(HullOfGeom(hull), hull);
  switch (dGeomGetClass(other))
  {
    case dConvexClass:
      work.b.SetHull(HullOfGeom(other), other);
      return CollidePolytopes(work, hull, other, contacts);
    case dBoxClass:
      work.b.SetBox(other);
      return CollidePolytopes(work, hull, other, contacts);
    case dCylinderClass:
      return CollideCylinder(work, hull, other, contacts);
    case dSphereClass:
      return CollideWithBall(work.a, VectorOf(dGeomGetPosition(other)), dGeomSphereGetRadius(other), hull, other,
                             contacts);
    case dCapsuleClass:
      return CollideCapsule(work.a, hull, other, contacts);
    case dPlaneClass:
      return CollidePlane(work.a, hull, other, contacts);
    case dRayClass:
      return CollideRay(work.a, hull, other, contacts);
    default:
      return 0;
  }
}

}  // namespace swarmanoid::dynamics3d

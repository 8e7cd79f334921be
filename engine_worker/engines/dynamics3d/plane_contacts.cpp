// Problem: a body that lies on a plane leans by some 0.02 degrees. If only the points in the plane bear it, it falls
// onto the others in each step, and rocks.
//
// Method: the corners of a box and points of a cylinder's rims count if they are in the plane. If a face lies flat, its
// points also count with a gap of up to PatchGap (upright_contacts.h), within which the step would bring them.
//
// Invariants: contacts follow from both poses and `way`. If no point is in the plane, there is no contact. Normals
// point into the first geom, as in ODE.
#include "engine_worker/engines/dynamics3d/plane_contacts.h"

#include <array>
#include <cmath>

#include "engine_worker/engines/dynamics3d/collide.h"
#include "engine_worker/engines/dynamics3d/upright_contacts.h"

namespace swarmanoid::dynamics3d
{
namespace
{

constexpr double kFlatRim = 0.99;  // cosine of 8 degrees

// Collects the points of one geom that count against a plane.
class PointsOnPlane
{
public:
  PointsOnPlane(dGeomID geom, dGeomID plane, std::span<dContactGeom> contacts)
      : geom_(geom), plane_(plane), contacts_(contacts)
  {
    dVector4 parameters;
    dGeomPlaneGetParams(plane, parameters);
    normal_ = {parameters[0], parameters[1], parameters[2]};
    distance_ = parameters[3];
  }

  const Vector3& Normal() const { return normal_; }
  void SetGap(double gap) { gap_ = gap; }
  void Add(const Vector3& point)
  {
    const double depth = distance_ - normal_.dot(point);
    if (depth < -gap_ || count_ == contacts_.size()) return;
    touches_ = touches_ || depth >= 0;
    contacts_[count_++] = ContactAt(point, normal_, depth, geom_, plane_);
  }
  int Count() const { return touches_ ? static_cast<int>(count_) : 0; }

private:
  dGeomID geom_;
  dGeomID plane_;
  std::span<dContactGeom> contacts_;
  Vector3 normal_;
  double distance_ = 0;
  double gap_ = 0;
  std::size_t count_ = 0;
  bool touches_ = false;
};

Vector3 AxisOf(dGeomID geom, int k)
{
  const dReal* rotation = dGeomGetRotation(geom);
  return {rotation[k], rotation[4 + k], rotation[8 + k]};
}

Vector3 CentreOf(dGeomID geom)
{
  const dReal* position = dGeomGetPosition(geom);
  return {position[0], position[1], position[2]};
}

}  // namespace

int CollideBoxWithPlane(dGeomID box, dGeomID plane, const Vector3& way, std::span<dContactGeom> contacts)
{
  PointsOnPlane points(box, plane, contacts);
  dVector3 sides;
  dGeomBoxGetLengths(box, sides);
  std::array<Vector3, 3> halves;
  for (int k = 0; k < 3; ++k)
  {
    const Vector3 axis = AxisOf(box, k);
    halves[static_cast<std::size_t>(k)] = axis * (sides[k] / 2);
    if (std::abs(axis.dot(points.Normal())) > kFlatCosine) points.SetGap(PatchGap(points.Normal(), way));
  }
  const Vector3 centre = CentreOf(box);
  for (unsigned corner = 0; corner < 8; ++corner)
  {
    Vector3 point = centre;
    for (unsigned k = 0; k < 3; ++k) point += ((corner >> k) & 1U) != 0 ? halves[k] : -halves[k];
    points.Add(point);
  }
  return points.Count();
}

int CollideCylinderWithPlane(dGeomID cylinder, dGeomID plane, const Vector3& way, std::span<dContactGeom> contacts)
{
  PointsOnPlane points(cylinder, plane, contacts);
  dReal radius = 0;
  dReal length = 0;
  dGeomCylinderGetParams(cylinder, &radius, &length);
  const Vector3 axis = AxisOf(cylinder, 2);
  const double along = axis.dot(points.Normal());
  const Vector3 centre = CentreOf(cylinder);
  const Vector3 lower = centre - axis * (along > 0 ? length / 2 : -length / 2);
  const Vector3 upper = centre * 2 - lower;
  if (std::abs(along) > kFlatCosine) points.SetGap(PatchGap(points.Normal(), way));

  // The rim's deepest point, of both rims for a cylinder that lies.
  const Vector3 down = axis * along - points.Normal();
  const double slope = std::sqrt(down.squaredNorm());
  if (slope > 1e-9)
  {
    points.Add(lower + down * (radius / slope));
    if (std::abs(along) < kFlatCosine) points.Add(upper + down * (radius / slope));
  }
  // A rim that lies flat gets contacts at points fixed to the rim, so that it does not wobble.
  if (std::abs(along) > kFlatRim)
  {
    const Vector3 x = AxisOf(cylinder, 0) * radius;
    const Vector3 y = AxisOf(cylinder, 1) * radius;
    for (const Vector3& arm : {x, y, Vector3(-x), Vector3(-y)}) points.Add(lower + arm);
  }
  return points.Count();
}

}  // namespace swarmanoid::dynamics3d

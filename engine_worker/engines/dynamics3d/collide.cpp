#include "engine_worker/engines/dynamics3d/collide.h"

#include <utility>

#include "engine_worker/engines/dynamics3d/cylinder_contacts.h"
#include "engine_worker/engines/dynamics3d/hull_contacts.h"
#include "engine_worker/engines/dynamics3d/plane_contacts.h"
#include "engine_worker/engines/dynamics3d/upright_contacts.h"

namespace swarmanoid::dynamics3d
{
namespace
{

// Contacts as seen from the other geom.
int Flipped(std::span<dContactGeom> contacts, int count)
{
  for (dContactGeom& contact : contacts.first(static_cast<std::size_t>(count)))
  {
    std::swap(contact.g1, contact.g2);
    for (int k = 0; k < 3; ++k) contact.normal[k] = -contact.normal[k];
  }
  return count;
}

// Returns the number of contacts, or -1 for a pair that ODE handles.
int CollideByUs(dGeomID a, dGeomID b, const Vector3& way, std::span<dContactGeom> contacts)
{
  if (const int count = CollideUprightPrisms(a, b, way, contacts); count >= 0) return count;
  const int class_a = dGeomGetClass(a);
  const int class_b = dGeomGetClass(b);
  if (class_a == dCylinderClass && class_b == dCylinderClass) return CollideParallelCylinders(a, b, way, contacts);
  if (class_b == dPlaneClass && class_a == dBoxClass) return CollideBoxWithPlane(a, b, way, contacts);
  if (class_b == dPlaneClass && class_a == dCylinderClass) return CollideCylinderWithPlane(a, b, way, contacts);
  if (class_a == dPlaneClass && (class_b == dBoxClass || class_b == dCylinderClass))
    return Flipped(contacts, CollideByUs(b, a, -way, contacts));
  if (class_a == dConvexClass && HullMeets(class_b)) return CollideHull(a, b, way, contacts);
  if (class_b == dConvexClass && HullMeets(class_a)) return Flipped(contacts, CollideHull(b, a, -way, contacts));
  return -1;
}

}  // namespace

HullShape::HullShape(const ConvexHull& hull) : hull_(hull), centre_(hull.centre)
{
  for (Vector3& corner : hull_.corners) corner -= centre_;
  for (ConvexHull::Face& face : hull_.faces) face.distance -= face.normal.dot(centre_);
  hull_.centre = Vector3::Zero();
  for (const Vector3& corner : hull_.corners) corners_.insert(corners_.end(), {corner.x(), corner.y(), corner.z()});
  for (const ConvexHull::Face& face : hull_.faces)
  {
    planes_.insert(planes_.end(), {face.normal.x(), face.normal.y(), face.normal.z(), face.distance});
    faces_.push_back(static_cast<unsigned>(face.corners.size()));
    faces_.insert(faces_.end(), face.corners.begin(), face.corners.end());
  }
}

dGeomID HullShape::MakeGeom() const
{
  return dCreateConvex(nullptr, planes_.data(), static_cast<unsigned>(hull_.faces.size()), corners_.data(),
                       static_cast<unsigned>(hull_.corners.size()), faces_.data());
}

int Collide(dGeomID first, dGeomID second, std::span<dContactGeom> contacts, const Vector3& way)
{
  const int count = CollideByUs(first, second, way, contacts);
  if (count >= 0) return count;
  return dCollide(first, second, static_cast<int>(contacts.size()), contacts.data(), sizeof(dContactGeom));
}

}  // namespace swarmanoid::dynamics3d

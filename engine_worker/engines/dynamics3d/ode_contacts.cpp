// Contacts of OdeWorld: where two solids meet, and with what friction.
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "engine_worker/engines/dynamics3d/collide.h"
#include "engine_worker/engines/dynamics3d/ode_world.h"

namespace swarmanoid::dynamics3d
{
namespace
{

constexpr double kCasterDamping = 0.05;  // s: N s/m per N/m
// Slower than this a contact is taken to stick, and its friction works along the pull of gravity.
constexpr double kSlip = 1e-3;  // m/s

// Overlapping objects separate by a fifth of the overlap in a step, limited by this speed. At steps of 5 ms the limit
// applies to overlaps below 7.5 mm; deeper ones separate by a fiftieth. ODE turns this correction into a velocity that
// bodies keep, so faster correction would make objects bounce. Robots are solved with few iterations and need the
// fifth.
constexpr double kPartingSpeed = 0.03;  // m/s
constexpr double kLargestPart = 0.2;
constexpr double kSmallestPart = 0.02;

bool IsGround(const Solid& solid) { return solid.surface == ESurface::kGround || solid.surface == ESurface::kTerrain; }

// Returns the friction between two bodies, of which one may be the ground.
double FrictionOf(const Solid& a, const Solid& b, double of_world)
{
  if (IsGround(a)) return b.touch.ground_friction.value_or(of_world);
  if (IsGround(b)) return a.touch.ground_friction.value_or(of_world);
  return std::sqrt(a.touch.friction.value_or(of_world) * b.touch.friction.value_or(of_world));
}

}  // namespace

void OdeWorld::MakeContacts(const Solid& a, const Solid& b, std::uint32_t pair)
{
  std::array<dContactGeom, kMaximumVoxelContacts> contacts;
  const bool voxels = a.layer == ELayer::kVoxels || b.layer == ELayer::kVoxels;
  const int count =
      Collide(a.geom, b.geom, std::span(contacts).first(voxels ? kMaximumVoxelContacts : kMaximumContacts));
  for (int k = 0; k < count; ++k)
  {
    const dContactGeom& contact = contacts[static_cast<std::size_t>(k)];
    if (Accept(contact, a, b)) AddContact(contact, a, b, pair);
  }
}

bool OdeWorld::Accept(const dContactGeom& contact, const Solid& a, const Solid& b) const
{
  for (const Solid* solid : {&a, &b})
  {
    if (solid->surface == ESurface::kGround && is_open_ && is_open_(VectorOf(contact.pos))) return false;
    if (solid->surface == ESurface::kWheel)
    {
      const Vector3 axle = VectorToWorld(dGeomGetBody(solid->geom), Vector3::UnitY());
      if (std::abs(axle.dot(VectorOf(contact.normal))) > kWheelFlank) return false;
    }
  }
  return true;
}

void OdeWorld::AddContact(const dContactGeom& geometry, const Solid& a, const Solid& b, std::uint32_t pair)
{
  const dBodyID body_a = dGeomGetBody(a.geom);
  const dBodyID body_b = dGeomGetBody(b.geom);
  if (body_a == nullptr && body_b == nullptr) return;

  dContact contact{};
  contact.geom = geometry;
  dSurfaceParameters& surface = contact.surface;
  surface.mode = dContactApprox1;
  const Vector3 normal = VectorOf(geometry.normal);
  Vector3 along = Vector3::Zero();

  if (a.surface == ESurface::kCaster || b.surface == ESurface::kCaster)
  {
    // A spring and a damper as ODE's error reduction and constraint force mixing.
    surface.mode |= dContactSoftERP | dContactSoftCFM;
    const double stiffness = (a.surface == ESurface::kCaster ? a : b).touch.caster_stiffness;
    surface.soft_erp = step_seconds_ / (step_seconds_ + kCasterDamping);
    surface.soft_cfm = 1 / (stiffness * (step_seconds_ + kCasterDamping));
  }
  else if (a.surface == ESurface::kWheel || b.surface == ESurface::kWheel)
  {
    const bool first = a.surface == ESurface::kWheel;
    const std::optional<double> other = (first ? b : a).touch.friction;
    surface.mu = other ? std::sqrt(settings_.wheel_friction * *other) : settings_.wheel_friction;
    const dBodyID wheel = first ? body_a : body_b;
    // Rolls on its own radius, however deep it stands in the ground.
    const double radius = dGeomSphereGetRadius(first ? a.geom : b.geom);
    const Vector3 foot = VectorOf(dBodyGetPosition(wheel)) - normal * (first ? radius : -radius);
    for (int k = 0; k < 3; ++k) contact.geom.pos[k] = foot[k];
    along = VectorToWorld(wheel, Vector3::UnitY()).cross(normal);
  }
  else
  {
    surface.mu = FrictionOf(a, b, settings_.friction);
    // ODE's friction is a box: put its first edge along the slip, or along the slip that gravity asks for.
    const Vector3 point = VectorOf(geometry.pos);
    Vector3 slip = Vector3::Zero();
    if (body_a != nullptr) slip += PointVelocity(body_a, point);
    if (body_b != nullptr) slip -= PointVelocity(body_b, point);
    along = slip - normal * normal.dot(slip);
    const bool of_object = a.layer == ELayer::kObject || b.layer == ELayer::kObject;
    // An object that slides on the ground is not held across: friction is along the slip alone.
    if (along.squaredNorm() < kSlip * kSlip)
      along = settings_.gravity - normal * normal.dot(settings_.gravity);
    else if (of_object && (IsGround(a) || IsGround(b)))
      surface.mode |= dContactMu2;
    if (of_object && geometry.depth > 0)
    {
      surface.mode |= dContactSoftERP;
      surface.soft_erp = std::clamp(kPartingSpeed * step_seconds_ / geometry.depth, kSmallestPart, kLargestPart);
    }
  }
  const double length = std::sqrt(along.squaredNorm());
  if (length > 1e-9)
  {
    surface.mode |= dContactFDir1;
    for (int k = 0; k < 3; ++k) contact.fdir1[k] = along[k] / length;
  }
  const double restitution = std::max(a.touch.restitution.value_or(settings_.restitution),
                                      b.touch.restitution.value_or(settings_.restitution));
  if (restitution > 0)
  {
    surface.mode |= dContactBounce;
    surface.bounce = restitution;
    surface.bounce_vel = 0.05;
  }
  const auto number = [](dBodyID body) { return body == nullptr ? -1 : NumberOf(body); };
  contacts_.push_back({contact, number(body_a), number(body_b), pair});
}

}  // namespace swarmanoid::dynamics3d

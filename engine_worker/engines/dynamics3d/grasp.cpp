#include "engine_worker/engines/dynamics3d/grasp.h"

namespace swarmanoid::dynamics3d
{

bool Grasp::Accepts(const Solid& solid, std::uint32_t robot, const Grasp* other_hand) const
{
  const dBodyID body = dGeomGetBody(solid.geom);
  if (body == nullptr) return geometry_.holds_static;
  if (dBodyIsKinematic(body) || !scene_.CanBeHeld(solid.entity)) return false;
  // The two hands of a robot may share a thing, but not hold two.
  if (other_hand != nullptr && other_hand->HoldsMovable()) return other_hand->Held() == solid.entity;
  return !scene_.links.AreConnected(robot, solid.entity);
}

void Grasp::TryToHold(std::uint32_t robot, int body, const Vector3& tip, const Vector3& anchor, const Vector3& axis,
                      const Grasp* other_hand)
{
  const Solid* solid = scene_.world.FindTouching(tip, geometry_.probe_radius, robot,
                                                 [&](const Solid& found) { return Accepts(found, robot, other_hand); });
  if (solid == nullptr) return;
  LinkSpec spec;
  spec.kind = ELink::kHinge;
  spec.body_a = body;
  spec.entity_a = robot;
  spec.entity_b = solid->entity;
  const dBodyID held = dGeomGetBody(solid->geom);
  spec.body_b = held == nullptr ? -1 : OdeWorld::NumberOf(held);
  for (int k = 0; k < 3; ++k)
  {
    spec.anchor[k] = anchor[k];
    spec.axis[k] = axis[k];
  }
  spec.motor_torque = geometry_.motor_torque;
  serial_ = scene_.links.Add(spec).Serial();
}

void Grasp::Release()
{
  scene_.links.Remove(serial_);
  serial_ = 0;
}

std::uint32_t Grasp::Held() const
{
  const Link* held = link();
  return held == nullptr ? kNoEntity : held->Spec().entity_b;
}

bool Grasp::HoldsMovable() const
{
  const Link* held = link();
  return held != nullptr && held->Spec().body_b >= 0;
}

}  // namespace swarmanoid::dynamics3d

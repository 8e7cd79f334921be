// Grasp: one gripper. It grips the body that it touches, at a point of its own body, and a motor (turret, wrist) turns
// the gripped body. Used by the models of footbots and handbots.
#pragma once

#include <functional>

#include "engine_worker/engines/dynamics3d/model.h"

namespace swarmanoid::dynamics3d
{

struct GraspGeometry
{
  double probe_radius = 0.02;  // m: how far around its tip the gripper finds things
  double motor_torque = 0.5;   // N m
  bool holds_static = false;   // also takes hold of what never moves, such as a shelf
};

class Grasp
{
public:
  Grasp(Scene& scene, const GraspGeometry& geometry) : scene_(scene), geometry_(geometry) {}

  // Grips the body that the tip touches, if the structural tree allows it: no loops, and no body of another engine.
  // `other_hand` is the robot's other hand, which may hold the same body. Tip and axis are in the frame of the engine.
  void TryToHold(std::uint32_t robot, int body, const Vector3& tip, const Vector3& anchor, const Vector3& axis,
                 const Grasp* other_hand);
  void Release();

  bool IsHolding() const { return link() != nullptr; }
  // Returns the entity held, kNoEntity for none.
  std::uint32_t Held() const;
  bool HoldsMovable() const;
  Link* link() { return scene_.links.Find(serial_); }
  const Link* link() const { return static_cast<const LinkTable&>(scene_.links).Find(serial_); }

  void Save(ByteWriter& state) const { state.Put(serial_); }
  void Load(ByteReader& state) { serial_ = state.Get<std::uint32_t>(); }

private:
  bool Accepts(const Solid& solid, std::uint32_t robot, const Grasp* other_hand) const;

  Scene& scene_;
  GraspGeometry geometry_;
  std::uint32_t serial_ = 0;
};

}  // namespace swarmanoid::dynamics3d

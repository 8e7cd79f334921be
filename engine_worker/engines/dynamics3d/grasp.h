// One gripper: a place on a body that takes hold of what it touches, and a motor (turret, wrist) that turns what it
// holds. Used by the models of footbots and handbots.
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

  // Takes hold of what the tip touches, if the rules of the structural tree let it: no loops, but for what `also_held`
  // (the robot's other hand) holds; nothing that another engine moves. Tip and axis in the frame of the engine.
  void TryToHold(std::uint32_t robot, int body, const Vector3& tip, const Vector3& anchor, const Vector3& axis,
                 const Grasp* other_hand);
  void Release();

  bool IsHolding() const { return link() != nullptr; }
  // The entity held, kNoEntity for none.
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

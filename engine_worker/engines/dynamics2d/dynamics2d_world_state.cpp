// Saved states of the world. Box2D remembers more than positions and velocities (contacts, impulses, the order of its
// lists), and there is no way to give that back to it. So a state is only the bits below, and a world continues from
// them after a rebuild, whether it was just saved or never stopped.
#include <cmath>
#include <stdexcept>

#include "common/math/elementary.h"
#include "engine_worker/engines/dynamics2d/dynamics2d_world.h"

namespace swarmanoid::dynamics2d
{

Dynamics2dWorld::BodyState Dynamics2dWorld::StateOf(const Body& body)
{
  if (body.b2 == nullptr) return body.start;
  const b2Body& b2 = *body.b2;
  return {b2.GetPosition().x,       b2.GetPosition().y,       b2.GetAngle(),
          b2.GetLinearVelocity().x, b2.GetLinearVelocity().y, b2.GetAngularVelocity()};
}

void Dynamics2dWorld::Rebuild()
{
  for (Body& body : bodies_) body.start = StateOf(body);
  WrapAngles();
  Build();
}

void Dynamics2dWorld::BeginAgain()
{
  for (Body& body : bodies_) body.start = StateOf(body);
  Build();
}

// Angles grow with every turn and lose precision; here they come back to -pi..pi, and the grips' angles with them.
void Dynamics2dWorld::WrapAngles()
{
  const auto wrap = [](float angle) { return std::abs(angle) > kPi ? static_cast<float>(WrapAngle(angle)) : angle; };
  for (Body& body : bodies_)
  {
    if (body.gripped == kNoBody) continue;
    const float own = body.start.angle;
    const float other = bodies_[Index(body.gripped)].start.angle;
    const double joint = static_cast<double>(other) - own - body.grip.reference_angle;
    if (wrap(own) == own && wrap(other) == other && std::abs(joint) <= kPi) continue;
    body.grip.reference_angle = static_cast<float>(static_cast<double>(wrap(other)) - wrap(own) - WrapAngle(joint));
  }
  for (Body& body : bodies_) body.start.angle = wrap(body.start.angle);
}

void Dynamics2dWorld::SaveState(ByteWriter& state) const
{
  state.Put(static_cast<std::uint64_t>(bodies_.size()));
  for (const Body& body : bodies_)
  {
    if (body.model.motion == EMotion::kStatic) continue;
    state.Put(StateOf(body));
    state.Put(body.remainder_x);
    state.Put(body.remainder_y);
    state.Put(static_cast<std::uint8_t>(body.solid ? 1 : 0));
    if (!body.model.has_gripper) continue;
    state.Put(body.turret_angle);
    state.Put(static_cast<std::uint8_t>(body.held_angle ? 1 : 0));
    if (body.held_angle) state.Put(*body.held_angle);
    state.Put(static_cast<std::int32_t>(body.gripped));
    state.Put(body.grip.anchor.x);
    state.Put(body.grip.anchor.y);
    state.Put(body.grip.reference_angle);
  }
}

void Dynamics2dWorld::LoadState(ByteReader& state)
{
  if (state.Get<std::uint64_t>() != bodies_.size())
    throw std::runtime_error("saved state of dynamics2d: it is of an experiment with another number of bodies");
  for (Body& body : bodies_)
  {
    if (body.model.motion == EMotion::kStatic) continue;
    body.start = state.Get<BodyState>();
    body.remainder_x = state.Get<double>();
    body.remainder_y = state.Get<double>();
    body.solid = state.Get<std::uint8_t>() != 0;
    if (!body.model.has_gripper) continue;
    body.turret_angle = state.Get<double>();
    const bool held = state.Get<std::uint8_t>() != 0;
    body.held_angle = held ? std::optional(state.Get<double>()) : std::nullopt;
    body.gripped = state.Get<std::int32_t>();
    if (body.gripped < kNoBody || body.gripped >= static_cast<int>(bodies_.size()))
      throw std::runtime_error("saved state of dynamics2d: a gripper holds a body that does not exist");
    body.grip.anchor.x = state.Get<float>();
    body.grip.anchor.y = state.Get<float>();
    body.grip.reference_angle = state.Get<float>();
  }
  Build();
}

}  // namespace swarmanoid::dynamics2d

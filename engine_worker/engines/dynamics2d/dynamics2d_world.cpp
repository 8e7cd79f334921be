// Problem: keep Box2D's bodies so that a saved state gives the bits of a run that never stopped.
//
// Method: Box2D remembers more than positions and velocities (contacts, impulses, the order of its lists), and it
// cannot be given that back. So a state is only the bits below. A world is made from them in the order of the bodies,
// whether it was just loaded or goes on (Rebuild). Box2D has single precision; what its positions lack is kept beside
// them (remainder_x, remainder_y).
//
// Invariants: Build depends on the bodies alone. Bodies that are isolated when a tick begins (isolated_bodies.cpp) are
// not in Box2D, so Build leaves out each body that may be.
#include "engine_worker/engines/dynamics2d/dynamics2d_world.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "common/math/elementary.h"

namespace swarmanoid::dynamics2d
{
namespace
{

double BeyondSinglePrecision(double x) { return x - static_cast<float>(x); }

}  // namespace

Dynamics2dWorld::Dynamics2dWorld(const WorldSettings& settings) : settings_(settings) {}
Dynamics2dWorld::~Dynamics2dWorld() = default;

int Dynamics2dWorld::AddBody(BodyModel model, const PlanePose& pose)
{
  Body& body = bodies_.emplace_back();
  body.model = std::move(model);
  SetPosition(body, pose.u * kUnitsPerMetre, pose.v * kUnitsPerMetre, static_cast<float>(pose.heading));
  return static_cast<int>(bodies_.size()) - 1;
}

void Dynamics2dWorld::Build()
{
  world_ = std::make_unique<b2World>(b2Vec2(0, 0));
  world_->SetAllowSleeping(false);
  // Kinematic, so that it joins all bodies to one island: Box2D takes the wall clock several times for each island.
  b2BodyDef ground;
  ground.type = b2_kinematicBody;
  ground_ = world_->CreateBody(&ground);
  last_step_ = 0;
  isolated_.clear();
  solved_.clear();
  ways_.clear();
  isolation_is_configured_ = false;
  MarkGripped();
  // A body that may be isolated is built when a tick begins in which it is not.
  for (Body& body : bodies_)
  {
    LeaveOut(body);
    if (!CanBeIsolated(body)) BuildBody(body);
  }
  for (Body& body : bodies_)
  {
    if (body.gripped == kNoBody) continue;
    BuildGrip(body);
    TurnGripper(body);
  }
}

void Dynamics2dWorld::BuildBody(Body& body)
{
  const BodyModel& model = body.model;
  b2BodyDef definition;
  definition.type = model.motion == EMotion::kDynamic     ? b2_dynamicBody
                    : model.motion == EMotion::kKinematic ? b2_kinematicBody
                                                          : b2_staticBody;
  definition.position.Set(body.start.x, body.start.y);
  definition.angle = body.start.angle;
  definition.linearVelocity.Set(body.start.vx, body.start.vy);
  definition.angularVelocity = body.start.turn;
  definition.enabled = body.solid;
  body.b2 = world_->CreateBody(&definition);
  body.ground = nullptr;
  body.gripper = nullptr;
  body.joint = nullptr;

  b2FixtureDef fixture = FixtureOf(body);
  b2CircleShape circle;
  b2PolygonShape polygon;
  if (model.radius > 0)
  {
    circle.m_radius = static_cast<float>(model.radius * kUnitsPerMetre);
    fixture.shape = &circle;
  }
  else
  {
    polygon = ShapeOf(model.polygon);
    fixture.shape = &polygon;
  }
  body.b2->CreateFixture(&fixture);
  if (model.has_gripper)
  {
    b2PolygonShape square;
    square.SetAsBox(1, 1);
    fixture.shape = &square;
    body.gripper = body.b2->CreateFixture(&fixture);
    TurnGripper(body);
  }

  if (model.motion != EMotion::kDynamic) return;
  b2MassData mass;
  mass.mass = static_cast<float>(model.mass);
  mass.center.SetZero();
  mass.I = static_cast<float>(model.inertia * kTorqueUnits);
  body.b2->SetMassData(&mass);

  b2MotorJointDef joint;
  joint.bodyA = ground_;
  joint.bodyB = body.b2;
  joint.collideConnected = true;
  joint.maxForce = static_cast<float>(model.ground_force * kForceUnits);
  joint.maxTorque = static_cast<float>(model.ground_torque * kTorqueUnits);
  joint.correctionFactor = kDriveGain;
  body.ground = static_cast<b2MotorJoint*>(world_->CreateJoint(&joint));
}

b2FixtureDef Dynamics2dWorld::FixtureOf(const Body& body) const
{
  b2FixtureDef fixture;
  fixture.density = 0;  // the mass of a body is set as a whole
  fixture.friction = static_cast<float>(body.model.friction);
  fixture.restitution = static_cast<float>(body.model.restitution);
  fixture.userData.pointer = static_cast<uintptr_t>(&body - bodies_.data());
  return fixture;
}

b2PolygonShape Dynamics2dWorld::ShapeOf(const std::vector<Vector2>& outline)
{
  std::array<b2Vec2, b2_maxPolygonVertices> points;
  for (std::size_t i = 0; i < outline.size(); ++i) points[i] = ToUnits(outline[i].x(), outline[i].y());
  b2PolygonShape polygon;
  polygon.Set(points.data(), static_cast<int32>(outline.size()));
  return polygon;
}

void Dynamics2dWorld::SetPosition(Body& body, double x, double y, float angle)
{
  body.remainder_x = BeyondSinglePrecision(x);
  body.remainder_y = BeyondSinglePrecision(y);
  const b2Vec2 position(static_cast<float>(x), static_cast<float>(y));
  if (body.b2 == nullptr)
  {
    body.start.x = position.x;
    body.start.y = position.y;
    body.start.angle = angle;
  }
  else if (position != body.b2->GetPosition() || angle != body.b2->GetAngle())
    body.b2->SetTransform(position, angle);
}

PlanePose Dynamics2dWorld::PoseOf(int number) const
{
  const Body& body = bodies_[Index(number)];
  const BodyState state = StateOf(body);
  return {(state.x + body.remainder_x) / kUnitsPerMetre, (state.y + body.remainder_y) / kUnitsPerMetre, state.angle};
}

PlaneVelocity Dynamics2dWorld::VelocityOf(int number) const
{
  const BodyState state = StateOf(bodies_[Index(number)]);
  return {state.vx / kUnitsPerMetre, state.vy / kUnitsPerMetre, state.turn};
}

void Dynamics2dWorld::Place(int number, const PlanePose& pose)
{
  // The float next to half a turn is a little more than that, so the heading is stated from the other side.
  constexpr auto kHalfTurn = static_cast<float>(kPi);
  const double other = pose.heading - std::copysign(2 * kPi, pose.heading);
  const bool is_half_turn = std::abs(static_cast<double>(kHalfTurn) - std::abs(other)) < 1e-12;
  SetPosition(bodies_[Index(number)], pose.u * kUnitsPerMetre, pose.v * kUnitsPerMetre,
              static_cast<float>(is_half_turn ? other : pose.heading));
  for (Body& body : bodies_)
    if (body.gripped == number || (body.gripped != kNoBody && &body == &bodies_[Index(number)])) CountTurns(body);
}

void Dynamics2dWorld::SetVelocity(int number, const PlaneVelocity& velocity)
{
  Body& body = bodies_[Index(number)];
  const b2Vec2 linear = ToUnits(velocity.u, velocity.v);
  const auto turn = static_cast<float>(velocity.turn);
  if (body.b2 != nullptr)
  {
    body.b2->SetLinearVelocity(linear);
    body.b2->SetAngularVelocity(turn);
    return;
  }
  body.start.vx = linear.x;
  body.start.vy = linear.y;
  body.start.turn = turn;
}

void Dynamics2dWorld::SetOutline(int number, const std::vector<Vector2>& polygon, double tolerance)
{
  Body& body = bodies_[Index(number)];
  std::vector<Vector2>& outline = body.model.polygon;
  const auto same = [=](const Vector2& a, const Vector2& b) { return (a - b).squaredNorm() <= tolerance * tolerance; };
  if (std::equal(outline.begin(), outline.end(), polygon.begin(), polygon.end(), same)) return;
  outline = polygon;
  isolation_is_configured_ = false;
  if (body.b2 == nullptr) return;
  body.b2->DestroyFixture(body.b2->GetFixtureList());
  const b2PolygonShape shape = ShapeOf(outline);
  b2FixtureDef fixture = FixtureOf(body);
  fixture.shape = &shape;
  body.b2->CreateFixture(&fixture);
}

void Dynamics2dWorld::SetSolid(int number, bool solid)
{
  Body& body = bodies_[Index(number)];
  if (body.solid == solid) return;
  body.solid = solid;
  if (body.b2 != nullptr) body.b2->SetEnabled(solid);
}

int Dynamics2dWorld::ContactCount() const
{
  int count = 0;
  for (const b2Contact* contact = world_->GetContactList(); contact != nullptr; contact = contact->GetNext())
    count += contact->IsTouching() ? 1 : 0;
  return count;
}

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

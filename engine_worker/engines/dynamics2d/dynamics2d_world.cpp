// Problem: keep Box2D's bodies so that a saved state gives the bits of a run that never stopped.
//
// Method: Box2D remembers more than positions and velocities (contacts, impulses, the order of its lists), and it
// cannot be given that back. So a state is only the bits below. A world is made from them in the order of the bodies,
// whether it was just loaded or goes on (Rebuild). Box2D has single precision; what its positions lack is kept beside
// them (remainder_x, remainder_y).
//
// Invariants: after Build no body is in Box2D. The next tick finds the groups and makes their worlds (body_groups.cpp)
// from the bodies alone.
#include "engine_worker/engines/dynamics2d/dynamics2d_world.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "common/math/elementary.h"
#include "engine_worker/engines/dynamics2d/remote_groups.h"

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
  isolated_.clear();
  groups_ = ContactGroups();
  world_of_group_.clear();
  order_.clear();
  separation_is_configured_ = false;
  CloseWorlds();
  for (Body& body : bodies_) LeaveOut(body);
}

void Dynamics2dWorld::UseRegions(RegionTeam& team, unsigned threads)
{
  remote_ = std::make_unique<RemoteGroups>(team, threads);
}

void Dynamics2dWorld::UseThreads(unsigned threads, WorkerPool* pool)
{
  if (pool == nullptr && threads > 1) own_pool_ = std::make_unique<WorkerPool>(threads);
  pool_ = pool != nullptr ? pool : own_pool_.get();
}

// Makes the body of Box2D for a body that has none in this world. Returns nullptr if a region has the world.
b2Body* Dynamics2dWorld::BuildIn(GroupWorld& world, std::uint32_t number)
{
  Body& body = bodies_[number];
  if (world.remote)
  {
    OrderBuild(world, body);
    return nullptr;
  }
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
  b2Body* const b2 = world.box2d->CreateBody(&definition);

  b2FixtureDef fixture = FixtureOf(number);
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
  b2->CreateFixture(&fixture);
  if (model.has_gripper)
  {
    b2PolygonShape square;
    square.SetAsBox(1, 1);
    fixture.shape = &square;
    fixture.isSensor = model.grips_by_rod;
    body.gripper = b2->CreateFixture(&fixture);
    TurnGripper(body);
  }

  if (model.motion != EMotion::kDynamic) return b2;
  b2MassData mass;
  mass.mass = static_cast<float>(model.mass);
  mass.center.SetZero();
  mass.I = static_cast<float>(model.inertia * kTorqueUnits);
  b2->SetMassData(&mass);

  b2MotorJointDef joint;
  joint.bodyA = world.ground;
  joint.bodyB = b2;
  joint.collideConnected = true;
  joint.maxForce = static_cast<float>(model.ground_force * kForceUnits);
  joint.maxTorque = static_cast<float>(model.ground_torque * kTorqueUnits);
  joint.correctionFactor = kDriveGain;
  body.ground = static_cast<b2MotorJoint*>(world.box2d->CreateJoint(&joint));
  return b2;
}

b2FixtureDef Dynamics2dWorld::FixtureOf(std::uint32_t number) const
{
  const BodyModel& model = bodies_[number].model;
  b2FixtureDef fixture;
  fixture.density = 0;  // the mass of a body is set as a whole
  fixture.friction = static_cast<float>(model.friction);
  fixture.restitution = static_cast<float>(model.restitution);
  fixture.userData.pointer = number;
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
  OrderChange(bodies_[Index(number)], EGroupOrder::kPlace);
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
  OrderChange(body, EGroupOrder::kSetVelocity);
}

void Dynamics2dWorld::SetOutline(int number, const std::vector<Vector2>& polygon, double tolerance)
{
  Body& body = bodies_[Index(number)];
  const std::vector<Vector2>& outline = body.model.polygon;
  const auto same = [=](const Vector2& a, const Vector2& b) { return (a - b).squaredNorm() <= tolerance * tolerance; };
  if (std::equal(outline.begin(), outline.end(), polygon.begin(), polygon.end(), same)) return;
  SetPolygon(body, polygon);
  separation_is_configured_ = false;
}

void Dynamics2dWorld::SetPolygon(Body& body, const std::vector<Vector2>& polygon)
{
  body.model.polygon = polygon;
  if (OrderChange(body, EGroupOrder::kSetOutline) || body.b2 == nullptr) return;
  body.b2->DestroyFixture(body.b2->GetFixtureList());
  const b2PolygonShape shape = ShapeOf(polygon);
  b2FixtureDef fixture = FixtureOf(static_cast<std::uint32_t>(&body - bodies_.data()));
  fixture.shape = &shape;
  body.b2->CreateFixture(&fixture);
}

void Dynamics2dWorld::SetSolid(int number, bool solid)
{
  Body& body = bodies_[Index(number)];
  if (body.solid == solid) return;
  body.solid = solid;
  if (body.b2 != nullptr) body.b2->SetEnabled(solid);
  OrderChange(body, EGroupOrder::kSetSolid);
}

int Dynamics2dWorld::ContactCount() const
{
  int count = 0;
  for (const std::uint32_t number : world_of_group_)
  {
    const GroupWorld& world = *worlds_[number];
    if (world.remote)
    {
      count += world.remote->contacts;
      continue;
    }
    for (const b2Contact* contact = world.box2d->GetContactList(); contact != nullptr; contact = contact->GetNext())
      count += contact->IsTouching() ? 1 : 0;
  }
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

void Dynamics2dWorld::PutMotion(const Body& body, ByteWriter& state)
{
  state.Put(StateOf(body));
  state.Put(body.remainder_x);
  state.Put(body.remainder_y);
  state.Put(static_cast<std::uint8_t>(body.solid ? 1 : 0));
  if (!body.model.has_gripper) return;
  state.Put(body.turret_angle);
  state.Put(static_cast<std::uint8_t>(body.held_angle ? 1 : 0));
  if (body.held_angle) state.Put(*body.held_angle);
}

void Dynamics2dWorld::GetMotion(Body& body, ByteReader& state)
{
  body.start = state.Get<BodyState>();
  body.remainder_x = state.Get<double>();
  body.remainder_y = state.Get<double>();
  body.solid = state.Get<std::uint8_t>() != 0;
  if (!body.model.has_gripper) return;
  body.turret_angle = state.Get<double>();
  const bool held = state.Get<std::uint8_t>() != 0;
  body.held_angle = held ? std::optional(state.Get<double>()) : std::nullopt;
}

void Dynamics2dWorld::PutGrip(const Body& body, ByteWriter& state)
{
  state.Put(static_cast<std::int32_t>(body.gripped));
  if (body.gripped == kNoBody) return;
  state.Put(body.grip.anchor.x);
  state.Put(body.grip.anchor.y);
  state.Put(body.grip.reference_angle);
}

void Dynamics2dWorld::GetGrip(Body& body, ByteReader& state)
{
  body.gripped = state.Get<std::int32_t>();
  body.grip = {};
  if (body.gripped == kNoBody) return;
  body.grip.anchor.x = state.Get<float>();
  body.grip.anchor.y = state.Get<float>();
  body.grip.reference_angle = state.Get<float>();
}

void Dynamics2dWorld::SaveState(ByteWriter& state) const
{
  state.Put(static_cast<std::uint64_t>(bodies_.size()));
  for (const Body& body : bodies_)
  {
    if (body.model.motion == EMotion::kStatic) continue;
    PutMotion(body, state);
    PutGrip(body, state);
  }
}

void Dynamics2dWorld::LoadState(ByteReader& state)
{
  if (state.Get<std::uint64_t>() != bodies_.size())
    throw std::runtime_error("saved state of dynamics2d: it is of an experiment with another number of bodies");
  for (Body& body : bodies_)
  {
    if (body.model.motion == EMotion::kStatic) continue;
    GetMotion(body, state);
    GetGrip(body, state);
    if (body.gripped != kNoBody && (body.gripped < 0 || body.gripped >= static_cast<int>(bodies_.size()) ||
                                    bodies_[Index(body.gripped)].model.motion != EMotion::kDynamic))
      throw std::runtime_error("saved state of dynamics2d: a robot holds a body that it cannot hold");
  }
  Build();
}

}  // namespace swarmanoid::dynamics2d

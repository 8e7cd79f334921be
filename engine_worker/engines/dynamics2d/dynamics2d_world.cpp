#include "engine_worker/engines/dynamics2d/dynamics2d_world.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/math/elementary.h"

namespace swarmanoid::dynamics2d
{
namespace
{

// The part of a ground joint's position error that becomes velocity. Drives are expressed through it; a small value
// puts the target far ahead, where the rounding of large coordinates does not matter.
constexpr float kDriveGain = 0.001F;
// A remainder beyond this goes to Box2D's position.
constexpr double kLargestRemainder = 1e-4;  // decimetres
constexpr double kSlip = 1e-3;              // m/s: slower than this a body on the ground is taken to stand

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
  // Who may be isolated is built when a tick begins and he is not.
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

void Dynamics2dWorld::Step(double seconds)
{
  if (!isolated_.empty() && IsSomebodyTooFar(seconds))
    for (const std::uint32_t number : std::vector(isolated_)) EndIsolation(static_cast<int>(number));
  positions_.clear();
  for (const std::uint32_t number : solved_)
  {
    Body& body = bodies_[number];
    ApplyDrive(body, seconds);
    if (body.gripper != nullptr) ApplyTurret(body, seconds);
    positions_.push_back(body.b2->GetPosition());
  }
  world_->Step(static_cast<float>(seconds), settings_.velocity_iterations, settings_.position_iterations);
  for (std::size_t i = 0; i < solved_.size(); ++i)
    if (bodies_[solved_[i]].solid) KeepRemainder(bodies_[solved_[i]], positions_[i], seconds);
  for (const std::uint32_t number : isolated_) AdvanceIsolated(bodies_[number], seconds);
  last_step_ = seconds;
}

// Box2D moves by x += h v in single precision: what the rounding takes or adds is carried on.
void Dynamics2dWorld::KeepRemainder(Body& body, const b2Vec2& before, double seconds) const
{
  const auto h = static_cast<float>(seconds);
  const auto lost = [&](float x, float v)
  {
    const float moved = x + h * v;
    return x + seconds * v - moved;
  };
  const b2Vec2 velocity = body.b2->GetLinearVelocity();
  body.remainder_x += lost(before.x, velocity.x);
  body.remainder_y += lost(before.y, velocity.y);
  if (std::max(std::abs(body.remainder_x), std::abs(body.remainder_y)) < kLargestRemainder) return;
  const b2Vec2 now = body.b2->GetPosition();
  SetPosition(body, now.x + body.remainder_x, now.y + body.remainder_y, body.b2->GetAngle());
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

// Units a second, along the chord of the arc that a step of so many seconds leads along.
PlaneVelocity Dynamics2dWorld::WantedVelocity(const Body& body, double seconds) const
{
  const double turn = body.drive.turn * seconds;
  if (body.drive.forward == 0 && body.drive.left == 0) return {0, 0, body.drive.turn};
  const SinCos middle = SinCosOf(StateOf(body).angle + turn / 2);
  const double shortening = std::abs(turn) > 1e-6 ? Sin(turn / 2) / (turn / 2) : 1;
  const double scale = shortening * kUnitsPerMetre;
  return {scale * (middle.cos * body.drive.forward - middle.sin * body.drive.left),
          scale * (middle.sin * body.drive.forward + middle.cos * body.drive.left), body.drive.turn};
}

// The ground joint is given an error that asks for the wanted velocity. Solved together with contacts and grips, so
// what cannot move stands still.
void Dynamics2dWorld::ApplyDrive(Body& body, double seconds)
{
  const PlaneVelocity wanted = WantedVelocity(body, seconds);
  const double ahead = seconds / kDriveGain;
  const b2Vec2 position = body.b2->GetWorldCenter();
  body.ground->SetLinearOffset(
      {static_cast<float>(position.x + ahead * wanted.u), static_cast<float>(position.y + ahead * wanted.v)});
  body.ground->SetAngularOffset(static_cast<float>(body.b2->GetAngle() + ahead * wanted.turn));
  if (!body.model.lies || body.model.ground_force <= 0) return;
  const FrictionShares shares = SharesOf(body.model, StateOf(body));
  body.ground->SetMaxForce(static_cast<float>(shares.sliding * body.model.ground_force * kForceUnits));
  body.ground->SetMaxTorque(static_cast<float>(shares.turning * body.model.ground_torque * kTorqueUnits));
}

// Friction under a face opposes the slip at each of its points, so that sliding and turning share one limit: nearly an
// ellipsoid (Howe and Cutkosky, "Practical force-motion models for sliding manipulation", 1996). What slides gives way
// to the smallest push across, and to the smallest torque.
Dynamics2dWorld::FrictionShares Dynamics2dWorld::SharesOf(const BodyModel& model, const BodyState& state)
{
  const double x = state.vx / kUnitsPerMetre;
  const double y = state.vy / kUnitsPerMetre;
  const double turn = state.turn * model.ground_torque / model.ground_force;
  const double slip = std::sqrt(x * x + y * y + turn * turn);
  if (slip <= kSlip) return {1, 1};
  return {std::sqrt(x * x + y * y) / slip, std::abs(turn) / slip};
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
  // The float next to half a turn is a little more than that, so its heading is told from the other side.
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
}  // namespace swarmanoid::dynamics2d

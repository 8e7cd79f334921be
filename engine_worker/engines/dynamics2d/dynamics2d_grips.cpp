// Grippers, turrets and grips: which body a gripper can take, the joint that holds it, and its load.
//
// Method: a grip is a revolute joint about the axis of the turret if a motor turns the turret, else a rigid one, or a
// rod of fixed length from that axis to the place of the grip. A held turret returns to its angle with limited speed,
// and slips when the load exceeds the torque of its motor.
//
// Invariants: grips lead from body to body without a loop. The joint's angle is stated against reference_angle, so that
// whole turns of the bodies do not count.
#include <algorithm>
#include <array>
#include <cmath>

#include "common/math/elementary.h"
#include "engine_worker/engines/dynamics2d/dynamics2d_world.h"
#include "engine_worker/engines/dynamics2d/remote_groups.h"

namespace swarmanoid::dynamics2d
{
namespace
{

constexpr double kHoldGain = 0.2;    // part of the error of a held turret that is corrected in a step
constexpr double kHoldSpeed = 1.0;   // rad/s, at most
constexpr double kOverload = 0.999;  // of the motor's torque: the turret slips

// Returns the distance of a point from the outline of a model, in the model's frame; negative inside.
double OutlineDistance(const BodyModel& model, const Vector2& point)
{
  if (model.radius > 0) return std::sqrt(point.squaredNorm()) - model.radius;
  return DistanceTo(std::span(model.polygon), point);
}

int BodyOf(b2Fixture& fixture) { return static_cast<int>(fixture.GetUserData().pointer); }

class NearbyBodies : public b2QueryCallback
{
public:
  bool ReportFixture(b2Fixture* fixture) override
  {
    bodies.push_back(BodyOf(*fixture));
    return true;
  }
  std::vector<int> bodies;
};

}  // namespace

// Makes the joint of a grip.
void Dynamics2dWorld::BuildGrip(Body& body)
{
  body.is_joined = true;
  if (OrderChange(body, EGroupOrder::kGrip)) return;
  b2Body* target = bodies_[Index(body.gripped)].b2;
  if (body.model.has_turret_motor)
  {
    b2RevoluteJointDef joint;
    joint.bodyA = body.b2;
    joint.bodyB = target;
    joint.localAnchorB = body.grip.anchor;
    joint.referenceAngle = body.grip.reference_angle;
    joint.enableMotor = true;
    joint.maxMotorTorque = static_cast<float>(settings_.turret_torque * kTorqueUnits);
    body.joint = worlds_[body.world]->box2d->CreateJoint(&joint);
    return;
  }
  if (body.model.grips_by_rod)
  {
    b2DistanceJointDef joint;
    joint.bodyA = body.b2;
    joint.bodyB = target;
    joint.localAnchorB = body.grip.anchor;
    joint.length = joint.minLength = joint.maxLength = static_cast<float>(body.model.radius * kUnitsPerMetre);
    joint.collideConnected = true;
    body.joint = worlds_[body.world]->box2d->CreateJoint(&joint);
    return;
  }
  b2WeldJointDef joint;
  joint.bodyA = body.b2;
  joint.bodyB = target;
  joint.localAnchorB = body.grip.anchor;
  joint.referenceAngle = body.grip.reference_angle;
  body.joint = worlds_[body.world]->box2d->CreateJoint(&joint);
}

void Dynamics2dWorld::EndGrip(Body& body)
{
  body.is_joined = false;
  if (!OrderChange(body, EGroupOrder::kEndGrip)) worlds_[body.world]->box2d->DestroyJoint(body.joint);
  body.joint = nullptr;
}

void Dynamics2dWorld::ApplyTurret(Body& body, double seconds, double last_step)
{
  if (body.gripped == kNoBody)
  {
    if (body.turret_speed == 0) return;
    body.turret_angle = WrapAngle(body.turret_angle + body.turret_speed * seconds);
    TurnGripper(body);
    return;
  }
  if (!body.model.has_turret_motor) return;
  auto* joint = static_cast<b2RevoluteJoint*>(body.joint);
  const double angle = joint->GetJointAngle();
  if (body.turret_speed != 0)
  {
    body.held_angle.reset();
    joint->SetMotorSpeed(static_cast<float>(body.turret_speed));
  }
  else
  {
    const bool slips = last_step > 0 && std::abs(joint->GetMotorTorque(static_cast<float>(1 / last_step))) >=
                                            kOverload * settings_.turret_torque * kTorqueUnits;
    if (!body.held_angle || slips) body.held_angle = angle;
    const double speed = kHoldGain * WrapAngle(*body.held_angle - angle) / seconds;
    joint->SetMotorSpeed(static_cast<float>(std::clamp(speed, -kHoldSpeed, kHoldSpeed)));
  }
  TurnGripper(body);
}

void Dynamics2dWorld::TurnGripper(Body& body)
{
  if (OrderChange(body, EGroupOrder::kTurnGripper) || body.gripper == nullptr) return;  // a handbot has none
  const SinCos turret = SinCosOf(TurretAngleOf(static_cast<int>(&body - bodies_.data())));
  const auto point = [&](double forward, double left)
  { return ToUnits(turret.cos * forward - turret.sin * left, turret.sin * forward + turret.cos * left); };
  constexpr double kBack = kGripperReach - kGripperSide;
  constexpr double kHalf = kGripperSide / 2;
  const std::array<b2Vec2, 4> points{point(kGripperReach, -kHalf), point(kGripperReach, kHalf), point(kBack, kHalf),
                                     point(kBack, -kHalf)};
  static_cast<b2PolygonShape*>(body.gripper->GetShape())->Set(points.data(), 4);
}

void Dynamics2dWorld::SetTurretAngle(int number, double radians)
{
  Body& body = bodies_[Index(number)];
  if (body.turret_angle == radians) return;
  body.turret_angle = radians;
  TurnGripper(body);
}

double Dynamics2dWorld::TurretAngleOf(int number) const
{
  const Body& body = bodies_[Index(number)];
  if (!body.model.has_turret_motor || body.gripped == kNoBody) return body.turret_angle;
  return WrapAngle(StateOf(bodies_[Index(body.gripped)]).angle - StateOf(body).angle - body.grip.reference_angle);
}

// Headings come without whole turns: the turns that the bodies had made are taken from the angle of the grip.
void Dynamics2dWorld::CountTurns(Body& body)
{
  const double angle = static_cast<double>(StateOf(bodies_[Index(body.gripped)]).angle) - StateOf(body).angle -
                       body.grip.reference_angle;
  if (std::abs(angle) <= kPi) return;
  body.grip.reference_angle = static_cast<float>(body.grip.reference_angle + angle - WrapAngle(angle));
  if (!body.is_joined) return;
  EndGrip(body);
  BuildGrip(body);
}

bool Dynamics2dWorld::LeadsTo(int from, int to) const
{
  for (int body = from; body != kNoBody; body = bodies_[Index(body)].gripped)
    if (body == to) return true;
  return false;
}

int Dynamics2dWorld::FindGrippable(int number) const
{
  const Body& body = bodies_[Index(number)];
  if (body.world == ContactGroups::kAlone) return kNoBody;  // no body is near
  const BodyState state = StateOf(body);
  const SinCos turret = SinCosOf(state.angle + body.turret_angle);
  const double reach = body.model.grips_by_rod ? body.model.radius : kGripperReach;
  const double grip_distance = body.model.grips_by_rod ? kRodGripDistance : settings_.grip_distance;
  const double x = state.x / kUnitsPerMetre + reach * turret.cos;
  const double y = state.y / kUnitsPerMetre + reach * turret.sin;

  NearbyBodies nearby;
  if (IsRemote(body))
  {
    // Only bodies that Box2D would find can be near enough.
    for (const std::uint32_t k : groups_.Bodies(groups_.GroupOf(in_moving_[Index(number)])))
      if (bodies_[moving_[k]].solid) nearby.bodies.push_back(static_cast<int>(moving_[k]));
  }
  else
  {
    b2AABB box;
    box.lowerBound = ToUnits(x - 2 * grip_distance, y - 2 * grip_distance);
    box.upperBound = ToUnits(x + 2 * grip_distance, y + 2 * grip_distance);
    worlds_[body.world]->box2d->QueryAABB(&nearby, box);
    std::sort(nearby.bodies.begin(), nearby.bodies.end());
  }

  int best = kNoBody;
  double best_distance = grip_distance;
  for (const int candidate : nearby.bodies)
  {
    const Body& other = bodies_[Index(candidate)];
    if (!other.model.grippable || LeadsTo(candidate, number)) continue;
    const BodyState at = StateOf(other);
    const SinCos heading = SinCosOf(at.angle);
    const double dx = x - at.x / kUnitsPerMetre;
    const double dy = y - at.y / kUnitsPerMetre;
    const Vector2 point(heading.cos * dx + heading.sin * dy, heading.cos * dy - heading.sin * dx);
    const double distance = OutlineDistance(other.model, point);
    if (distance > best_distance || (distance == best_distance && best != kNoBody)) continue;
    best = candidate;
    best_distance = distance;
  }
  return best;
}

void Dynamics2dWorld::Grip(int number, int target)
{
  Body& body = bodies_[Index(number)];
  const Body& other = bodies_[Index(target)];
  const BodyState own_state = StateOf(body);
  const BodyState state = StateOf(other);
  b2Vec2 held{own_state.x, own_state.y};  // the axis of the turret, or the outer end of a rod
  if (body.model.grips_by_rod && !body.model.has_turret_motor)
  {
    const SinCos turret = SinCosOf(own_state.angle + body.turret_angle);
    held += ToUnits(body.model.radius * turret.cos, body.model.radius * turret.sin);
  }
  body.grip.anchor = b2MulT(b2Transform({state.x, state.y}, b2Rot(state.angle)), held);
  const double difference = static_cast<double>(state.angle) - own_state.angle;
  body.grip.reference_angle =
      static_cast<float>(body.model.has_turret_motor ? difference - body.turret_angle : difference);
  body.gripped = target;
  body.held_angle.reset();
  if (body.world != ContactGroups::kAlone && body.world == other.world)
    BuildGrip(body);
  else
    must_find_groups_ = true;
}

void Dynamics2dWorld::Release(int number)
{
  Body& body = bodies_[Index(number)];
  if (body.gripped == kNoBody) return;
  body.turret_angle = TurretAngleOf(number);
  if (body.is_joined) EndGrip(body);
  body.gripped = kNoBody;
  body.held_angle.reset();
  TurnGripper(body);
}

TurretLoad Dynamics2dWorld::LoadOf(const Body& body, double last_step) const
{
  const auto rate = static_cast<float>(1 / last_step);
  const b2Vec2 force = body.joint->GetReactionForce(rate);  // on the gripped body
  const SinCos turret = SinCosOf(body.b2->GetAngle() + TurretAngleOf(static_cast<int>(&body - bodies_.data())));
  return {-(turret.cos * force.x + turret.sin * force.y) / kForceUnits,
          -(turret.cos * force.y - turret.sin * force.x) / kForceUnits,
          -body.joint->GetReactionTorque(rate) / kTorqueUnits};
}

int Dynamics2dWorld::GripCount() const
{
  return static_cast<int>(
      std::count_if(bodies_.begin(), bodies_.end(), [](const Body& body) { return body.gripped != kNoBody; }));
}

}  // namespace swarmanoid::dynamics2d

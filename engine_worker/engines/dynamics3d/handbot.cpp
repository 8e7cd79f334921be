// Problem: drive the handbot's head, arms, wrists, hands, rope and fans by commands of speed.
//
// Method: head and arms are hinges of ODE with a motor. Each has a target angle that goes ahead by the commanded rate;
// the motor's speed is that rate and a gain times the distance to the target. Hands grip by a Grasp, whose joint the
// wrist's motor turns. The rope is a distance between two anchors, enabled only while it is taut. Fans turn the hanging
// robot back to its heading.
//
// Invariants: a target is at most kServoLead (rad) ahead of its arm, and the rope's length at most kWinchLead (m)
// shorter than the distance of its ends. So parts that were held back do not jump.
#include "engine_worker/engines/dynamics3d/handbot.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/math/elementary.h"
#include "common/plugin_descriptions/engine_bodies.h"

namespace swarmanoid::dynamics3d
{
namespace
{

constexpr GraspGeometry kHandGrasp{0.03, HandbotShape::kWristTorque, true};
constexpr double kServoGain = 40;    // 1/s
constexpr double kServoLead = 0.1;   // rad: how far the target runs ahead of an arm that is held back
constexpr double kServoSpeed = 3;    // rad/s
constexpr double kWinchLead = 0.01;  // m: a winch that pulls at what cannot follow stops there
// The fans turn the robot to the heading that it had when the rope was shot: critically damped at 3 rad/s with a book.
constexpr double kFanGain = 0.3;     // N m/rad
constexpr double kFanDamping = 0.2;  // N m s
constexpr double kReported = 1e-4;   // rad: smaller changes of angles are not reported

Pose At(double x, double y, double z) { return {Vector3(x, y, z), Quaternion::Identity()}; }
Vector3 Shoulder(int arm)
{
  return {HandbotShape::kHeadForward, arm == 0 ? HandbotShape::kShoulder : -HandbotShape::kShoulder,
          HandbotShape::kHeadHeight};
}

}  // namespace

HandbotModel::HandbotModel(Scene& scene, const CSwarmanoidSpaceEntity& entity)
    : Model(scene, entity), hands_{{Grasp(scene, kHandGrasp)}, {Grasp(scene, kHandGrasp)}}
{
  OdeWorld& world = scene.world;
  const double given = entity.GetConfiguration().mass_kg;
  const double scale = given > 0 ? given / HandbotShape::kMass : 1;

  AddBody(BoxMass(scale * HandbotShape::kTrunkMass,
                  {HandbotShape::kTrunkLength, HandbotShape::kTrunkWidth, HandbotShape::kHeight}),
          At(0, 0, HandbotShape::kTrunkCentre), EBody::kMechanism);
  AddBody(Geared(BoxMass(scale * HandbotShape::kHeadMass, {0.06, 0.1, 0.06}), HandbotShape::kHeadInertia),
          At(HandbotShape::kHeadForward, 0, HandbotShape::kHeadHeight), EBody::kMechanism);
  const double arm_middle = HandbotShape::kHeadForward + HandbotShape::kArmLength / 2;
  for (const double side : {HandbotShape::kShoulder, -HandbotShape::kShoulder})
    AddBody(Geared(BoxMass(scale * HandbotShape::kArmMass, {HandbotShape::kArmLength, 0.03, 0.03}),
                   HandbotShape::kArmInertia),
            At(arm_middle, side, HandbotShape::kHeadHeight), EBody::kMechanism);

  MakeServo(0, 0, 1, {HandbotShape::kHeadForward, 0, HandbotShape::kHeadHeight}, Vector3::UnitX(), 1, -kPi, kPi,
            scale * HandbotShape::kHeadTorque);
  MakeServo(1, 1, 2, Shoulder(0), Vector3::UnitZ(), 1, 0, HandbotShape::kWidestArm, scale * HandbotShape::kArmTorque);
  MakeServo(2, 1, 3, Shoulder(1), Vector3::UnitZ(), -1, 0, HandbotShape::kWidestArm, scale * HandbotShape::kArmTorque);

  world.BeginEntity(Entity());
  const int trunk = bodies_[0].number;
  world.AddSolid(dCreateBox(nullptr, HandbotShape::kBaseSide, HandbotShape::kBaseSide, HandbotShape::kBaseHeight),
                 trunk, ELayer::kRobot, ESurface::kPlain,
                 At(0, 0, HandbotShape::kBaseHeight / 2 - HandbotShape::kTrunkCentre));
  const double trunk_height = HandbotShape::kHeight - HandbotShape::kBaseHeight;
  world.AddSolid(dCreateBox(nullptr, HandbotShape::kTrunkLength, HandbotShape::kTrunkWidth, trunk_height), trunk,
                 ELayer::kRobot, ESurface::kPlain,
                 At(0, 0, HandbotShape::kBaseHeight + trunk_height / 2 - HandbotShape::kTrunkCentre));
  for (std::size_t arm = 2; arm <= 3; ++arm)
  {
    const Pose along_x{Vector3::Zero(), QuaternionFromEuler({0, kPi / 2, 0})};
    world.AddSolid(
        dCreateCapsule(nullptr, HandbotShape::kArmRadius, HandbotShape::kArmLength - 2 * HandbotShape::kArmRadius),
        bodies_[arm].number, ELayer::kRobot, ESurface::kPlain, along_x);
  }
}

void HandbotModel::MakeServo(std::size_t k, int inner, int outer, const Vector3& anchor, const Vector3& axis,
                             double sign, double lowest, double highest, double torque)
{
  Servo& servo = servos_[k];
  servo.inner = inner;
  servo.outer = outer;
  servo.axis = axis;
  servo.sign = sign;
  servo.lowest = lowest;
  servo.highest = highest;
  const auto number = [&](int body) { return bodies_[static_cast<std::size_t>(body)].number; };
  servo.hinge = scene_.world.AddHinge(number(outer), number(inner), anchor, axis, torque);
}

// Head and arms keep their angles, as in the engines of planes.
void HandbotModel::Place(const Pose& pose)
{
  std::array<double, 3> angles;
  for (std::size_t k = 0; k < angles.size(); ++k)
  {
    const double angle = AngleOf(servos_[k]);
    angles[k] = std::abs(angle) < kReported ? 0 : angle;
    servos_[k].target = angles[k];
  }
  Model::Place(pose);
  if (angles == std::array<double, 3>{}) return;
  const auto put = [&](int body, const Pose& in_entity) { SetRawPose(BodyAt(body), RawOf(pose.Compose(in_entity))); };
  put(1, {bodies_[1].in_entity.position, QuaternionFromEuler({angles[0], 0, 0})});
  for (std::size_t arm = 0; arm < 2; ++arm)
    put(static_cast<int>(arm) + 2,
        HandbotShoulder(arm, angles[0], angles[1 + arm]).Compose(At(HandbotShape::kArmLength / 2, 0, 0)));
}

// The head turns about its axis and carries the arms, which turn at their shoulders.
void HandbotModel::FollowAttributes()
{
  const CSwarmanoidSpaceEntity& entity = GetSpaceEntity();
  const Pose pose = CurrentPose();
  const auto turn = [](const Vector3& anchor, const Vector3& half_axis, double half_cosine) -> Pose
  {
    const Quaternion rotation(half_cosine, half_axis.x(), half_axis.y(), half_axis.z());
    return {anchor - rotation * anchor, rotation};
  };
  const auto set = [&](int body, const Pose& moved)
  {
    const PlacedBody& placed = bodies_[static_cast<std::size_t>(body)];
    SetRawPose(BodyAt(body), RawOf(pose.Compose(moved).Compose(placed.in_entity)));
  };
  const double head = entity.GetAttribute("head_angle");
  const SinCos half_head = SinCosOf(head / 2);
  const Pose head_turn =
      turn({HandbotShape::kHeadForward, 0, HandbotShape::kHeadHeight}, Vector3(half_head.sin, 0, 0), half_head.cos);
  servos_[0].target = head;
  set(1, head_turn);
  for (int arm = 0; arm < 2; ++arm)
  {
    Servo& servo = servos_[1 + arm];
    servo.target = entity.GetAttribute("arm", arm);
    const SinCos half = SinCosOf(servo.sign * servo.target / 2);
    set(2 + arm, head_turn.Compose(turn(Shoulder(arm), Vector3(0, 0, half.sin), half.cos)));
    hands_[arm].wrist = entity.GetAttribute("wrist", arm);
    hands_[arm].aperture = entity.GetAttribute("hand_aperture", arm);
  }
}

void HandbotModel::Command(std::string_view channel, std::span<const double> values)
{
  if (channel == "handbot_arms")
  {
    for (std::size_t k = 0; k < 3; ++k) servos_[k].rate = values[k];
    hands_[0].wrist_rate = values[3];
    hands_[1].wrist_rate = values[4];
  }
  else if (channel == "handbot_hands")
  {
    for (std::size_t k = 0; k < 2; ++k)
    {
      hands_[k].close = values[k] > 0.5;
      hands_[k].commanded = true;
    }
  }
  else if (channel == "handbot_rope")
  {
    launch_ = values[0] > 0.5;
    winch_ = std::clamp(values[1], -HandbotShape::kWinchSpeed, HandbotShape::kWinchSpeed);
  }
}

void HandbotModel::BeginTick()
{
  UpdateHands();
  UpdateRope();
}

void HandbotModel::UpdateHands()
{
  for (std::size_t k = 0; k < 2; ++k)
  {
    Hand& hand = hands_[k];
    if (!hand.close && hand.grasp.IsHolding()) hand.grasp.Release();
    if (!hand.close || hand.grasp.IsHolding()) continue;
    const Pose arm = PoseOf(BodyAt(static_cast<int>(k) + 2));
    const Vector3 tip = arm.Apply({HandbotShape::kArmLength / 2, 0, 0});
    hand.grasp.TryToHold(Entity(), bodies_[k + 2].number, tip, tip, arm.orientation * Vector3::UnitX(),
                         &hands_[1 - k].grasp);
  }
}

void HandbotModel::UpdateRope()
{
  const bool attached = scene_.links.Find(rope_) != nullptr;
  if (attached && !launch_)
  {
    scene_.links.Remove(rope_);
    rope_ = 0;
  }
  if (attached || !launch_) return;
  const Vector3 from =
      PoseOf(BodyAt(0)).Apply({HandbotShape::kRopeForward, 0, HandbotShape::kHeight - HandbotShape::kTrunkCentre});
  const double distance = scene_.world.DistanceToStatic(from, scene_.up, HandbotShape::kLongestRope);
  if (distance > HandbotShape::kLongestRope) return;
  const Vector3 hook = from + scene_.up * distance;
  LinkSpec spec;
  spec.kind = ELink::kRope;
  spec.body_a = bodies_[0].number;
  spec.entity_a = Entity();
  for (int i = 0; i < 3; ++i)
  {
    spec.anchor[i] = from[i];
    spec.other[i] = hook[i];
  }
  rope_ = scene_.links.Add(spec).Serial();
  heading_ = YawOf(scene_.frame.ToSpace(PoseOf(BodyAt(0))).orientation);
}

void HandbotModel::RunFans()
{
  const dBodyID trunk = BodyAt(0);
  const double error = WrapAngle(heading_ - YawOf(scene_.frame.ToSpace(PoseOf(trunk)).orientation));
  const double spin = VectorOf(dBodyGetAngularVel(trunk)).dot(scene_.up);
  const double torque =
      std::clamp(kFanGain * error - kFanDamping * spin, -HandbotShape::kFanTorque, HandbotShape::kFanTorque);
  const Vector3 turn = scene_.up * torque;
  dBodyAddTorque(trunk, turn.x(), turn.y(), turn.z());
}

double HandbotModel::AngleOf(const Servo& servo) const
{
  // The twist of the outer body against the inner one is taken about the axis.
  const Quaternion relative =
      PoseOf(BodyAt(servo.inner)).orientation.conjugate() * PoseOf(BodyAt(servo.outer)).orientation;
  return servo.sign * WrapAngle(2 * Atan2(relative.vec().dot(servo.axis), relative.w()));
}

void HandbotModel::DriveServo(Servo& servo, double seconds)
{
  const double angle = AngleOf(servo);
  double target = servo.target + servo.rate * seconds;
  const bool full_turn = servo.highest >= kPi;
  if (full_turn)
    target = angle + std::clamp(WrapAngle(target - angle), -kServoLead, kServoLead);
  else
    target = std::clamp(std::clamp(target, angle - kServoLead, angle + kServoLead), servo.lowest, servo.highest);
  servo.target = full_turn ? WrapAngle(target) : target;
  const double speed = std::clamp(servo.rate + kServoGain * (target - angle), -kServoSpeed, kServoSpeed);
  dJointSetHingeParam(scene_.world.Hinge(servo.hinge), dParamVel, servo.sign * speed);
}

void HandbotModel::BeforeStep(double seconds)
{
  for (Servo& servo : servos_) DriveServo(servo, seconds);
  for (Hand& hand : hands_)
  {
    const double next = std::clamp(hand.wrist + hand.wrist_rate * seconds, 0.0, HandbotShape::kWidestWrist);
    if (Link* link = hand.grasp.link()) link->SetMotorSpeed((next - hand.wrist) / seconds);
  }
  if (Link* rope = scene_.links.Find(rope_))
  {
    const double length = std::max(rope->Length() + winch_ * seconds, rope->AnchorDistance() - kWinchLead);
    rope->SetLength(std::clamp(length, HandbotShape::kShortestRope, HandbotShape::kLongestRope));
    rope->TightenOrSlacken();
    if (rope->IsTaut()) RunFans();
  }
}

void HandbotModel::AfterStep(double seconds)
{
  for (Hand& hand : hands_)
  {
    const Link* link = hand.grasp.link();
    hand.wrist += (link != nullptr ? link->HingeSpeed() : hand.wrist_rate) * seconds;
    hand.wrist = std::clamp(hand.wrist, 0.0, HandbotShape::kWidestWrist);
    if (!hand.commanded) continue;
    const double turn = (hand.close ? -1 : 1) * HandbotShape::kHandSpeed * seconds;
    if (!(hand.close && hand.grasp.IsHolding()))
      hand.aperture = std::clamp(hand.aperture + turn, 0.0, HandbotShape::kWidestHand);
  }
}

void HandbotModel::Report(AttributeReport& report) const
{
  report.Set("head_angle", AngleOf(servos_[0]), 0, kReported);
  for (int arm = 0; arm < 2; ++arm) report.Set("arm", AngleOf(servos_[1 + arm]), arm, kReported);
  for (int k = 0; k < 2; ++k) report.Set("wrist", hands_[k].wrist, k, kReported);
  for (int k = 0; k < 2; ++k) report.Set("hand_aperture", hands_[k].aperture, k, kReported);
  for (int k = 0; k < 2; ++k) report.Set("gripped", hands_[k].grasp.IsHolding() ? 1.0 + hands_[k].grasp.Held() : 0, k);
  const Link* rope = static_cast<const LinkTable&>(scene_.links).Find(rope_);
  report.Set("rope_attached", rope != nullptr ? 1 : 0);
  report.Set("rope_length", rope != nullptr ? rope->Length() : 0);
}

void HandbotModel::Save(ByteWriter& state) const
{
  for (const Servo& servo : servos_) state.Put(servo.target);
  for (const Hand& hand : hands_)
  {
    hand.grasp.Save(state);
    state.Put(hand.wrist);
    state.Put(hand.aperture);
    state.Put(hand.commanded);
  }
  state.Put(rope_);
  state.Put(heading_);
}

void HandbotModel::Load(ByteReader& state)
{
  for (Servo& servo : servos_) servo.target = state.Get<double>();
  for (Hand& hand : hands_)
  {
    hand.grasp.Load(state);
    hand.wrist = state.Get<double>();
    hand.aperture = state.Get<double>();
    hand.commanded = state.Get<bool>();
  }
  rope_ = state.Get<std::uint32_t>();
  heading_ = state.Get<double>();
}

void HandbotModel::SaveTick(ByteWriter& state) const
{
  for (const Servo& servo : servos_) state.Put(servo.rate);
  for (const Hand& hand : hands_)
  {
    state.Put(hand.wrist_rate);
    state.Put(hand.close);
  }
  state.Put(winch_);
}

void HandbotModel::LoadTick(ByteReader& state)
{
  for (Servo& servo : servos_) servo.rate = state.Get<double>();
  for (Hand& hand : hands_)
  {
    hand.wrist_rate = state.Get<double>();
    hand.close = state.Get<std::uint8_t>() != 0;
  }
  winch_ = state.Get<double>();
}

}  // namespace swarmanoid::dynamics3d

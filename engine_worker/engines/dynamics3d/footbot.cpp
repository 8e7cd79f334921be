#include "engine_worker/engines/dynamics3d/footbot.h"

#include <algorithm>

#include "common/math/elementary.h"

namespace swarmanoid::dynamics3d
{
namespace
{

using S = FootbotShape;

constexpr double kOpenAperture = kPi / 2;
constexpr double kTurretGain = 40;   // 1/s: at few iterations a motor that is told to stand creeps under a load
constexpr double kTurretLead = 0.1;  // rad: how far the target runs ahead of a turret that is held back
constexpr GraspGeometry kGripper{0.02, S::kTurretTorque, false};

Vector3 WheelCentre(int wheel) { return {0, wheel == 0 ? S::kHalfTrack : -S::kHalfTrack, S::kWheelRadius}; }

}  // namespace

FootbotModel::FootbotModel(Scene& scene, const CSwarmanoidSpaceEntity& entity)
    : Model(scene, entity), gripper_(scene, kGripper)
{
  OdeWorld& world = scene.world;
  const double given = entity.GetConfiguration().mass_kg;
  const double scale = given > 0 ? given / S::kMass : 1;

  // Bodies, at the origin: joints made here do not depend on where the robot starts.
  AddBody(CylinderMass(scale * S::kChassisMass, 0.08, 0.1), {Vector3(0, 0, S::kCentreOfMass), Quaternion::Identity()});
  for (int wheel = 0; wheel < 2; ++wheel)
    AddBody(Geared(SphereMass(scale * S::kWheelMass, S::kWheelRadius), S::kGearedInertia),
            {WheelCentre(wheel), Quaternion::Identity()});
  for (int wheel = 0; wheel < 2; ++wheel)
  {
    const dJointID axle = dJointCreateHinge(world.World(), nullptr);
    const Vector3 centre = WheelCentre(wheel);
    dJointAttach(axle, world.Body(bodies_[static_cast<std::size_t>(1 + wheel)].number), Chassis());
    dJointSetHingeAnchor(axle, centre.x(), centre.y(), centre.z());
    dJointSetHingeAxis(axle, 0, 1, 0);
    dJointSetHingeParam(axle, dParamFMax, scale * S::kWheelTorque);
    axles_[wheel] = axle;
  }

  world.BeginEntity(Entity());
  const auto in_chassis = [](double x, double z) -> Pose {
    return {Vector3(x, 0, z - S::kCentreOfMass), Quaternion::Identity()};
  };
  const double body_height = S::kHeight - S::kClearance;
  world.AddSolid(dCreateCylinder(nullptr, S::kRadius, body_height), bodies_[0].number, ELayer::kRobot, ESurface::kPlain,
                 in_chassis(0, S::kClearance + body_height / 2));
  for (const double x : {S::kCasterReach, -S::kCasterReach})
    world.AddSolid(dCreateSphere(nullptr, S::kCasterRadius), bodies_[0].number, ELayer::kWheel, ESurface::kCaster,
                   in_chassis(x, S::kCasterRadius));
  for (std::size_t wheel = 1; wheel <= 2; ++wheel)
    world.AddSolid(dCreateSphere(nullptr, S::kWheelRadius), bodies_[wheel].number, ELayer::kWheel, ESurface::kWheel);
  if (scene.has_voxels)
    world.AddSolid(dCreateSphere(nullptr, S::kRadius), bodies_[0].number, ELayer::kProbe, ESurface::kPlain,
                   in_chassis(0, S::kClearance + S::kRadius));
}

void FootbotModel::Place(const Pose& pose)
{
  Model::Place(pose);
  velocity_at_start_.setZero();
}

void FootbotModel::Command(std::string_view channel, std::span<const double> values)
{
  if (channel == "footbot_wheels")
  {
    wheel_command_[0] = values[0];
    wheel_command_[1] = values[1];
  }
  else if (channel == "footbot_gripper")
  {
    lock_ = values[0] > 0.5;
    aperture_ = (1 - std::clamp(values[0], 0.0, 1.0)) * kOpenAperture;
  }
  else if (channel == "footbot_turret")
    turret_command_ = std::clamp(values[0], -S::kMaximumTurretSpeed, S::kMaximumTurretSpeed);
}

void FootbotModel::BeginTick()
{
  velocity_at_start_ = VectorOf(dBodyGetLinearVel(Chassis()));
  wheel_turn_[0] = wheel_turn_[1] = 0;
  grip_force_.setZero();
  grip_torque_ = 0;
  elapsed_ = 0;
  UpdateGripper();
}

void FootbotModel::UpdateGripper()
{
  if (!lock_)
  {
    if (gripper_.IsHolding()) gripper_.Release();
    return;
  }
  if (gripper_.IsHolding()) return;
  const Pose chassis = PoseOf(Chassis());
  const SinCos turret = SinCosOf(turret_angle_);
  const double height = S::kGripperHeight - S::kCentreOfMass;
  gripper_.TryToHold(Entity(), bodies_[0].number,
                     chassis.Apply({turret.cos * S::kRadius, turret.sin * S::kRadius, height}),
                     chassis.Apply({0, 0, height}), chassis.orientation * Vector3::UnitZ(), nullptr);
  turret_target_ = turret_angle_;
}

void FootbotModel::BeforeStep(double seconds)
{
  for (std::size_t wheel = 0; wheel < 2; ++wheel) dJointSetHingeParam(axles_[wheel], dParamVel, wheel_command_[wheel]);
  Link* link = gripper_.link();
  if (link == nullptr) return;
  turret_target_ =
      std::clamp(turret_target_ + turret_command_ * seconds, turret_angle_ - kTurretLead, turret_angle_ + kTurretLead);
  const double speed = turret_command_ + kTurretGain * (turret_target_ - turret_angle_);
  link->SetMotorSpeed(std::clamp(speed, -S::kMaximumTurretSpeed, S::kMaximumTurretSpeed));
}

double FootbotModel::WheelSpeed(std::size_t wheel) const { return dJointGetHingeAngleRate(axles_[wheel]); }

void FootbotModel::AfterStep(double seconds)
{
  elapsed_ += seconds;
  for (std::size_t wheel = 0; wheel < 2; ++wheel) wheel_turn_[wheel] += WheelSpeed(wheel) * seconds;

  // The turret follows what it holds, or its command.
  const Link* link = gripper_.link();
  turret_angle_ += (link != nullptr ? link->HingeSpeed() : turret_command_) * seconds;
  if (link == nullptr) return;
  const Vector3 axis = VectorToWorld(Chassis(), Vector3::UnitZ());
  grip_torque_ += link->TorqueOnA().dot(axis) * seconds;
  grip_force_ += VectorFromWorld(Chassis(), link->ForceOnA()) * seconds;
}

void FootbotModel::Sense(std::string_view channel, std::span<double> values) const
{
  if (elapsed_ <= 0) return Model::Sense(channel, values);
  if (channel == "footbot_encoders")
  {
    for (std::size_t wheel = 0; wheel < 2; ++wheel) values[wheel] = wheel_turn_[wheel] * S::kWheelRadius;
  }
  else if (channel == "footbot_turret_torque")
  {
    const SinCos turret = SinCosOf(turret_angle_);
    const Vector3 force = grip_force_ / elapsed_;
    const auto part = [](double value, double range) { return std::clamp(value / range, -1.0, 1.0); };
    values[0] = part(turret.cos * force.x() + turret.sin * force.y(), S::kTractionRange);
    values[1] = part(turret.cos * force.y() - turret.sin * force.x(), S::kTractionRange);
    values[2] = part(grip_torque_ / elapsed_, S::kTurretTorque);
  }
  else if (channel == "footbot_accelerometer")
  {
    const Vector3 change = VectorOf(dBodyGetLinearVel(Chassis())) - velocity_at_start_;
    const Vector3 felt = VectorFromWorld(Chassis(), change / elapsed_ - scene_.world.Settings().gravity);
    for (int k = 0; k < 3; ++k) values[static_cast<std::size_t>(k)] = felt[k];
  }
  else
    Model::Sense(channel, values);
}

void FootbotModel::Report(AttributeReport& report) const
{
  report.Set("gripper_aperture", aperture_);
  report.Set("gripped", gripper_.IsHolding() ? 1.0 + gripper_.Held() : 0);
  report.Set("turret_angle", WrapAngle(turret_angle_), 0, 1e-6);
}

void FootbotModel::Save(ByteWriter& state) const
{
  state.Put(turret_angle_);
  state.Put(turret_target_);
  state.Put(aperture_);
  gripper_.Save(state);
}

void FootbotModel::Load(ByteReader& state)
{
  turret_angle_ = state.Get<double>();
  turret_target_ = state.Get<double>();
  aperture_ = state.Get<double>();
  gripper_.Load(state);
}

}  // namespace swarmanoid::dynamics3d

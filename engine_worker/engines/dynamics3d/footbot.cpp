#include "engine_worker/engines/dynamics3d/footbot.h"

#include <algorithm>
#include <cmath>

#include "common/math/elementary.h"

namespace swarmanoid::dynamics3d
{
namespace
{

constexpr double kOpenAperture = kPi / 2;
constexpr double kTurretGain = 40;       // 1/s: at few iterations a motor that is told to stand creeps under a load
constexpr double kTurretLead = 0.1;      // rad: how far the target runs ahead of a turret that is held back
constexpr double kFastestTurret = 1000;  // rad/s, as in dynamics2d
// A turret that catches up with its target goes at least this fast.
constexpr double kCatchUp = kPi;  // rad/s
constexpr GraspGeometry kGripper{0.02, FootbotShape::kTurretTorque, false};

WheeledShape ShapeOf(const CSwarmanoidSpaceEntity& entity)
{
  const double given = entity.GetConfiguration().mass_kg;
  const double scale = given > 0 ? given / FootbotShape::kMass : 1;
  return {.size = {FootbotShape::kRadius, FootbotShape::kRadius, FootbotShape::kHeight},
          .clearance = FootbotShape::kClearance,
          .wheel_radius = FootbotShape::kWheelRadius,
          .half_track = FootbotShape::kHalfTrack,
          .caster_radius = FootbotShape::kCasterRadius,
          .caster_reach = {FootbotShape::kCasterReach, FootbotShape::kCasterReach},
          .chassis_mass = scale * FootbotShape::kChassisMass,
          .wheel_mass = scale * FootbotShape::kWheelMass,
          .centre_of_mass = FootbotShape::kCentreOfMass,
          .inertia_radius = 0.08,
          .inertia_height = 0.1,
          .free_speed = FootbotShape::kFreeSpeed};
}

}  // namespace

FootbotModel::FootbotModel(Scene& scene, const CSwarmanoidSpaceEntity& entity)
    : WheeledModel(scene, entity, ShapeOf(entity)), gripper_(scene, kGripper)
{
}

void FootbotModel::Place(const Pose& pose)
{
  Model::Place(pose);
  velocity_at_start_.setZero();
}

void FootbotModel::FollowAttributes()
{
  turret_angle_ = turret_target_ = GetSpaceEntity().GetAttribute("turret_angle");
  aperture_ = GetSpaceEntity().GetAttribute("gripper_aperture");
}

void FootbotModel::Command(std::string_view channel, std::span<const double> values)
{
  if (channel == "footbot_gripper")
  {
    lock_ = values[0] > 0.5;
    aperture_ = (1 - std::clamp(values[0], 0.0, 1.0)) * kOpenAperture;
  }
  else if (channel == "footbot_turret")
    turret_command_ = std::clamp(values[0], -kFastestTurret, kFastestTurret);
  else
    WheeledModel::Command(channel, values);
}

void FootbotModel::BeginTick()
{
  WheeledModel::BeginTick();
  velocity_at_start_ = VectorOf(dBodyGetLinearVel(Chassis()));
  grip_force_.setZero();
  grip_torque_ = 0;
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
  const double height = FootbotShape::kGripperHeight - FootbotShape::kCentreOfMass;
  gripper_.TryToHold(Entity(), bodies_[0].number,
                     chassis.Apply({turret.cos * GripperSquare::kReach, turret.sin * GripperSquare::kReach, height}),
                     chassis.Apply({0, 0, height}), chassis.orientation * Vector3::UnitZ(), nullptr);
  turret_target_ = turret_angle_;
}

void FootbotModel::BeforeStep(double seconds)
{
  WheeledModel::BeforeStep(seconds);
  Link* link = gripper_.link();
  if (link == nullptr) return;
  turret_target_ =
      std::clamp(turret_target_ + turret_command_ * seconds, turret_angle_ - kTurretLead, turret_angle_ + kTurretLead);
  const double speed = turret_command_ + kTurretGain * (turret_target_ - turret_angle_);
  const double fastest = std::max(kCatchUp, std::abs(turret_command_));
  link->SetMotorSpeed(std::clamp(speed, -fastest, fastest));
}

void FootbotModel::AfterStep(double seconds)
{
  WheeledModel::AfterStep(seconds);
  // The turret turns with the gripped body, or by its command if the gripper is empty.
  const Link* link = gripper_.link();
  turret_angle_ += (link != nullptr ? link->HingeSpeed() : turret_command_) * seconds;
  if (link == nullptr) return;
  const Vector3 axis = VectorToWorld(Chassis(), Vector3::UnitZ());
  grip_torque_ += link->TorqueOnA().dot(axis) * seconds;
  grip_force_ += VectorFromWorld(Chassis(), link->ForceOnA()) * seconds;
}

void FootbotModel::AfterFreeMotion(double seconds)
{
  WheeledModel::AfterFreeMotion(seconds);
  turret_angle_ += turret_command_ * seconds;
}

void FootbotModel::Sense(std::string_view channel, std::span<double> values) const
{
  if (Elapsed() <= 0) return Model::Sense(channel, values);
  if (channel == "footbot_turret_torque")
  {
    const SinCos turret = SinCosOf(turret_angle_);
    const Vector3 force = grip_force_ / Elapsed();
    const auto part = [](double value, double range) { return std::clamp(value / range, -1.0, 1.0); };
    values[0] = part(turret.cos * force.x() + turret.sin * force.y(), FootbotShape::kTractionRange);
    values[1] = part(turret.cos * force.y() - turret.sin * force.x(), FootbotShape::kTractionRange);
    values[2] = part(grip_torque_ / Elapsed(), FootbotShape::kTurretTorque);
  }
  else if (channel == "footbot_accelerometer")
  {
    const Vector3 change = VectorOf(dBodyGetLinearVel(Chassis())) - velocity_at_start_;
    const Vector3 felt = VectorFromWorld(Chassis(), change / Elapsed() - scene_.world.Settings().gravity);
    for (int k = 0; k < 3; ++k) values[static_cast<std::size_t>(k)] = felt[k];
  }
  else
    WheeledModel::Sense(channel, values);
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

void FootbotModel::SaveTick(ByteWriter& state) const
{
  WheeledModel::SaveTick(state);
  state.Put(turret_command_);
  state.Put(grip_torque_);
  for (int k = 0; k < 3; ++k) state.Put(grip_force_[k]);
}

void FootbotModel::LoadTick(ByteReader& state)
{
  WheeledModel::LoadTick(state);
  turret_command_ = state.Get<double>();
  grip_torque_ = state.Get<double>();
  for (int k = 0; k < 3; ++k) grip_force_[k] = state.Get<double>();
}

}  // namespace swarmanoid::dynamics3d

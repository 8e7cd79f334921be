// Problem: hold a flying robot, which can push only along its own axis, at the place that its velocity commands ask
// for.
//
// Method: a cascade of two loops. A reference goes ahead by the commanded velocities. The place loop asks for the
// acceleration of a spring and a damper towards it. The attitude loop tilts the robot's axis towards that force by
// torques, and turns it to the reference yaw. Thrust is the part of the force along the axis, never below 0.
//
// Invariants: the reference is at most kFurthestReference (m) ahead of the robot on each axis, so that a robot that was
// held back does not jump. While the magnet holds the robot, neither thrust nor torque acts.
#include "engine_worker/engines/dynamics3d/eyebot.h"

#include <algorithm>
#include <cmath>

#include "common/math/elementary.h"

namespace swarmanoid::dynamics3d
{
namespace
{

// Place: critically damped at 3 rad/s. Attitude: at 12 rad/s, so that the place loop may take it as instant.
constexpr double kPlaceGain = 9;
constexpr double kVelocityGain = 6;
constexpr double kTiltGain = 144;
constexpr double kTiltDamping = 24;
constexpr double kYawGain = 36;
constexpr double kYawDamping = 12;
constexpr double kFurthestReference = 0.25;  // m: how far the reference runs ahead of a robot that is held back
constexpr double kMostHorizontal = 3;        // m/s²: a tilt of 17 degrees
constexpr double kMostVertical = 5;          // m/s²
constexpr double kMostAngular = 60;          // rad/s²

double Limited(double value, double limit) { return std::clamp(value, -limit, limit); }

}  // namespace

EyebotModel::EyebotModel(Scene& scene, const CSwarmanoidSpaceEntity& entity, double ceiling_m)
    : Model(scene, entity), ceiling_(ceiling_m)
{
  OdeWorld& world = scene.world;
  const double given = entity.GetConfiguration().mass_kg;
  AddBody(CylinderMass(given > 0 ? given : EyebotShape::kMass, 0.18, 0.3),
          {Vector3(0, 0, EyebotShape::kCentreOfMass), Quaternion::Identity()});

  world.BeginEntity(Entity());
  const auto at = [](double x, double y, double z) -> Pose {
    return {Vector3(x, y, z - EyebotShape::kCentreOfMass), Quaternion::Identity()};
  };
  world.AddSolid(dCreateCylinder(nullptr, EyebotShape::kRingRadius, EyebotShape::kRingHeight), MainBody(),
                 ELayer::kRobot, ESurface::kPlain, at(0, 0, EyebotShape::kRingCentre));
  const double rod_length = EyebotShape::kHeight - EyebotShape::kRingCentre;
  world.AddSolid(dCreateBox(nullptr, EyebotShape::kRodSide, EyebotShape::kRodSide, rod_length), MainBody(),
                 ELayer::kRobot, ESurface::kPlain, at(0, 0, EyebotShape::kRingCentre + rod_length / 2));
  const double leg_length = EyebotShape::kRingCentre - 2 * EyebotShape::kLegRadius;
  for (const double x : {EyebotShape::kLegReach, -EyebotShape::kLegReach})
    for (const double y : {EyebotShape::kLegReach, -EyebotShape::kLegReach})
      world.AddSolid(dCreateCapsule(nullptr, EyebotShape::kLegRadius, leg_length), MainBody(), ELayer::kRobot,
                     ESurface::kPlain, at(x, y, EyebotShape::kLegRadius + leg_length / 2));
}

void EyebotModel::Place(const Pose& pose)
{
  Model::Place(pose);
  const Pose in_space = scene_.frame.ToSpace(PoseOf(Body()));
  reference_ = in_space.position;
  reference_yaw_ = YawOf(in_space.orientation);
  reference_velocity_.setZero();
}

void EyebotModel::Command(std::string_view channel, std::span<const double> values)
{
  if (channel == "eyebot_propellers")
  {
    std::copy_n(values.begin(), 3, velocity_command_);
    yaw_rate_command_ = values[3];
  }
  else if (channel == "eyebot_attach")
    attach_ = values[0] > 0.5;
}

void EyebotModel::BeginTick() { UpdateAttachment(); }

void EyebotModel::UpdateAttachment()
{
  const bool attached = scene_.links.Find(magnet_) != nullptr;
  if (attached && !attach_)
  {
    scene_.links.Remove(magnet_);
    magnet_ = 0;
    Place(CurrentPose());
  }
  if (attached || !attach_) return;
  const double top = scene_.frame.ToSpace(CurrentPose()).Apply({0, 0, EyebotShape::kHeight}).z();
  if (top < ceiling_ - EyebotShape::kCeilingReach) return;
  LinkSpec spec;
  spec.kind = ELink::kFixed;
  spec.body_a = MainBody();
  spec.entity_a = Entity();
  magnet_ = scene_.links.Add(spec).Serial();
}

void EyebotModel::BeforeStep(double seconds)
{
  thrust_ = 0;
  if (scene_.links.Find(magnet_) != nullptr) return;
  TrackReference(seconds);
  const Pose here = scene_.frame.ToSpace(PoseOf(Body()));
  const Vector3 velocity = scene_.frame.VectorToSpace(VectorOf(dBodyGetLinearVel(Body())));
  const Vector3 ahead = reference_ - here.position;
  Vector3 acceleration = ahead * kPlaceGain + (reference_velocity_ - velocity) * kVelocityGain;
  const double horizontal = std::sqrt(acceleration.head<2>().squaredNorm());
  if (horizontal > kMostHorizontal) acceleration.head<2>() *= kMostHorizontal / horizontal;
  acceleration.z() = Limited(acceleration.z(), kMostVertical);
  Fly(acceleration);
}

void EyebotModel::TrackReference(double seconds)
{
  const Pose here = scene_.frame.ToSpace(PoseOf(Body()));
  reference_yaw_ = WrapAngle(reference_yaw_ + yaw_rate_command_ * seconds);
  const SinCos yaw = SinCosOf(reference_yaw_);
  const double forward = velocity_command_[0];
  const double left = velocity_command_[1];
  reference_velocity_ = {yaw.cos * forward - yaw.sin * left, yaw.sin * forward + yaw.cos * left, velocity_command_[2]};
  reference_ += reference_velocity_ * seconds;
  for (int k = 0; k < 3; ++k)
    reference_[k] = here.position[k] + Limited(reference_[k] - here.position[k], kFurthestReference);
}

void EyebotModel::Fly(const Vector3& acceleration)
{
  const dBodyID body = Body();
  const Quaternion attitude = scene_.frame.ToSpace(PoseOf(body)).orientation;
  dMass mass;
  dBodyGetMass(body, &mass);

  // Thrust along the robot's own axis, as near to the force wanted as propellers that only push up can.
  const Vector3 gravity = scene_.frame.VectorToSpace(scene_.world.Settings().gravity);
  const Vector3 wanted = (acceleration - gravity) * mass.mass;
  const Vector3 axis = attitude * Vector3::UnitZ();
  const double weight = mass.mass * std::sqrt(gravity.squaredNorm());
  thrust_ = std::clamp(wanted.dot(axis), 0.0, EyebotShape::kMaximumThrust * std::max(weight, mass.mass));
  dBodyAddRelForce(body, 0, 0, thrust_);

  // Torques about the robot's own axes: tilt towards the force wanted, yaw towards the reference.
  const double length = std::sqrt(wanted.squaredNorm());
  const Vector3 target = length > 1e-9 ? Vector3(wanted / length) : Vector3(Vector3::UnitZ());
  const Vector3 tilt_error = attitude.conjugate() * axis.cross(target);
  const double yaw_error = WrapAngle(reference_yaw_ - YawOf(attitude));
  const Vector3 spin = VectorFromWorld(body, VectorOf(dBodyGetAngularVel(body)));
  const double roll = Limited(kTiltGain * tilt_error.x() - kTiltDamping * spin.x(), kMostAngular);
  const double pitch = Limited(kTiltGain * tilt_error.y() - kTiltDamping * spin.y(), kMostAngular);
  const double yaw = Limited(kYawGain * yaw_error + kYawDamping * (yaw_rate_command_ - spin.z()), kMostAngular);
  dBodyAddRelTorque(body, mass.I[0] * roll, mass.I[5] * pitch, mass.I[10] * yaw);
}

void EyebotModel::Report(AttributeReport& report) const
{
  report.Set("attached", static_cast<const LinkTable&>(scene_.links).Find(magnet_) != nullptr ? 1 : 0);
}

void EyebotModel::Save(ByteWriter& state) const
{
  for (int k = 0; k < 3; ++k) state.Put(reference_[k]);
  state.Put(reference_yaw_);
  state.Put(magnet_);
}

void EyebotModel::Load(ByteReader& state)
{
  for (int k = 0; k < 3; ++k) reference_[k] = state.Get<double>();
  reference_yaw_ = state.Get<double>();
  magnet_ = state.Get<std::uint32_t>();
}

void EyebotModel::SaveTick(ByteWriter& state) const
{
  for (const double velocity : velocity_command_) state.Put(velocity);
  state.Put(yaw_rate_command_);
  state.Put(thrust_);
}

void EyebotModel::LoadTick(ByteReader& state)
{
  for (double& velocity : velocity_command_) velocity = state.Get<double>();
  yaw_rate_command_ = state.Get<double>();
  thrust_ = state.Get<double>();
}

}  // namespace swarmanoid::dynamics3d

// Problem: hold a flying robot, which can push only along its own axis, at the place that its velocity commands ask
// for.
//
// Method: a cascade of two loops. A reference goes ahead by the commanded velocities. The place loop asks for the
// acceleration of a spring and a damper towards it. The attitude loop tilts the robot's axis towards that force by
// torques, and turns it to the reference yaw. Thrust is the part of the force along the axis, never below 0.
//
// Rotors (rotors.h) exert both with a lag, and add their drag.
//
// Invariants: the reference is at most `furthest_reference_m` ahead of the robot on each axis, so that a robot that was
// held back does not jump. While the magnet holds the robot, neither thrust nor torque acts.
#include "engine_worker/engines/dynamics3d/propelled.h"

#include <algorithm>
#include <cmath>

#include "common/math/elementary.h"

namespace swarmanoid::dynamics3d
{
namespace
{

const Propellers& RowOf(const CSwarmanoidSpaceEntity& entity) { return *DescriptionOf(entity.GetKind()).propellers; }

// Returns the mass that the row states, or that the entity has instead, with the inertia in proportion.
dMass MassOf(const CSwarmanoidSpaceEntity& entity)
{
  const EntityKindDescription& kind = DescriptionOf(entity.GetKind());
  const double given = entity.GetConfiguration().mass_kg;
  const Vector3& inertia = kind.propellers->inertia_kg_m2;
  dMass mass;
  dMassSetParameters(&mass, kind.mass_kg, 0, 0, 0, inertia.x(), inertia.y(), inertia.z(), 0, 0, 0);
  if (given > 0 && given != kind.mass_kg) dMassAdjust(&mass, given);
  return mass;
}

dGeomID GeomOf(const SolidPart& solid)
{
  switch (solid.form)
  {
    case SolidPart::Form::kCylinder:
      return dCreateCylinder(nullptr, solid.size.x(), solid.size.z());
    case SolidPart::Form::kCapsule:
      return dCreateCapsule(nullptr, solid.size.x(), solid.size.z());
    case SolidPart::Form::kBox:
      break;
  }
  return dCreateBox(nullptr, solid.size.x(), solid.size.y(), solid.size.z());
}

// Returns the solids of a row, or one of its form and size.
std::vector<SolidPart> SolidsOf(const EntityKindDescription& kind)
{
  if (!kind.solids.empty()) return kind.solids;
  const auto form = kind.form == BodyForm::kCylinder ? SolidPart::Form::kCylinder : SolidPart::Form::kBox;
  return {{form, {0, 0, kind.size.z() / 2}, kind.size}};
}

double Limited(double value, double limit) { return std::clamp(value, -limit, limit); }

}  // namespace

PropelledModel::PropelledModel(Scene& scene, const CSwarmanoidSpaceEntity& entity, double ceiling_m)
    : Model(scene, entity),
      row_(RowOf(entity)),
      height_(entity.GetSize().z()),
      max_thrust_(row_.rotors ? row_.rotors->count * row_.rotors->max_thrust_n : row_.max_thrust_n),
      ceiling_(ceiling_m)
{
  AddBody(MassOf(entity), {Vector3(0, 0, row_.centre_of_mass_m), Quaternion::Identity()});
  scene.world.BeginEntity(Entity());
  for (const SolidPart& solid : SolidsOf(DescriptionOf(entity.GetKind())))
    scene.world.AddSolid(GeomOf(solid), MainBody(), ELayer::kRobot, ESurface::kPlain,
                         {solid.centre - Vector3(0, 0, row_.centre_of_mass_m), Quaternion::Identity()});
  if (row_.rotors) rotors_.emplace(*row_.rotors);
}

void PropelledModel::Place(const Pose& pose)
{
  Model::Place(pose);
  const Pose in_space = scene_.frame.ToSpace(PoseOf(Body()));
  reference_ = in_space.position;
  reference_yaw_ = YawOf(in_space.orientation);
  reference_velocity_.setZero();
  if (!rotors_) return;
  dMass mass;
  dBodyGetMass(Body(), &mass);
  rotors_->SpinFor(mass.mass * std::sqrt(scene_.world.Settings().gravity.squaredNorm()));
}

void PropelledModel::Command(std::string_view channel, std::span<const double> values)
{
  if (channel == "eyebot_propellers")
  {
    std::copy_n(values.begin(), 3, velocity_command_);
    yaw_rate_command_ = values[3];
  }
  else if (channel == "eyebot_attach")
    attach_ = values[0] > 0.5;
}

void PropelledModel::BeginTick()
{
  UpdateAttachment();
  if (scene_.wind.IsDeclared()) wind_ = scene_.wind.At(scene_.frame.ToSpace(CurrentPose()).position, scene_.time_s);
}

void PropelledModel::UpdateAttachment()
{
  const bool attached = scene_.links.Find(magnet_) != nullptr;
  if (attached && !attach_)
  {
    scene_.links.Remove(magnet_);
    magnet_ = 0;
    Place(CurrentPose());
  }
  if (attached || !attach_ || row_.magnet_reach_m == 0) return;
  const double top = scene_.frame.ToSpace(CurrentPose()).Apply({0, 0, height_}).z();
  if (top < ceiling_ - row_.magnet_reach_m) return;
  LinkSpec spec;
  spec.kind = ELink::kFixed;
  spec.body_a = MainBody();
  spec.entity_a = Entity();
  magnet_ = scene_.links.Add(spec).Serial();
}

void PropelledModel::BeforeStep(double seconds)
{
  thrust_ = 0;
  if (scene_.links.Find(magnet_) != nullptr) return;
  TrackReference(seconds);
  const Pose here = scene_.frame.ToSpace(PoseOf(Body()));
  const Vector3 velocity = scene_.frame.VectorToSpace(VectorOf(dBodyGetLinearVel(Body())));
  const Vector3 ahead = reference_ - here.position;
  Vector3 acceleration =
      ahead * (row_.place_rad_s * row_.place_rad_s) + (reference_velocity_ - velocity) * (2 * row_.place_rad_s);
  const double horizontal = std::sqrt(acceleration.head<2>().squaredNorm());
  if (horizontal > row_.max_across_m_s2) acceleration.head<2>() *= row_.max_across_m_s2 / horizontal;
  acceleration.z() = Limited(acceleration.z(), row_.max_upward_m_s2);
  Fly(acceleration, seconds);
}

void PropelledModel::TrackReference(double seconds)
{
  const Pose here = scene_.frame.ToSpace(PoseOf(Body()));
  reference_yaw_ = WrapAngle(reference_yaw_ + yaw_rate_command_ * seconds);
  const SinCos yaw = SinCosOf(reference_yaw_);
  const double forward = velocity_command_[0];
  const double left = velocity_command_[1];
  reference_velocity_ = {yaw.cos * forward - yaw.sin * left, yaw.sin * forward + yaw.cos * left, velocity_command_[2]};
  reference_ += reference_velocity_ * seconds;
  for (int k = 0; k < 3; ++k)
    reference_[k] = here.position[k] + Limited(reference_[k] - here.position[k], row_.furthest_reference_m);
}

void PropelledModel::Fly(const Vector3& acceleration, double seconds)
{
  const dBodyID body = Body();
  const Quaternion attitude = scene_.frame.ToSpace(PoseOf(body)).orientation;
  dMass mass;
  dBodyGetMass(body, &mass);

  // Thrust along the robot's own axis, as near to the force wanted as propellers that only push up can.
  const Vector3 gravity = scene_.frame.VectorToSpace(scene_.world.Settings().gravity);
  const Vector3 wanted = (acceleration - gravity) * mass.mass;
  const Vector3 axis = attitude * Vector3::UnitZ();
  const double thrust = std::clamp(wanted.dot(axis), 0.0, max_thrust_);

  // Torques about the robot's own axes: tilt towards the force wanted, yaw towards the reference.
  const double length = std::sqrt(wanted.squaredNorm());
  const Vector3 target = length > 1e-9 ? Vector3(wanted / length) : Vector3(Vector3::UnitZ());
  const Vector3 tilt_error = attitude.conjugate() * axis.cross(target);
  const double yaw_error = WrapAngle(reference_yaw_ - YawOf(attitude));
  const Vector3 spin = VectorFromWorld(body, VectorOf(dBodyGetAngularVel(body)));
  const auto turn = [&](double rate, double error, double spin_error)
  { return Limited(rate * rate * error + 2 * rate * spin_error, row_.max_angular_rad_s2); };
  const double roll = turn(row_.tilt_rad_s, tilt_error.x(), -spin.x());
  const double pitch = turn(row_.tilt_rad_s, tilt_error.y(), -spin.y());
  const double yaw = turn(row_.yaw_rad_s, yaw_error, yaw_rate_command_ - spin.z());
  Exert(thrust, {mass.I[0] * roll, mass.I[5] * pitch, mass.I[10] * yaw}, seconds);
}

void PropelledModel::Exert(double thrust, const Vector3& torque, double seconds)
{
  RotorSet::Wrench exerted{thrust, torque};
  if (rotors_) exerted = rotors_->Advance(exerted, seconds);
  Vector3 drag = Vector3::Zero();
  if (rotors_ || scene_.wind.IsDeclared())
  {
    const Vector3 in_air = VectorOf(dBodyGetLinearVel(Body())) - scene_.frame.VectorToLocal(wind_);
    const Vector3 along_axes = VectorFromWorld(Body(), in_air);
    drag = rotors_ ? rotors_->Drag(along_axes) : Vector3(-row_.drag_in_wind.cwiseProduct(along_axes));
  }
  thrust_ = exerted.thrust;
  dBodyAddRelForce(Body(), drag.x(), drag.y(), drag.z() + thrust_);
  dBodyAddRelTorque(Body(), exerted.torque.x(), exerted.torque.y(), exerted.torque.z());
}

void PropelledModel::Report(AttributeReport& report) const
{
  if (row_.magnet_reach_m == 0) return;
  report.Set("attached", static_cast<const LinkTable&>(scene_.links).Find(magnet_) != nullptr ? 1 : 0);
}

void PropelledModel::Save(ByteWriter& state) const
{
  for (int k = 0; k < 3; ++k) state.Put(reference_[k]);
  state.Put(reference_yaw_);
  state.Put(magnet_);
  if (rotors_) rotors_->Save(state);
}

void PropelledModel::Load(ByteReader& state)
{
  for (int k = 0; k < 3; ++k) reference_[k] = state.Get<double>();
  reference_yaw_ = state.Get<double>();
  magnet_ = state.Get<std::uint32_t>();
  if (rotors_) rotors_->Load(state);
}

void PropelledModel::SaveTick(ByteWriter& state) const
{
  for (const double velocity : velocity_command_) state.Put(velocity);
  state.Put(yaw_rate_command_);
  state.Put(thrust_);
  if (scene_.wind.IsDeclared())
    for (const double wind : wind_) state.Put(wind);
}

void PropelledModel::LoadTick(ByteReader& state)
{
  for (double& velocity : velocity_command_) velocity = state.Get<double>();
  yaw_rate_command_ = state.Get<double>();
  thrust_ = state.Get<double>();
  if (scene_.wind.IsDeclared())
    for (double& wind : wind_) wind = state.Get<double>();
}

}  // namespace swarmanoid::dynamics3d

#include "engine_worker/engines/dynamics3d/model.h"

#include <algorithm>
#include <cmath>

namespace swarmanoid::dynamics3d
{

bool Scene::CanBeHeld(std::uint32_t entity) const
{
  if (entity >= models.size() || models[entity] == nullptr || models[entity]->IsElsewhere()) return false;
  return DescriptionOf(models[entity]->GetSpaceEntity().GetKind()).grippable;
}

void AttributeReport::Set(std::string_view name, double value, int element, double tolerance)
{
  if (std::abs(value - entity_.GetAttribute(name, element)) <= tolerance) return;
  changes_.Add(entity_.SlotOf(name, element), value);
}

void Model::AddBody(const dMass& mass, const Pose& in_entity, EBody kind)
{
  bodies_.push_back({scene_.world.AddBody(kind, mass, in_entity), in_entity});
}

void Model::Place(const Pose& pose)
{
  for (const PlacedBody& placed : bodies_)
  {
    const dBodyID body = scene_.world.Body(placed.number);
    const RawPose here = RawOf(pose.Compose(placed.in_entity));
    if (wakes_ && here != RawPoseOf(body)) scene_.world.WakeAll();
    SetRawPose(body, here);
    Stop(body);
  }
}

void Model::Carry(const Pose& pose)
{
  const Pose way = pose.Compose(CurrentPose().Inverse());
  for (const PlacedBody& placed : bodies_)
  {
    const dBodyID body = scene_.world.Body(placed.number);
    SetRawPose(body, RawOf(way.Compose(PoseOf(body))));
    Stop(body);
  }
}

Pose Model::CurrentPose() const
{
  const PlacedBody& main = bodies_.front();
  return PoseOf(scene_.world.Body(main.number)).Compose(main.in_entity.Inverse());
}

void Model::SetLeftOut(bool left_out)
{
  is_left_out_ = left_out;
  for (const PlacedBody& placed : bodies_) scene_.world.SetLeftOut(placed.number, left_out);
}

void Model::TakeOver(const Pose& pose, const EntityVelocity& velocity)
{
  SetLeftOut(false);
  Place(pose);
  FollowAttributes();
  SetVelocity(velocity);
}

void Model::Haunt(const Pose& pose, const EntityVelocity& velocity)
{
  wakes_ = false;
  TakeOver(pose, velocity);
  wakes_ = true;
}

void Model::SetVelocity(const EntityVelocity& velocity)
{
  const Vector3 origin = CurrentPose().position;
  for (const PlacedBody& placed : bodies_)
  {
    const dBodyID body = scene_.world.Body(placed.number);
    const Vector3 linear = velocity.linear + velocity.angular.cross(Vector3(VectorOf(dBodyGetPosition(body)) - origin));
    dBodySetLinearVel(body, linear.x(), linear.y(), linear.z());
    dBodySetAngularVel(body, velocity.angular.x(), velocity.angular.y(), velocity.angular.z());
  }
}

EntityVelocity Model::Velocity() const
{
  const dBodyID body = scene_.world.Body(MainBody());
  return {PointVelocity(body, CurrentPose().position), VectorOf(dBodyGetAngularVel(body))};
}

double Model::LargestSpeed() const
{
  const Box box = scene_.world.BoxOf(MainBody());
  const double radius = Vector3(box[1] - box[0], box[3] - box[2], box[5] - box[4]).norm() / 2;
  double largest = 0;
  for (const PlacedBody& placed : bodies_)
    largest = std::max(largest, std::sqrt(VectorOf(dBodyGetLinearVel(scene_.world.Body(placed.number))).squaredNorm()));
  const Vector3 spin = VectorOf(dBodyGetAngularVel(scene_.world.Body(MainBody())));
  return largest + radius * std::sqrt(spin.squaredNorm());
}

void Model::SaveWithin(ByteWriter& state) const
{
  state.Put(is_left_out_);
  scene_.world.SaveBodies(assembly_, state);
  Save(state);
  SaveTick(state);
}

void Model::LoadWithin(ByteReader& state)
{
  is_left_out_ = state.Get<std::uint8_t>() != 0;
  scene_.world.LoadBodies(assembly_, state);
  Load(state);
  LoadTick(state);
}

void Model::Command(std::string_view, std::span<const double>) {}

void Model::Sense(std::string_view, std::span<double> values) const
{
  for (double& value : values) value = 0;
}

dMass CylinderMass(double mass, double radius, double height)
{
  dMass result;
  dMassSetCylinderTotal(&result, mass, 3, radius, height);
  return result;
}

dMass BoxMass(double mass, const Vector3& size)
{
  dMass result;
  dMassSetBoxTotal(&result, mass, size.x(), size.y(), size.z());
  return result;
}

dMass SphereMass(double mass, double radius)
{
  dMass result;
  dMassSetSphereTotal(&result, mass, radius);
  return result;
}

dMass HullMass(double mass, const ConvexHull& hull)
{
  const Eigen::Matrix3d inertia = hull.inertia * (mass / hull.volume);
  dMass result;
  dMassSetParameters(&result, mass, 0, 0, 0, inertia(0, 0), inertia(1, 1), inertia(2, 2), inertia(0, 1), inertia(0, 2),
                     inertia(1, 2));
  return result;
}

dMass Geared(dMass mass, double factor)
{
  for (const int diagonal : {0, 5, 10}) mass.I[diagonal] *= factor;
  return mass;
}

}  // namespace swarmanoid::dynamics3d

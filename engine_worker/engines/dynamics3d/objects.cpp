#include "engine_worker/engines/dynamics3d/objects.h"

#include <algorithm>
#include <cmath>

#include "common/math/elementary.h"

namespace swarmanoid::dynamics3d
{
namespace
{

// Faster than this, a mirror was put elsewhere rather than moved.
constexpr double kFastestMirror = 5;  // m/s

bool IsCylinder(EntityKind kind) { return DescriptionOf(kind).form == BodyForm::kCylinder; }

bool StandsOnBase(EntityKind kind) { return DescriptionOf(kind).origin == BodyOrigin::kBase; }

// The outline of an entity of any kind.
dGeomID OutlineOf(const CSwarmanoidSpaceEntity& entity)
{
  const Vector3& size = entity.GetSize();
  if (IsCylinder(entity.GetKind())) return dCreateCylinder(nullptr, size.x(), size.z());
  return dCreateBox(nullptr, size.x(), size.y(), size.z());
}

Pose CentreOf(const CSwarmanoidSpaceEntity& entity)
{
  const double height = StandsOnBase(entity.GetKind()) ? entity.GetSize().z() / 2 : 0;
  return {Vector3(0, 0, height), Quaternion::Identity()};
}

Touch TouchOf(const CSwarmanoidSpaceEntity& entity)
{
  const TConfigurationTree& tree = entity.GetConfiguration().tree;
  const auto given = [&](const char* name)
  { return tree.Value(name) ? std::optional(tree.GetNumber(name)) : std::nullopt; };
  return {given("friction"), given("restitution"), given("ground_friction")};
}

}  // namespace

ObjectModel::ObjectModel(Scene& scene, const CSwarmanoidSpaceEntity& entity) : Model(scene, entity)
{
  const Vector3& size = entity.GetSize();
  const bool round = IsCylinder(entity.GetKind());
  const double volume = round ? kPi * size.x() * size.x() * size.z() : size.prod();
  const double given = entity.GetConfiguration().mass_kg;
  const double mass = given > 0 ? given : scene.density * volume;
  AddBody(round ? CylinderMass(mass, size.x(), size.z()) : BoxMass(mass, size), CentreOf(entity), EBody::kObject);
  scene.world.BeginEntity(Entity(), TouchOf(entity));
  scene.world.AddSolid(OutlineOf(entity), MainBody(), ELayer::kObject);
}

MirrorModel::MirrorModel(Scene& scene, const CSwarmanoidSpaceEntity& entity) : Model(scene, entity)
{
  AddBody(SphereMass(1, 1), CentreOf(entity), EBody::kMirror);
  scene.world.BeginEntity(Entity(), TouchOf(entity));
  scene.world.AddSolid(OutlineOf(entity), MainBody(), ELayer::kStatic);
  last_ = RawOf(scene.frame.ToLocal(entity.GetPose()).Compose(MainOffset()));
}

void MirrorModel::Follow()
{
  const RawPose now = RawOf(scene_.frame.ToLocal(GetSpaceEntity().GetPose()).Compose(MainOffset()));
  const Pose here = PoseOf(now);
  const Pose before = PoseOf(last_);
  const dBodyID body = scene_.world.Body(MainBody());
  SetRawPose(body, now);
  last_ = now;

  const Vector3 velocity = (here.position - before.position) / scene_.tick_seconds;
  Stop(body);
  if (velocity.squaredNorm() > kFastestMirror * kFastestMirror) return;
  // Small turns: the vector part of the quaternion is half the angle times the axis.
  Quaternion turn = here.orientation * before.orientation.conjugate();
  if (turn.w() < 0) turn.coeffs() *= -1;
  const Vector3 spin = turn.vec() * (2 / scene_.tick_seconds);
  dBodySetLinearVel(body, velocity.x(), velocity.y(), velocity.z());
  dBodySetAngularVel(body, spin.x(), spin.y(), spin.z());
}

void AddStaticObject(Scene& scene, const CSwarmanoidSpaceEntity& entity)
{
  const RawPose pose = RawOf(scene.frame.ToLocal(entity.GetPose()).Compose(CentreOf(entity)));
  const dGeomID geom = OutlineOf(entity);
  dGeomSetPosition(geom, pose.position[0], pose.position[1], pose.position[2]);
  dGeomSetQuaternion(geom, pose.quaternion);
  scene.world.BeginEntity(entity.GetIndex(), TouchOf(entity));
  scene.world.AddSolid(geom, -1, ELayer::kStatic);
}

}  // namespace swarmanoid::dynamics3d

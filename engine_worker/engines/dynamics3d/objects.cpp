#include "engine_worker/engines/dynamics3d/objects.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "common/math/elementary.h"

namespace swarmanoid::dynamics3d
{
namespace
{

// Faster than this, a mirror was put elsewhere rather than moved.
constexpr double kFastestMirror = 5;  // m/s

bool IsCylinder(EntityKind kind) { return DescriptionOf(kind).form == BodyForm::kCylinder; }

bool StandsOnBase(EntityKind kind) { return DescriptionOf(kind).origin == BodyOrigin::kBase; }

// The collision shape of an entity of any kind. `centre` is that of its body, in the frame of the entity.
struct Outline
{
  dGeomID geom = nullptr;
  Pose centre;
  std::shared_ptr<const HullShape> shape = {};  // of a hull
};

Outline OutlineOf(const CSwarmanoidSpaceEntity& entity)
{
  Outline outline;
  if (const auto& hull = entity.GetConfiguration().hull)
  {
    outline.shape = std::make_shared<const HullShape>(*hull);
    outline.geom = outline.shape->MakeGeom();
    outline.centre.position = hull->centre;
    return outline;
  }
  const Vector3& size = entity.GetSize();
  outline.geom = IsCylinder(entity.GetKind()) ? dCreateCylinder(nullptr, size.x(), size.z())
                                              : dCreateBox(nullptr, size.x(), size.y(), size.z());
  outline.centre.position.z() = StandsOnBase(entity.GetKind()) ? size.z() / 2 : 0;
  return outline;
}

void Add(OdeWorld& world, Outline outline, int body, ELayer layer)
{
  world.AddSolid(outline.geom, body, layer);
  world.KeepShape(std::move(outline.shape));
}

dMass MassOf(const CSwarmanoidSpaceEntity& entity, double density)
{
  const Vector3& size = entity.GetSize();
  const double given = entity.GetConfiguration().mass_kg;
  if (const auto& hull = entity.GetConfiguration().hull)
    return HullMass(given > 0 ? given : density * hull->volume, *hull);
  const bool round = IsCylinder(entity.GetKind());
  const double volume = round ? kPi * size.x() * size.x() * size.z() : size.prod();
  const double mass = given > 0 ? given : density * volume;
  return round ? CylinderMass(mass, size.x(), size.z()) : BoxMass(mass, size);
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
  Outline outline = OutlineOf(entity);
  AddBody(MassOf(entity, scene.density), outline.centre, EBody::kObject);
  scene.world.BeginEntity(Entity(), TouchOf(entity));
  Add(scene.world, std::move(outline), MainBody(), ELayer::kObject);
}

MirrorModel::MirrorModel(Scene& scene, const CSwarmanoidSpaceEntity& entity) : Model(scene, entity)
{
  Outline outline = OutlineOf(entity);
  AddBody(SphereMass(1, 1), outline.centre, EBody::kMirror);
  scene.world.BeginEntity(Entity(), TouchOf(entity));
  Add(scene.world, std::move(outline), MainBody(), ELayer::kStatic);
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
  Outline outline = OutlineOf(entity);
  const RawPose pose = RawOf(scene.frame.ToLocal(entity.GetPose()).Compose(outline.centre));
  dGeomSetPosition(outline.geom, pose.position[0], pose.position[1], pose.position[2]);
  dGeomSetQuaternion(outline.geom, pose.quaternion);
  scene.world.BeginEntity(entity.GetIndex(), TouchOf(entity));
  Add(scene.world, std::move(outline), -1, ELayer::kStatic);
}

}  // namespace swarmanoid::dynamics3d

#include "engine_worker/engines/dynamics3d/ode_world.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>

namespace swarmanoid::dynamics3d
{
namespace
{

struct LayerBits
{
  unsigned long category;
  unsigned long collide;
};

constexpr unsigned long Bit(ELayer layer) { return 1UL << static_cast<unsigned>(layer); }

constexpr LayerBits BitsOf(ELayer layer)
{
  switch (layer)
  {
    case ELayer::kStatic:
      return {Bit(layer), Bit(ELayer::kRobot) | Bit(ELayer::kObject) | Bit(ELayer::kWheel)};
    case ELayer::kRobot:
      return {Bit(layer), Bit(ELayer::kStatic) | Bit(ELayer::kRobot) | Bit(ELayer::kObject) | Bit(ELayer::kVoxels)};
    case ELayer::kObject:
      return {Bit(layer), Bit(ELayer::kStatic) | Bit(ELayer::kRobot) | Bit(ELayer::kObject) | Bit(ELayer::kWheel) |
                              Bit(ELayer::kVoxels)};
    case ELayer::kWheel:
      return {Bit(layer), Bit(ELayer::kStatic) | Bit(ELayer::kObject) | Bit(ELayer::kVoxels)};
    case ELayer::kVoxels:
      return {Bit(layer), Bit(ELayer::kWheel) | Bit(ELayer::kRobot) | Bit(ELayer::kObject)};
  }
  return {0, 0};
}

}  // namespace

// ODE's process-wide tables, never taken down: worlds of other engines may be in use until the process ends.
void InitialiseOde()
{
  static std::once_flag once;
  std::call_once(once, [] { dInitODE2(0); });
  thread_local const bool allocated = dAllocateODEDataForThread(dAllocateMaskAll) != 0;
  (void)allocated;
}

OdeWorld::OdeWorld(const WorldSettings& settings) : settings_(settings)
{
  InitialiseOde();
  world_ = dWorldCreate();
  dWorldSetGravity(world_, settings.gravity.x(), settings.gravity.y(), settings.gravity.z());
  // No over-relaxation: at few iterations it favours the rows that are solved last, and a resting robot creeps 16 mm/s
  // sideways instead of 4 um/s.
  dWorldSetQuickStepW(world_, 1.0);
  dWorldSetERP(world_, 0.2);
  dWorldSetCFM(world_, 1e-7);
  dWorldSetContactMaxCorrectingVel(world_, 1.0);
  dWorldSetContactSurfaceLayer(world_, 1e-4);
  dWorldSetAutoDisableFlag(world_, 0);  // its averages would be state that a checkpoint does not hold
  dWorldSetStepIslandsProcessingMaxThreadCount(world_, 1);
  // The default threading is shared by all worlds of the process and fails when two of them step at the same time.
  threading_ = dThreadingAllocateSelfThreadedImplementation();
  dWorldSetStepThreadingImplementation(world_, dThreadingImplementationGetFunctions(threading_), threading_);

  space_ = dHashSpaceCreate(nullptr);
  dHashSpaceSetLevels(space_, -5, 4);
  contact_joints_ = dJointGroupCreate(0);
  probe_ = dCreateSphere(nullptr, 1);
}

OdeWorld::~OdeWorld()
{
  dGeomDestroy(probe_);
  dJointGroupDestroy(contact_joints_);
  dSpaceDestroy(space_);
  dWorldDestroy(world_);
  dThreadingFreeImplementation(threading_);
}

int OdeWorld::AddBody(const BodyOwner& owner, const dMass& mass)
{
  const dBodyID body = dBodyCreate(world_);
  if (owner.kind == EBody::kMirror)
    dBodySetKinematic(body);
  else
    dBodySetMass(body, &mass);
  const std::size_t number = bodies_.size();
  dBodySetFiniteRotationMode(body, 0);  // the other mode calls sin(), which differs between processors
  dBodySetAutoDisableFlag(body, 0);
  dBodySetData(body, reinterpret_cast<void*>(number));
  bodies_.push_back({body, owner, {}, false});
  if (owner.entity >= object_of_.size()) object_of_.resize(owner.entity + 1, -1);
  if (owner.kind == EBody::kObject)
  {
    objects_.push_back(static_cast<int>(number));
    object_of_[owner.entity] = objects_.back();
  }
  return static_cast<int>(number);
}

void OdeWorld::SetLeftOut(int body, bool left_out)
{
  BodyRecord& record = RecordOf(body);
  if (record.is_left_out == left_out) return;
  record.is_left_out = left_out;
  left_out_count_ += left_out ? 1 : static_cast<std::size_t>(-1);
  const auto set = reinterpret_cast<dGeomID>(dGeomGetSpace(dBodyGetFirstGeom(record.body)));
  if (left_out)
  {
    dBodyDisable(record.body);
    dGeomDisable(set);
    return;
  }
  dBodyEnable(record.body);
  dGeomEnable(set);
}

std::array<double, 6> OdeWorld::BoxOf(int body) const
{
  std::array<double, 6> box;
  dGeomGetAABB(reinterpret_cast<dGeomID>(dGeomGetSpace(dBodyGetFirstGeom(Body(body)))), box.data());
  return box;
}

void OdeWorld::BeginEntity(std::uint32_t entity, const Touch& touch)
{
  current_entity_ = entity;
  current_touch_ = touch;
  current_set_ = nullptr;
}

void OdeWorld::AddSolid(dGeomID geom, int body, ELayer layer, ESurface surface, const Pose& offset_in_body)
{
  auto solid = std::make_unique<Solid>();
  solid->geom = geom;
  solid->number = static_cast<std::uint32_t>(solids_.size());
  solid->entity = current_entity_;
  solid->surface = surface;
  solid->layer = layer;
  solid->touch = current_touch_;
  dGeomSetData(geom, solid.get());
  const LayerBits bits = BitsOf(layer);
  dGeomSetCategoryBits(geom, bits.category);
  dGeomSetCollideBits(geom, bits.collide);
  if (body >= 0 && current_set_ == nullptr) current_set_ = dSimpleSpaceCreate(space_);
  dSpaceAdd(body < 0 ? space_ : current_set_, geom);
  if (body >= 0)
  {
    dGeomSetBody(geom, Body(body));
    const Vector3& p = offset_in_body.position;
    const Quaternion& q = offset_in_body.orientation;
    if (!p.isZero(0)) dGeomSetOffsetPosition(geom, p.x(), p.y(), p.z());
    if (!q.vec().isZero(0))
    {
      const dQuaternion raw = {q.w(), q.x(), q.y(), q.z()};
      dGeomSetOffsetQuaternion(geom, raw);
    }
  }
  solids_.push_back(std::move(solid));
}

void OdeWorld::Ignore(std::uint32_t a, std::uint32_t b)
{
  const auto [low, high] = std::minmax(a, b);
  for (IgnoredPair& pair : ignored_)
  {
    if (pair.low != low || pair.high != high) continue;
    ++pair.count;
    return;
  }
  ignored_.push_back({low, high, 1});
}

void OdeWorld::Respect(std::uint32_t a, std::uint32_t b)
{
  const auto [low, high] = std::minmax(a, b);
  for (std::size_t k = 0; k < ignored_.size(); ++k)
  {
    if (ignored_[k].low != low || ignored_[k].high != high) continue;
    if (--ignored_[k].count == 0) ignored_.erase(ignored_.begin() + static_cast<std::ptrdiff_t>(k));
    return;
  }
}

bool OdeWorld::IsIgnored(std::uint32_t a, std::uint32_t b) const
{
  const std::uint32_t low = std::min(a, b), high = std::max(a, b);
  return std::any_of(ignored_.begin(), ignored_.end(),
                     [&](const IgnoredPair& pair) { return pair.low == low && pair.high == high; });
}

const Solid* OdeWorld::FindTouching(const Vector3& centre, double radius, std::uint32_t but_not,
                                    const std::function<bool(const Solid&)>& accept) const
{
  dGeomSphereSetRadius(probe_, radius);
  dGeomSetPosition(probe_, centre.x(), centre.y(), centre.z());
  const Solid* deepest = nullptr;
  double depth = 0;
  for (const auto& solid : solids_)
  {
    if (solid->entity == but_not || solid->entity == kNoEntity) continue;
    if (solid->layer == ELayer::kWheel) continue;
    if (!accept(*solid)) continue;
    std::array<dReal, 6> box;
    dGeomGetAABB(solid->geom, box.data());
    bool near = true;
    for (std::size_t k = 0; k < 3 && near; ++k)
    {
      const double c = centre[static_cast<Eigen::Index>(k)];
      near = c + radius >= box[2 * k] && c - radius <= box[2 * k + 1];
    }
    if (!near) continue;
    std::array<dContactGeom, kMaximumContacts> contacts;
    const int count = Collide(probe_, solid->geom, contacts);
    for (int k = 0; k < count; ++k)
    {
      const double here = contacts[static_cast<std::size_t>(k)].depth;
      if (deepest != nullptr && here <= depth) continue;
      deepest = solid.get();
      depth = here;
    }
  }
  return deepest;
}

double OdeWorld::DistanceToStatic(const Vector3& origin, const Vector3& direction, double range) const
{
  const dGeomID ray = dCreateRay(nullptr, range);
  dGeomRaySet(ray, origin.x(), origin.y(), origin.z(), direction.x(), direction.y(), direction.z());
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& solid : solids_)
  {
    if (dGeomGetBody(solid->geom) != nullptr) continue;
    dContactGeom contact;
    if (Collide(ray, solid->geom, {&contact, 1}) > 0) nearest = std::min(nearest, contact.depth);
  }
  dGeomDestroy(ray);
  return nearest;
}

RawPose RawPoseOf(dBodyID body)
{
  RawPose pose;
  std::copy_n(dBodyGetPosition(body), 3, pose.position);
  std::copy_n(dBodyGetQuaternion(body), 4, pose.quaternion);
  return pose;
}

void SetRawPose(dBodyID body, const RawPose& pose)
{
  // dBodySetQuaternion would normalise again and change the last bits. So quaternion and rotation are written through
  // the pointers.
  std::copy_n(pose.quaternion, 4, const_cast<dReal*>(dBodyGetQuaternion(body)));
  dRfromQ(const_cast<dReal*>(dBodyGetRotation(body)), pose.quaternion);
  dBodySetPosition(body, pose.position[0], pose.position[1], pose.position[2]);
}

Pose PoseOf(const RawPose& raw)
{
  return {Vector3(raw.position[0], raw.position[1], raw.position[2]),
          Quaternion(raw.quaternion[0], raw.quaternion[1], raw.quaternion[2], raw.quaternion[3])};
}

RawPose RawOf(const Pose& pose)
{
  const Quaternion q = pose.orientation.normalized();
  const Vector3& p = pose.position;
  return {{p.x(), p.y(), p.z()}, {q.w(), q.x(), q.y(), q.z()}};
}

Pose PoseOf(dBodyID body) { return PoseOf(RawPoseOf(body)); }

Vector3 PointVelocity(dBodyID body, const Vector3& point)
{
  const Vector3 arm = point - VectorOf(dBodyGetPosition(body));
  return VectorOf(dBodyGetLinearVel(body)) + VectorOf(dBodyGetAngularVel(body)).cross(arm);
}

Vector3 VectorToWorld(dBodyID body, const Vector3& v)
{
  dVector3 out;
  dBodyVectorToWorld(body, v.x(), v.y(), v.z(), out);
  return VectorOf(out);
}

Vector3 VectorFromWorld(dBodyID body, const Vector3& v)
{
  dVector3 out;
  dBodyVectorFromWorld(body, v.x(), v.y(), v.z(), out);
  return VectorOf(out);
}

void Stop(dBodyID body)
{
  dBodySetLinearVel(body, 0, 0, 0);
  dBodySetAngularVel(body, 0, 0, 0);
}

}  // namespace swarmanoid::dynamics3d

// The bodies, solids and settings of an engine. solver_world.h has the worlds that solve them. Everything that ODE
// keeps from step to step and that decides about bits is read and written here as raw numbers: poses without
// normalising, the state of rest, pairs that do not collide. ODE cannot move a body from one world to another, so a
// body is made again in the other world. Hinges are made at the first poses of their bodies, as at the start, since
// other poses would change their last bits.
#include "engine_worker/engines/dynamics3d/ode_world.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <stdexcept>

#include "engine_worker/engines/dynamics3d/shuffle.h"
#include "engine_worker/engines/dynamics3d/solver_world.h"

namespace swarmanoid::dynamics3d
{

// ODE's process-wide tables are never released, since worlds of other engines may be in use until the process ends.
void InitialiseOde()
{
  static std::once_flag once;
  std::call_once(once, [] { dInitODE2(0); });
  thread_local const bool allocated = dAllocateODEDataForThread(dAllocateMaskAll) != 0;
  (void)allocated;
  static const bool is_shuffle_ours = IsShuffleOurs();
  if (!is_shuffle_ours)
    throw std::runtime_error("another library loaded ODE before the simulator, so that threads would change results");
}

OdeWorld::OdeWorld(const WorldSettings& settings) : settings_(settings)
{
  InitialiseOde();
  probe_ = dCreateSphere(nullptr, 1);
}

OdeWorld::~OdeWorld()
{
  dGeomDestroy(probe_);
  for (const auto& solid : solids_)
    if (solid->body < 0) dGeomDestroy(solid->geom);
  for (const Assembly& assembly : assemblies_)
    if (assembly.geoms != nullptr) dSpaceDestroy(assembly.geoms);
}

std::uint32_t OdeWorld::BeginAssembly(std::uint32_t entity)
{
  const auto number = static_cast<std::uint32_t>(assemblies_.size());
  const auto bodies = static_cast<int>(bodies_.size());
  const auto hinges = static_cast<int>(hinges_.size());
  const auto solids = static_cast<std::uint32_t>(solids_.size());
  if (number % kHomeSize == 0) homes_.push_back(std::make_unique<SolverWorld>(*this));
  Assembly& assembly = assemblies_.emplace_back();
  assembly.entity = entity;
  assembly.first_body = assembly.end_body = bodies;
  assembly.first_hinge = assembly.end_hinge = hinges;
  assembly.first_solid = assembly.end_solid = solids;
  assembly.world = homes_.back().get();
  return number;
}

int OdeWorld::AddBody(EBody kind, const dMass& mass, const Pose& first)
{
  const auto number = static_cast<int>(bodies_.size());
  const auto assembly = static_cast<std::uint32_t>(assemblies_.size() - 1);
  const std::uint32_t entity = assemblies_.back().entity;
  bodies_.push_back({nullptr, assembly, {entity, kind}, mass, RawOf(first), {}, false});
  CreateBody(number, assemblies_.back().world->World());
  ++assemblies_.back().end_body;
  if (entity >= assembly_of_.size()) assembly_of_.resize(entity + 1, kNoEntity);
  if (kind != EBody::kMirror) assembly_of_[entity] = assembly;
  if (kind == EBody::kObject) objects_.push_back(number);
  return number;
}

void OdeWorld::CreateBody(int number, dWorldID world)
{
  BodyRecord& record = RecordOf(number);
  const dBodyID body = dBodyCreate(world);
  if (record.owner.kind == EBody::kMirror)
    dBodySetKinematic(body);
  else
    dBodySetMass(body, &record.mass);
  dBodySetFiniteRotationMode(body, 0);  // the other mode calls sin(), which differs between processors
  dBodySetAutoDisableFlag(body, 0);
  dBodySetData(body, reinterpret_cast<void*>(static_cast<std::intptr_t>(number)));
  if (record.is_left_out || record.rest.asleep) dBodyDisable(body);
  SetRawPose(body, record.first);
  record.body = body;
}

int OdeWorld::AddHinge(int outer, int inner, const Vector3& anchor, const Vector3& axis, double torque)
{
  hinges_.push_back({.spec = {.outer = outer, .inner = inner, .anchor = anchor, .axis = axis, .effort = torque}});
  CreateHinge(hinges_.back());
  ++assemblies_.back().end_hinge;
  return static_cast<int>(hinges_.size()) - 1;
}

int OdeWorld::AddJoint(const JointSpec& spec)
{
  hinges_.push_back({.spec = spec, .has_stops = true, .of_motor = std::make_unique<dJointFeedback>()});
  *hinges_.back().of_motor = {};
  CreateHinge(hinges_.back());
  ++assemblies_.back().end_hinge;
  return static_cast<int>(hinges_.size()) - 1;
}

void OdeWorld::CreateHinge(HingeRecord& hinge) const
{
  const JointSpec& spec = hinge.spec;
  const dBodyID outer = Body(spec.outer), inner = Body(spec.inner);
  const dWorldID world = dBodyGetWorld(outer);
  const Vector3& axis = spec.axis;
  if (spec.slides)
  {
    hinge.joint = dJointCreateSlider(world, nullptr);
    dJointAttach(hinge.joint, outer, inner);
    dJointSetSliderAxis(hinge.joint, axis.x(), axis.y(), axis.z());
    dJointSetSliderParam(hinge.joint, dParamLoStop, spec.lowest);
    dJointSetSliderParam(hinge.joint, dParamHiStop, spec.highest);
  }
  else
  {
    hinge.joint = dJointCreateHinge(world, nullptr);
    dJointAttach(hinge.joint, outer, inner);
    dJointSetHingeAnchor(hinge.joint, spec.anchor.x(), spec.anchor.y(), spec.anchor.z());
    dJointSetHingeAxis(hinge.joint, axis.x(), axis.y(), axis.z());
    dJointSetHingeParam(hinge.joint, hinge.has_stops ? dParamLoStop : dParamFMax,
                        hinge.has_stops ? spec.lowest : spec.effort);
    if (hinge.has_stops) dJointSetHingeParam(hinge.joint, dParamHiStop, spec.highest);
  }
  if (!hinge.has_stops || !(spec.effort > 0)) return;
  constexpr int kWithOuter = 1;
  if (spec.slides)
  {
    hinge.motor = dJointCreateLMotor(world, nullptr);
    dJointAttach(hinge.motor, outer, inner);
    dJointSetLMotorNumAxes(hinge.motor, 1);
    dJointSetLMotorAxis(hinge.motor, 0, kWithOuter, axis.x(), axis.y(), axis.z());
    dJointSetLMotorParam(hinge.motor, dParamFMax, spec.effort);
  }
  else
  {
    hinge.motor = dJointCreateAMotor(world, nullptr);
    dJointAttach(hinge.motor, outer, inner);
    dJointSetAMotorNumAxes(hinge.motor, 1);
    dJointSetAMotorAxis(hinge.motor, 0, kWithOuter, axis.x(), axis.y(), axis.z());
    dJointSetAMotorParam(hinge.motor, dParamFMax, spec.effort);
  }
  dJointSetFeedback(hinge.motor, hinge.of_motor.get());
}

void OdeWorld::SetMotorSpeed(int number, double speed)
{
  const HingeRecord& hinge = hinges_[static_cast<std::size_t>(number)];
  if (hinge.motor == nullptr) return;
  if (hinge.spec.slides)
    dJointSetLMotorParam(hinge.motor, dParamVel, speed);
  else
    dJointSetAMotorParam(hinge.motor, dParamVel, speed);
}

double OdeWorld::MotorEffort(int number) const
{
  const HingeRecord& hinge = hinges_[static_cast<std::size_t>(number)];
  if (hinge.motor == nullptr) return 0;
  const Vector3 axis = VectorToWorld(Body(hinge.spec.outer), hinge.spec.axis);
  return axis.dot(VectorOf(hinge.spec.slides ? hinge.of_motor->f1 : hinge.of_motor->t1));
}

void OdeWorld::Move(std::uint32_t number, SolverWorld& to)
{
  Assembly& assembly = assemblies_[number];
  for (int k = assembly.first_hinge; k < assembly.end_hinge; ++k)
  {
    const HingeRecord& hinge = hinges_[static_cast<std::size_t>(k)];
    dJointDestroy(hinge.joint);
    if (hinge.motor != nullptr) dJointDestroy(hinge.motor);
  }
  for (int body = assembly.first_body; body < assembly.end_body; ++body)
  {
    RecordOf(body).before_move = Body(body);
    CreateBody(body, to.World());
  }
  for (int hinge = assembly.first_hinge; hinge < assembly.end_hinge; ++hinge)
    CreateHinge(hinges_[static_cast<std::size_t>(hinge)]);
  for (std::uint32_t solid = assembly.first_solid; solid < assembly.end_solid; ++solid) Attach(*solids_[solid]);
  for (int body = assembly.first_body; body < assembly.end_body; ++body)
  {
    const dBodyID before = RecordOf(body).before_move;
    SetRawPose(Body(body), RawPoseOf(before));
    const dReal* linear = dBodyGetLinearVel(before);
    const dReal* angular = dBodyGetAngularVel(before);
    dBodySetLinearVel(Body(body), linear[0], linear[1], linear[2]);
    dBodySetAngularVel(Body(body), angular[0], angular[1], angular[2]);
    dBodyDestroy(before);
  }
  assembly.world = &to;
}

void OdeWorld::SetMembersOfHomes()
{
  std::vector<std::uint32_t> members;
  for (std::size_t home = 0; home < homes_.size(); ++home)
  {
    members.clear();
    const std::size_t end = std::min(assemblies_.size(), (home + 1) * kHomeSize);
    for (std::size_t assembly = home * kHomeSize; assembly < end; ++assembly)
      if (assemblies_[assembly].world == homes_[home].get()) members.push_back(static_cast<std::uint32_t>(assembly));
    if (!std::ranges::equal(members, homes_[home]->Members())) homes_[home]->SetMembers(members);
  }
}

void OdeWorld::SaveBodies(std::uint32_t number, ByteWriter& state) const
{
  const Assembly& assembly = assemblies_[number];
  for (int body = assembly.first_body; body < assembly.end_body; ++body)
  {
    const BodyRecord& record = RecordOf(body);
    SaveMotion(record.body, state);
    state.Put(record.is_left_out);
    if (record.owner.kind == EBody::kObject) SaveRest(record.rest, state);
  }
}

void OdeWorld::LoadBodies(std::uint32_t number, ByteReader& state)
{
  const Assembly& assembly = assemblies_[number];
  for (int body = assembly.first_body; body < assembly.end_body; ++body)
  {
    LoadMotion(Body(body), state);
    BodyRecord& record = RecordOf(body);
    record.is_left_out = state.Get<std::uint8_t>() != 0;
    SetRest(body, record.owner.kind == EBody::kObject ? LoadRest(state) : record.rest);
  }
}

void OdeWorld::SetLeftOut(int body, bool left_out)
{
  BodyRecord& record = RecordOf(body);
  if (record.is_left_out == left_out) return;
  record.is_left_out = left_out;
  if (left_out || record.rest.asleep)
    dBodyDisable(record.body);
  else
    dBodyEnable(record.body);
}

void OdeWorld::BeginEntity(std::uint32_t entity, const Touch& touch)
{
  current_entity_ = entity;
  current_touch_ = touch;
}

void OdeWorld::AddSolid(dGeomID geom, int body, ELayer layer, ESurface surface, const Pose& offset_in_body)
{
  auto solid = std::make_unique<Solid>();
  solid->geom = geom;
  solid->body = body;
  solid->offset_in_body = offset_in_body;
  solid->number = static_cast<std::uint32_t>(solids_.size());
  solid->entity = current_entity_;
  solid->surface = surface;
  solid->layer = layer;
  solid->touch = current_touch_;
  dGeomSetData(geom, solid.get());
  if (body >= 0)
  {
    Assembly& assembly = assemblies_.back();
    if (assembly.geoms == nullptr)
    {
      assembly.geoms = dSimpleSpaceCreate(nullptr);
      assembly.first_solid = solid->number;
    }
    assembly.end_solid = solid->number + 1;
    dSpaceAdd(assembly.geoms, geom);
    Attach(*solid);
  }
  else
  {
    solid->box = BoxAround(geom);
    const bool is_ground = dGeomGetClass(geom) == dPlaneClass || surface == ESurface::kTerrain;
    (is_ground ? grounds_ : statics_).push_back(solid.get());
  }
  // The width of a hull follows with its shape.
  solids_.push_back(std::move(solid));
  if (dGeomGetClass(geom) != dConvexClass) SetWidth(*solids_.back());
}

void OdeWorld::SetWidth(Solid& solid)
{
  solid.least_width = LeastWidth(solid);
  if (solid.body < 0 || solid.layer == ELayer::kWheel) return;
  Assembly& assembly = assemblies_[RecordOf(solid.body).assembly];
  assembly.least_width = std::min(assembly.least_width, solid.least_width);
}

void OdeWorld::Attach(const Solid& solid) const
{
  dGeomSetBody(solid.geom, Body(solid.body));
  const Vector3& p = solid.offset_in_body.position;
  const Quaternion& q = solid.offset_in_body.orientation;
  if (!p.isZero(0)) dGeomSetOffsetPosition(solid.geom, p.x(), p.y(), p.z());
  if (q.vec().isZero(0)) return;
  const dQuaternion raw = {q.w(), q.x(), q.y(), q.z()};
  dGeomSetOffsetQuaternion(solid.geom, raw);
}

void OdeWorld::KeepShape(std::shared_ptr<const HullShape> shape)
{
  if (shape == nullptr) return;
  Solid& solid = *solids_.back();
  solid.shape = std::move(shape);
  SetWidth(solid);
}

void OdeWorld::SetRest(int body, const Rest& rest)
{
  BodyRecord& record = RecordOf(body);
  record.rest = rest;
  if (rest.asleep || record.is_left_out)
    dBodyDisable(record.body);
  else
    dBodyEnable(record.body);
}

bool OdeWorld::Wake(int body)
{
  BodyRecord& record = RecordOf(body);
  if (!record.rest.asleep) return false;
  SetRest(body, {RawPoseOf(record.body), 0, false});
  return true;
}

void OdeWorld::WakeAll()
{
  for (const int object : objects_) Wake(object);
}

std::size_t OdeWorld::SleeperCount() const
{
  return static_cast<std::size_t>(
      std::ranges::count_if(bodies_, [](const BodyRecord& body) { return body.rest.asleep; }));
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
    if (solid->body >= 0) continue;
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

void SaveMotion(dBodyID body, ByteWriter& state)
{
  state.Put(RawPoseOf(body));
  for (const dReal* velocity : {dBodyGetLinearVel(body), dBodyGetAngularVel(body)})
    for (int k = 0; k < 3; ++k) state.Put(velocity[k]);
}

void LoadMotion(dBodyID body, ByteReader& state)
{
  SetRawPose(body, state.Get<RawPose>());
  double velocity[6];
  for (double& value : velocity) value = state.Get<double>();
  dBodySetLinearVel(body, velocity[0], velocity[1], velocity[2]);
  dBodySetAngularVel(body, velocity[3], velocity[4], velocity[5]);
}

void SaveRest(const Rest& rest, ByteWriter& state)
{
  state.Put(rest.reference);
  state.Put(rest.steps);
  state.Put(rest.asleep);
}

Rest LoadRest(ByteReader& state)
{
  Rest rest;
  rest.reference = state.Get<RawPose>();
  rest.steps = state.Get<std::uint32_t>();
  rest.asleep = state.Get<bool>();
  return rest;
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

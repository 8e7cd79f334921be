// OdeWorld: one ODE world and its collision space, stepped so that equal states give equal next states whatever came
// before: contacts are made in the order of the solids' numbers and poses are restored bit by bit. What hangs together
// with an object is solved with more iterations, each such island by itself; objects at rest sleep until something that
// is awake touches them. Owned by the engine, used by one thread at a time; several worlds may be stepped by several
// threads.
#pragma once

#include <ode/ode.h>

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "common/math/pose.h"
#include "engine_worker/engines/dynamics3d/collide.h"
#include "engine_worker/engines/dynamics3d/islands.h"

namespace swarmanoid::dynamics3d
{

inline constexpr std::uint32_t kNoEntity = std::numeric_limits<std::uint32_t>::max();

inline constexpr int kMaximumContacts = 8;        // of one pair of solids
inline constexpr int kMaximumVoxelContacts = 32;  // of one solid with all voxels
// A wheel's contact normal stands at most this far out of the wheel's plane: sine of the angle. Half width 1 cm.
inline constexpr double kWheelFlank = 0.35;

enum class ESurface : std::uint8_t
{
  kPlain,
  kWheel,   // a sphere that stands for a wheel about the y axis of its body: its flanks touch nothing
  kCaster,  // frictionless, with a spring and a damper
  kGround,  // the ground plane: open where there are holes
  kTerrain  // ground too
};

// Friction and restitution of an entity. Values that are not set are those of the world.
struct Touch
{
  std::optional<double> friction;         // with others: the geometric mean of both
  std::optional<double> restitution;      // the larger one of both
  std::optional<double> ground_friction;  // on ground and terrain
  double caster_stiffness = 0;            // N/m
};

// The layers decide which bodies can collide. Static solids, mirrors included, never collide with each other. Wheels do
// not collide with other robots, since a wheel lies within the outline of its chassis.
enum class ELayer : std::uint8_t
{
  kStatic,
  kRobot,
  kObject,
  kWheel,
  kVoxels
};

// The properties of a geom that contacts need. Solids are numbered in the order of creation.
struct Solid
{
  dGeomID geom = nullptr;
  std::uint32_t number = 0;
  std::uint32_t entity = kNoEntity;
  ESurface surface = ESurface::kPlain;
  ELayer layer = ELayer::kStatic;
  Touch touch;
  std::shared_ptr<const HullShape> shape;  // of a hull
};

// The bits of a body's position and quaternion (w x y z), as ODE holds them.
struct RawPose
{
  double position[3] = {0, 0, 0};
  double quaternion[4] = {1, 0, 0, 0};

  bool operator==(const RawPose&) const = default;
};

enum class EBody : std::uint8_t
{
  kRobot,
  kObject,  // has no drive: sleeps when at rest. One body an entity
  kMirror   // follows only what it is told
};

struct BodyOwner
{
  std::uint32_t entity = kNoEntity;
  EBody kind = EBody::kRobot;
};

// Whether an object rests. Part of the state.
struct Rest
{
  RawPose reference;        // where it was when it last moved
  std::uint32_t steps = 0;  // since then
  bool asleep = false;
};

struct WorldSettings
{
  Vector3 gravity = Vector3(0, 0, -9.81);  // m/s², in the frame of the engine
  int iterations = 8;
  int object_iterations = 50;  // of islands with objects, if that is more
  double friction = 0.5;
  double wheel_friction = 1.0;
  double restitution = 0;
};

class OdeWorld
{
public:
  explicit OdeWorld(const WorldSettings& settings);
  ~OdeWorld();
  OdeWorld(const OdeWorld&) = delete;
  OdeWorld& operator=(const OdeWorld&) = delete;

  dWorldID World() const { return world_; }
  const WorldSettings& Settings() const { return settings_; }

  // Adds a body of that mass distribution, with its centre of mass at the origin, and returns its number, from 0 on.
  // Mirrors need no mass.
  int AddBody(const BodyOwner& owner, const dMass& mass);
  std::size_t BodyCount() const { return bodies_.size(); }
  dBodyID Body(int number) const { return bodies_[static_cast<std::size_t>(number)].body; }
  static int NumberOf(dBodyID body) { return static_cast<int>(reinterpret_cast<std::intptr_t>(dBodyGetData(body))); }

  // A body that is left out is neither moved nor met, but found by FindTouching. For all bodies of an entity alike.
  void SetLeftOut(int body, bool left_out);
  // The box around all solids of an entity that has bodies: least and largest x, y and z.
  std::array<double, 6> BoxOf(int body) const;

  // Begins the solids of one entity. Solids of one entity never collide with each other.
  void BeginEntity(std::uint32_t entity, const Touch& touch = {});
  // Takes over a geom made with no space. body -1: it stands where it is.
  void AddSolid(dGeomID geom, int body, ELayer layer, ESurface surface = ESurface::kPlain,
                const Pose& offset_in_body = {});
  // Keeps the shape from which the geom of the last solid was made.
  void KeepShape(std::shared_ptr<const HullShape> shape) { solids_.back()->shape = std::move(shape); }
  std::span<const std::unique_ptr<Solid>> Solids() const { return solids_; }

  // Two entities that are not to collide (one holds the other); counted, so that both calls nest.
  void Ignore(std::uint32_t a, std::uint32_t b);
  void Respect(std::uint32_t a, std::uint32_t b);

  // Says where the ground plane is open (frame of the engine).
  void SetOpenings(std::function<bool(const Vector3&)> is_open) { is_open_ = std::move(is_open); }

  // One step of `seconds`. `number`: of the step since the start of the experiment; it decides the order of
  // constraints.
  void Step(double seconds, std::uint64_t number);
  int ContactCount() const { return static_cast<int>(contacts_.size()); }

  std::span<const int> Objects() const { return objects_; }  // numbers of bodies
  const Rest& RestOf(int body) const { return bodies_[static_cast<std::size_t>(body)].rest; }
  void SetRest(int body, const Rest& rest);
  // Wakes all objects, since the support of a sleeping one may be gone.
  void WakeAll();
  std::size_t SleeperCount() const;

  // Returns the solid (of another entity, accepted by the filter) that reaches deepest into a sphere; nullptr for none.
  const Solid* FindTouching(const Vector3& centre, double radius, std::uint32_t but_not,
                            const std::function<bool(const Solid&)>& accept) const;
  // Distance to the first static solid along a unit vector; infinity for none within `range`.
  double DistanceToStatic(const Vector3& origin, const Vector3& direction, double range) const;

private:
  struct Pair
  {
    std::uint32_t a;
    std::uint32_t b;
    bool done;
  };
  struct Contact
  {
    dContact joint;
    int body_a;  // -1: none
    int body_b;
    std::uint32_t pair;
  };
  struct Member  // of an island
  {
    std::uint32_t island;
    std::uint32_t number;
  };
  struct BodyRecord
  {
    dBodyID body;
    BodyOwner owner;
    Rest rest;
    bool is_left_out = false;
  };
  struct IgnoredPair
  {
    std::uint32_t low;
    std::uint32_t high;
    int count;
  };

  BodyRecord& RecordOf(int body) { return bodies_[static_cast<std::size_t>(body)]; }
  std::uint32_t EntityOf(int body) const { return bodies_[static_cast<std::size_t>(body)].owner.entity; }
  bool IsObject(int body) const { return bodies_[static_cast<std::size_t>(body)].owner.kind == EBody::kObject; }
  static void NearCallback(void* world, dGeomID first, dGeomID second);
  void CollectPair(const Solid& first, const Solid& second);
  bool IsIgnored(std::uint32_t a, std::uint32_t b) const;
  void MakeContacts(const Solid& a, const Solid& b, std::uint32_t pair);
  bool Accept(const dContactGeom& contact, const Solid& a, const Solid& b) const;
  void AddContact(const dContactGeom& geometry, const Solid& a, const Solid& b, std::uint32_t pair);
  void FindContacts();
  void FindObjectIslands();
  void Attach(const Contact& contact);
  int ObjectIterations(int objects) const;
  void Solve(double seconds, int iterations, std::uint64_t number);
  void SolveOthers(double seconds, std::uint64_t number);
  void SolveObjectIslands(double seconds, std::uint64_t number);
  void RestObjects(double seconds);
  bool IsAwake(const Solid& solid) const;
  void PutToSleep(int body);
  bool Wake(std::uint32_t entity);

  WorldSettings settings_;
  dWorldID world_ = nullptr;
  dSpaceID space_ = nullptr;
  dSpaceID current_set_ = nullptr;
  Touch current_touch_;
  std::uint32_t current_entity_ = kNoEntity;
  dJointGroupID contact_joints_ = nullptr;
  dThreadingImplementationID threading_ = nullptr;
  dGeomID probe_ = nullptr;
  std::vector<BodyRecord> bodies_;
  std::vector<int> objects_;    // bodies
  std::vector<int> object_of_;  // by entity with a body; -1: not an object
  std::size_t left_out_count_ = 0;
  std::vector<std::unique_ptr<Solid>> solids_;
  std::vector<Pair> pairs_;
  std::vector<IgnoredPair> ignored_;
  std::function<bool(const Vector3&)> is_open_;
  double step_seconds_ = 0;
  // Values of the last step.
  std::vector<Contact> contacts_;
  Islands islands_;
  std::vector<bool> has_object_;         // by island
  std::vector<Member> island_bodies_;    // of islands with objects
  std::vector<Member> island_contacts_;  // of islands with objects
  std::vector<bool> is_in_island_;       // by contact
};

// ODE's tables of the process and the thread.
void InitialiseOde();

// Poses, bit by bit; setting also recomputes the rotation matrix as a step of ODE does.
RawPose RawPoseOf(dBodyID body);
void SetRawPose(dBodyID body, const RawPose& pose);
Pose PoseOf(const RawPose& raw);
RawPose RawOf(const Pose& pose);

inline Vector3 VectorOf(const dReal* v) { return {v[0], v[1], v[2]}; }
Pose PoseOf(dBodyID body);
Vector3 PointVelocity(dBodyID body, const Vector3& point);
// These functions turn directions between the frame of a body and the frame of the engine.
Vector3 VectorToWorld(dBodyID body, const Vector3& v);
Vector3 VectorFromWorld(dBodyID body, const Vector3& v);
void Stop(dBodyID body);

}  // namespace swarmanoid::dynamics3d

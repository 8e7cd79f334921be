// OdeWorld: all bodies and solids of an engine. The bodies are in several worlds of ODE (solver_world.h) and can move
// from one to another, which changes no bit of their motion. Owned by the engine. Several threads may use bodies of
// different worlds at the same time.
#pragma once

#include <ode/ode.h>

#include <algorithm>
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
#include "common/serialisation/bytes.h"
#include "engine_worker/engines/dynamics3d/collide.h"

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

// Least and largest x, y and z.
using Box = std::array<double, 6>;

inline Box BoxAround(dGeomID geom)
{
  Box box;
  dGeomGetAABB(geom, box.data());
  return box;
}

inline Box Grown(Box box, double margin)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    box[2 * axis] -= margin;
    box[2 * axis + 1] += margin;
  }
  return box;
}

inline bool Overlap(const Box& a, const Box& b)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (a[2 * axis + 1] < b[2 * axis] || b[2 * axis + 1] < a[2 * axis]) return false;
  return true;
}

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
  kVoxels,
  kRobot,
  kObject,
  kWheel
};

constexpr bool CanMeet(ELayer a, ELayer b)
{
  const ELayer low = std::min(a, b), high = std::max(a, b);
  if (high <= ELayer::kVoxels) return false;
  return high != ELayer::kWheel || (low != ELayer::kRobot && low != ELayer::kWheel);
}

// The properties of a geom that contacts need. Solids are numbered in the order of creation.
struct Solid
{
  dGeomID geom = nullptr;
  int body = -1;  // -1: it never moves
  Pose offset_in_body;
  std::uint32_t number = 0;
  std::uint32_t entity = kNoEntity;
  ESurface surface = ESurface::kPlain;
  ELayer layer = ELayer::kStatic;
  Touch touch;
  std::shared_ptr<const HullShape> shape;  // of a hull
  std::function<dGeomID()> make_copy;      // for a world, if threads cannot share the geom
  Box box = {};                            // if it never moves
  double least_width = 0;                  // m; of a cell for cells of a map, infinite for planes
};

// Returns the least width (m) of a solid in any direction.
double LeastWidth(const Solid& solid);

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
  kMechanism,  // of a robot whose joints bear its own limbs: few iterations would leave them soft
  kObject,     // has no drive: sleeps when at rest. One body an entity
  kMirror      // follows only what it is told
};

struct BodyOwner
{
  std::uint32_t entity = kNoEntity;
  EBody kind = EBody::kRobot;
};

// Whether an object rests; a part of the state. An object sleeps after it stayed near `reference` for long enough.
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
  int object_iterations = 50;  // of delicate islands, if that is more
  double friction = 0.5;
  double wheel_friction = 1.0;
  double restitution = 0;
};

class SolverWorld;

// A joint between two bodies of one assembly, at their first poses: the outer one turns about the axis or slides along
// it.
struct JointSpec
{
  int outer = 0, inner = 0;
  Vector3 anchor = Vector3::Zero(), axis = Vector3::UnitX();
  bool slides = false;
  double lowest = -std::numeric_limits<double>::infinity();  // rad, within half a turn, or m
  double highest = std::numeric_limits<double>::infinity();
  double effort = 0;  // N m or N, the most of the motor
};

struct BodyRecord
{
  dBodyID body = nullptr;
  std::uint32_t assembly = 0;
  BodyOwner owner;
  dMass mass;
  RawPose first;  // where it was when hinges were attached
  Rest rest;
  bool is_left_out = false;
  dBodyID before_move = nullptr;
};

// The bodies of one model, the hinges between them, and its solids. Each are numbered in a row.
struct Assembly
{
  std::uint32_t entity = kNoEntity;
  int first_body = 0, end_body = 0;
  int first_hinge = 0, end_hinge = 0;
  std::uint32_t first_solid = 0, end_solid = 0;
  double least_width = std::numeric_limits<double>::infinity();  // m, of the solids but wheels
  dSpaceID geoms = nullptr;
  SolverWorld* world = nullptr;  // of its bodies
  std::uint32_t position = 0;    // among the members of this world
};

class OdeWorld
{
public:
  explicit OdeWorld(const WorldSettings& settings);
  ~OdeWorld();
  OdeWorld(const OdeWorld&) = delete;
  OdeWorld& operator=(const OdeWorld&) = delete;

  const WorldSettings& Settings() const { return settings_; }

  // Begins the bodies of one model and returns their assembly, numbered from 0 on.
  std::uint32_t BeginAssembly(std::uint32_t entity);
  std::span<const Assembly> Assemblies() const { return assemblies_; }
  Assembly& AssemblyAt(std::uint32_t assembly) { return assemblies_[assembly]; }
  const Assembly& AssemblyOf(int body) const { return assemblies_[RecordOf(body).assembly]; }

  // Adds a body of that mass distribution, with its centre of mass at the origin, and returns its number, from 0 on.
  // Mirrors need no mass.
  int AddBody(EBody kind, const dMass& mass, const Pose& first);
  std::size_t BodyCount() const { return bodies_.size(); }
  // ODE's body is another one after each move to another world.
  dBodyID Body(int number) const { return bodies_[static_cast<std::size_t>(number)].body; }
  static int NumberOf(dBodyID body) { return static_cast<int>(reinterpret_cast<std::intptr_t>(dBodyGetData(body))); }
  BodyRecord& RecordOf(int body) { return bodies_[static_cast<std::size_t>(body)]; }
  const BodyRecord& RecordOf(int body) const { return bodies_[static_cast<std::size_t>(body)]; }

  // Adds a hinge between two bodies of the assembly, at their first poses, with a motor of that torque (N m). Returns
  // its number.
  int AddHinge(int outer, int inner, const Vector3& anchor, const Vector3& axis, double torque = 0);
  // Adds a joint with stops as a further hinge. Its motor is a joint of its own, so that the solver knows the limits of
  // both: a motor of ODE's hinge that leaves a stop would jump.
  int AddJoint(const JointSpec& spec);
  dJointID Hinge(int number) const { return hinges_[static_cast<std::size_t>(number)].joint; }
  // Sets the speed (rad/s or m/s) of the motor of a joint with stops. Does nothing if it has none.
  void SetMotorSpeed(int number, double speed);
  // Returns the torque (N m) or force (N) of that motor on the outer body in the last step.
  double MotorEffort(int number) const;

  // Moves the bodies of an assembly, hinges and geoms included, to another world, or again into the same one. Joints of
  // links are lost. The bodies of a world are solved in the order in which they came.
  void Move(std::uint32_t assembly, SolverWorld& to);
  // The worlds of assemblies that can meet no other one.
  static std::size_t HomeNumberOf(std::uint32_t assembly) { return assembly / kHomeSize; }
  SolverWorld& HomeOf(std::uint32_t assembly) { return *homes_[HomeNumberOf(assembly)]; }
  void SetMembersOfHomes();
  std::span<const std::unique_ptr<SolverWorld>> Homes() const { return homes_; }

  // Save and restore the bodies of an assembly bit by bit: motion, rest, and which are left out.
  void SaveBodies(std::uint32_t assembly, ByteWriter& state) const;
  void LoadBodies(std::uint32_t assembly, ByteReader& state);

  // A body that is left out is neither moved nor met, but found by FindTouching. For all bodies of an assembly alike.
  void SetLeftOut(int body, bool left_out);
  bool IsLeftOut(const Assembly& assembly) const { return RecordOf(assembly.first_body).is_left_out; }
  // The box around all solids of the assembly of a body.
  Box BoxOf(int body) const { return BoxAround(reinterpret_cast<dGeomID>(AssemblyOf(body).geoms)); }

  // Begins the solids of one entity. Solids of one entity never collide with each other.
  void BeginEntity(std::uint32_t entity, const Touch& touch = {});
  // Takes over a geom made with no space. body -1: it stands where it is.
  void AddSolid(dGeomID geom, int body, ELayer layer, ESurface surface = ESurface::kPlain,
                const Pose& offset_in_body = {});
  // Keeps the shape from which the geom of the last solid was made.
  void KeepShape(std::shared_ptr<const HullShape> shape);
  // Threads cannot share the geom of the last solid: each world makes a copy.
  void CopyForWorlds(std::function<dGeomID()> make_copy) { solids_.back()->make_copy = std::move(make_copy); }
  std::span<const std::unique_ptr<Solid>> Solids() const { return solids_; }
  // The solids that never move: those with bounds, and planes and terrain.
  std::span<const Solid* const> Statics() const { return statics_; }
  std::span<const Solid* const> Grounds() const { return grounds_; }

  // Two entities that are not to collide (one holds the other); counted, so that both calls nest.
  struct IgnoredPair
  {
    std::uint32_t low;
    std::uint32_t high;
    int count;
  };
  void Ignore(std::uint32_t a, std::uint32_t b);
  void Respect(std::uint32_t a, std::uint32_t b);
  std::span<const IgnoredPair> IgnoredPairs() const { return ignored_; }
  // Returns whether this engine can move the entity, and its assembly if so.
  bool IsMovable(std::uint32_t entity) const
  {
    return entity < assembly_of_.size() && assembly_of_[entity] != kNoEntity;
  }
  std::uint32_t AssemblyOfEntity(std::uint32_t entity) const { return assembly_of_[entity]; }

  // Says where the ground plane is open (frame of the engine).
  void SetOpenings(std::function<bool(const Vector3&)> is_open) { is_open_ = std::move(is_open); }
  bool IsOpen(const Vector3& point) const { return is_open_ && is_open_(point); }

  std::span<const int> Objects() const { return objects_; }  // numbers of bodies
  const Rest& RestOf(int body) const { return RecordOf(body).rest; }
  void SetRest(int body, const Rest& rest);
  // Wakes the body if it is an object that sleeps. Returns false if it does not.
  bool Wake(int body);
  // Wakes all objects, since the support of a sleeping one may be gone.
  void WakeAll();
  std::size_t SleeperCount() const;

  // Returns the solid (of another entity, accepted by the filter) that reaches deepest into a sphere; nullptr for none.
  const Solid* FindTouching(const Vector3& centre, double radius, std::uint32_t but_not,
                            const std::function<bool(const Solid&)>& accept) const;
  // Returns the distance (m) to the first static solid along a unit vector, or infinity if none is within `range`.
  double DistanceToStatic(const Vector3& origin, const Vector3& direction, double range) const;

private:
  static constexpr std::size_t kHomeSize = 16;  // assemblies

  struct HingeRecord
  {
    JointSpec spec;
    bool has_stops = false;
    dJointID joint = nullptr;
    dJointID motor = nullptr;  // of its own
    std::unique_ptr<dJointFeedback> of_motor{};
  };

  void CreateBody(int body, dWorldID world);
  void CreateHinge(HingeRecord& hinge) const;
  void Attach(const Solid& solid) const;
  void SetWidth(Solid& solid);

  WorldSettings settings_;
  Touch current_touch_;
  std::uint32_t current_entity_ = kNoEntity;
  dGeomID probe_ = nullptr;
  std::vector<Assembly> assemblies_;
  std::vector<BodyRecord> bodies_;
  std::vector<HingeRecord> hinges_;
  std::vector<int> objects_;                // bodies
  std::vector<std::uint32_t> assembly_of_;  // by entity; kNoEntity: only a mirror
  std::vector<std::unique_ptr<Solid>> solids_;
  std::vector<const Solid*> statics_, grounds_;
  std::vector<IgnoredPair> ignored_;
  std::function<bool(const Vector3&)> is_open_;
  std::vector<std::unique_ptr<SolverWorld>> homes_;
};

// Makes ODE's tables of the process and of the calling thread, if they do not exist.
void InitialiseOde();

// Poses are read and written bit by bit. Setting one also recomputes the rotation matrix as a step of ODE does.
RawPose RawPoseOf(dBodyID body);
void SetRawPose(dBodyID body, const RawPose& pose);
// Save and restore pose and velocities.
void SaveMotion(dBodyID body, ByteWriter& state);
void LoadMotion(dBodyID body, ByteReader& state);
void SaveRest(const Rest& rest, ByteWriter& state);
Rest LoadRest(ByteReader& state);
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

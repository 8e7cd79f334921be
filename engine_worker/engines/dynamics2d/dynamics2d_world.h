// Dynamics2dWorld: rigid bodies on a plane, solved by Box2D. Metres, kilograms, newtons and radians outside; inside one
// unit is a decimetre, so that Box2D's tolerances, made for things of a metre, fit robots. Each contact group, the
// bodies that can touch each other within a tick, has a world of Box2D of its own. Isolated bodies, which meet no other
// one within a tick, are not in Box2D: they move as its solver moves them without contacts. Regions of a split engine
// can have the worlds of groups (remote_groups.h).
#pragma once

#include <box2d/box2d.h>

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "common/messages/regions.h"
#include "common/plugin_descriptions/robot_parts.h"
#include "common/serialisation/bytes.h"
#include "common/threads/worker_pool.h"
#include "engine_worker/engines/dynamics2d/group_world.h"
#include "engine_worker/engines/plane_frame.h"
#include "engine_worker/engines/rigid_bodies/contact_groups.h"

namespace swarmanoid::dynamics2d
{

enum class EMotion
{
  kDynamic,
  kKinematic,  // goes where it is told, pushes and is not pushed
  kStatic
};

// The properties of a body, fixed once it is in the world.
struct BodyModel
{
  EMotion motion = EMotion::kDynamic;
  double radius = 0;             // m; 0: the outline is `polygon`
  std::vector<Vector2> polygon;  // m, in the frame of the body, convex, 3 to 8 vertices
  double mass = 1;               // kg
  double inertia = 1;            // kg m2 about the origin of the body, which is its centre of mass
  double friction = 0;           // of contacts: two bodies use the geometric mean
  double restitution = 0;        // of contacts: two bodies use the larger one
  double ground_force = 0;       // N: what wheels, propellers or friction exert against the ground at most
  double ground_torque = 0;      // N m
  bool lies = false;             // on the ground, by friction alone: sliding takes from what resists turning
  bool has_gripper = false;      // a square at the front of a turret at the origin
  bool has_turret_motor = false;
  bool grips_by_rod = false;  // the square stops no body, and a grip without a motor leaves both ends free to turn
  bool grippable = false;
};

// A velocity in the frame of a body.
struct Twist
{
  double forward = 0;  // m/s
  double left = 0;     // m/s
  double turn = 0;     // rad/s
};

// A velocity in the plane.
struct PlaneVelocity
{
  double u = 0;     // m/s
  double v = 0;     // m/s
  double turn = 0;  // rad/s
};

struct WorldSettings
{
  int velocity_iterations = 8;
  int position_iterations = 3;
  double turret_torque = 0;  // N m, of the motor that turns a gripping turret
  double grip_distance = 0;  // m, from the face of the gripper to what it can take
};

// The load of the gripped body on a turret, in the frame of the turret.
struct TurretLoad
{
  double force_x = 0;  // N
  double force_y = 0;  // N
  double torque = 0;   // N m
};

// It holds the sums that the sensors of a robot make over the steps of a tick.
struct TickMeasures
{
  double left_arc = 0, right_arc = 0;  // m, of wheels without slip against the ground
  TurretLoad load;                     // mean
};

// The square of the gripper: its edge, and how far its outer face stands from the axis of the turret (m).
inline constexpr double kGripperSide = GripperSquare::kSide;
inline constexpr double kGripperReach = GripperSquare::kReach;
// How far from its front a gripper of the model rod takes bodies (m): the circle of dynamics2d_footbot_model.cpp of
// ARGoS3.
inline constexpr double kRodGripDistance = 0.01;
inline constexpr int kNoBody = -1;
// Box2D's units.
inline constexpr double kUnitsPerMetre = 10;
inline constexpr double kForceUnits = kUnitsPerMetre;                    // per newton
inline constexpr double kTorqueUnits = kUnitsPerMetre * kUnitsPerMetre;  // per newton metre
// The part of a ground joint's position error that becomes velocity. Drives are expressed through it; a small value
// puts the target far ahead, where the rounding of large coordinates does not matter.
inline constexpr float kDriveGain = 0.001F;
inline b2Vec2 ToUnits(double x, double y)
{
  return {static_cast<float>(x * kUnitsPerMetre), static_cast<float>(y * kUnitsPerMetre)};
}

class GroupReplica;
class RemoteGroups;
enum class EGroupOrder : std::uint8_t;

class Dynamics2dWorld
{
  friend GroupReplica;

public:
  explicit Dynamics2dWorld(const WorldSettings& settings);
  ~Dynamics2dWorld();

  // Bodies are numbered from 0 in the order in which they come. None can be added after Build.
  int AddBody(BodyModel model, const PlanePose& pose);
  void Build();
  // The threads of a pool solve the groups, or `threads` of a pool of the world's own if `pool` is nullptr. Their
  // number changes no bit.
  void UseThreads(unsigned threads, WorkerPool* pool);
  // The regions of `team`, which outlives the world, solve the groups, each with that many threads. That changes no bit
  // either.
  void UseRegions(RegionTeam& team, unsigned threads);

  // Calls act(i) for each i below `count`, in all threads that share the work. `act` writes only what belongs to i.
  template <class Act>
  void ForEach(std::size_t count, const Act& act) const
  {
    constexpr std::size_t kLeast = 256;  // with fewer bodies, waking threads takes longer
    WorkerPool* const pool = count < kLeast ? nullptr : IfItShares(pool_);
    const std::size_t threads = pool == nullptr ? 1 : pool->Threads();
    const auto part = [&](unsigned k)
    {
      for (std::size_t i = count * k / threads; i < count * (k + 1) / threads; ++i) act(i);
    };
    if (pool == nullptr) return part(0);
    pool->Run(part);
  }

  // Begins a tick of `seconds` and finds the groups. Bodies must not be placed or driven before it ends.
  void BeginTick(double seconds);
  // Makes the tick in equal steps.
  void Advance(int steps);
  // The number of groups in this tick.
  std::size_t GroupCount() const { return groups_.Count(); }
  // The number of bodies that are isolated in this tick.
  std::size_t IsolatedCount() const { return isolated_.size(); }

  PlanePose PoseOf(int body) const;
  PlaneVelocity VelocityOf(int body) const;
  // Sets the pose of a body. Its grips stay, so the caller must also place the bodies that it grips or that grip it.
  void Place(int body, const PlanePose& pose);
  void SetVelocity(int body, const PlaneVelocity& velocity);
  // Another polygon for a body that has one; the old one stays if no corner is farther off than `tolerance` (m).
  void SetOutline(int body, const std::vector<Vector2>& polygon, double tolerance);
  const std::vector<Vector2>& OutlineOf(int body) const { return bodies_[Index(body)].model.polygon; }
  // Takes a body out of all collisions, or puts it back.
  void SetSolid(int body, bool solid);
  // Says whether grippers can take a body.
  void SetGrippable(int body, bool grippable) { bodies_[Index(body)].model.grippable = grippable; }

  // Sets the velocity that a body strives for against the ground, within its ground_force and ground_torque.
  void SetDrive(int body, const Twist& drive) { bodies_[Index(body)].drive = drive; }
  // Turns the gripper of a body that grips nothing to an angle against it, radians.
  void SetTurretAngle(int body, double radians);
  void SetTurretSpeed(int body, double radians_per_second) { bodies_[Index(body)].turret_speed = radians_per_second; }
  double TurretAngleOf(int body) const;  // -pi..pi

  // The nearest body that the gripper touches and may take, or kNoBody. A structure must not become a loop.
  int FindGrippable(int body) const;
  void Grip(int body, int target);
  // Returns true if a grip of this body on the target would make a loop.
  bool WouldClose(int body, int target) const { return LeadsTo(target, body); }
  void Release(int body);
  // Ends the grips of a body, and those on it, for which `ends(body, gripped)` returns true.
  template <class Ends>
  void ReleaseIf(int body, const Ends& ends)
  {
    if (GrippedBy(body) != kNoBody && ends(body, GrippedBy(body))) Release(body);
    for (int other = 0; other < static_cast<int>(bodies_.size()); ++other)
      if (GrippedBy(other) == body && ends(other, body)) Release(other);
  }
  int GrippedBy(int body) const { return bodies_[Index(body)].gripped; }

  // Has Advance measure the ways of two wheels at this distance (m) from the origin of a body.
  void MeasureWheels(int body, double half_axle) { bodies_[Index(body)].half_axle = half_axle; }
  // Has Advance measure the loads of all turrets.
  void MeasureLoads() { measures_loads_ = true; }
  const TickMeasures& MeasuresOf(int body) const { return bodies_[Index(body)].measures; }

  int ContactCount() const;
  int GripCount() const;

  // The state as bits that Box2D holds; it keeps caches beside them, which Rebuild drops.
  void SaveState(ByteWriter& state) const;
  void LoadState(ByteReader& state);
  void Rebuild();
  // Makes the world again with the bodies as they are. Angles, which grow with each turn, stay.
  void BeginAgain();

private:
  struct BodyState
  {
    float x, y, angle;  // decimetres, radians
    float vx, vy, turn;
  };
  struct GripState
  {
    b2Vec2 anchor;          // the axis of the turret, in the frame of the gripped body
    float reference_angle;  // of the gripped body against the gripping one where the joint's angle is 0
  };
  struct Command
  {
    Twist drive;
    double turret_speed;
  };
  struct Body
  {
    BodyModel model;
    BodyState start{};  // while it is not in Box2D here; of a static body always
    // The part of the position (decimetres) that Box2D's single precision cannot hold. Without it each step would lose
    // or gain some of its way.
    double remainder_x = 0;
    double remainder_y = 0;
    bool solid = true;
    double half_axle = 0;  // m; 0: the wheels are not measured
    TickMeasures measures;
    Twist drive;
    double turret_speed = 0;
    double turret_angle = 0;           // while nothing is gripped; otherwise the joint's
    std::optional<double> held_angle;  // that the motor of a gripping turret returns to
    int gripped = kNoBody;
    GripState grip{};
    std::uint32_t world = ContactGroups::kAlone;  // of worlds_, while its group has one
    bool is_joined = false;                       // there is a joint to the gripped body, in their world
    // The parts in Box2D. If a region has the world, these are nullptr, and `start` has the state after the last step.
    b2Body* b2 = nullptr;
    b2Fixture* gripper = nullptr;
    b2MotorJoint* ground = nullptr;
    b2Joint* joint = nullptr;
    Command ordered{};  // the commands that the region has
  };

  // A body when the tick began.
  struct TickStart
  {
    BodyState state;
    double remainder_x, remainder_y, turret_angle;
    std::optional<double> held_angle;
  };

  // The group that takes a world over, and how many of its bodies are there already.
  struct WorldClaim
  {
    std::uint32_t group, bodies;
  };

  static std::size_t Index(int body) { return static_cast<std::size_t>(body); }
  static BodyState StateOf(const Body& body);
  void ConfigureSeparation();
  void Outline(const Body& body, double seconds, MovingOutline& outline) const;

  // The groups of bodies (body_groups.cpp).
  void FindGroups();
  bool MergeGroups(double step_seconds, int steps);
  void LetGoOn(std::uint32_t moving, double seconds);
  void SearchGroups();
  void PlaceGroups();
  void AssignWorlds();
  void MoveToWorlds();
  void UpdateFixed();
  b2Body* BuildIn(GroupWorld& world, std::uint32_t number);
  void TakeOut(Body& body);
  static void LeaveOut(Body& body);
  void OpenWorlds();
  void SortGroups();
  void CloseWorld(std::uint32_t number);
  void CloseWorlds();
  GroupWorld& WorldOf(std::size_t group) { return *worlds_[world_of_group_[group]]; }

  // Groups that regions solve (remote_groups.cpp).
  bool IsRemote(const Body& body) const
  {
    return body.world != ContactGroups::kAlone && worlds_[body.world]->remote.has_value();
  }
  static ByteWriter& Order(GroupWorld& world, EGroupOrder order, std::uint32_t number);
  bool OrderChange(const Body& body, EGroupOrder order) const;
  void OrderBuild(GroupWorld& world, Body& body);
  void OrderSteps(std::size_t group, double seconds, int steps);
  void RunWithRegions(double seconds, int steps, const std::function<void()>& meanwhile);
  void TakeResult(std::size_t group, ByteReader& result);
  void PutMeasures(const Body& body, ByteWriter& result) const;
  void GetMeasures(Body& body, ByteReader& result) const;

  // The steps of a tick (dynamics2d_step.cpp).
  void KeepStarts();
  void ReturnToStart(std::size_t moving);
  void RunGroups(double seconds, int steps, std::span<const std::uint32_t> isolated);
  void RunHere(double seconds, int steps, std::span<const std::uint32_t> isolated);
  void RunGroup(GroupWorld& world, double seconds, int steps);
  void StepGroup(GroupWorld& world, double seconds, int steps);
  void AdvanceIsolated(Body& body, double seconds) const;
  void AddWheelWays(Body& body, const PlanePose& before);
  TurretLoad LoadOf(const Body& body, double last_step) const;
  bool IsTooFar(const Body& body, const GroupWorld::Way& way, double seconds) const;
  b2FixtureDef FixtureOf(std::uint32_t number) const;
  static b2PolygonShape ShapeOf(const std::vector<Vector2>& outline);
  void BuildGrip(Body& body);
  void EndGrip(Body& body);
  void TurnGripper(Body& body);
  void CountTurns(Body& body);
  void ApplyDrive(Body& body, double seconds);
  PlaneVelocity WantedVelocity(const Body& body, double seconds) const;
  // Parts (0 to 1) of the friction with the ground that resist sliding and turning.
  struct FrictionShares
  {
    double sliding;
    double turning;
  };
  static FrictionShares SharesOf(const BodyModel& model, const BodyState& state);
  void ApplyTurret(Body& body, double seconds, double last_step);
  void KeepRemainder(Body& body, const b2Vec2& before, double seconds) const;
  static void SetPosition(Body& body, double x, double y, float angle);
  bool LeadsTo(int from, int to) const;
  void WrapAngles();
  void SetPolygon(Body& body, const std::vector<Vector2>& polygon);
  static void PutMotion(const Body& body, ByteWriter& state);
  static void GetMotion(Body& body, ByteReader& state);
  static void PutGrip(const Body& body, ByteWriter& state);
  static void GetGrip(Body& body, ByteReader& state);

  WorldSettings settings_;
  std::vector<Body> bodies_;
  bool measures_loads_ = false;

  std::unique_ptr<WorkerPool> own_pool_;
  WorkerPool* pool_ = nullptr;  // nullptr for one thread

  SeparationTest separation_;
  bool separation_is_configured_ = false;
  double tick_ = 0;                       // seconds
  std::vector<std::uint32_t> moving_;     // bodies that are not static, ascending, as separation_ and groups_ have them
  std::vector<std::uint32_t> fixed_;      // static bodies, ascending, as separation_ and groups_ have them
  std::vector<std::uint32_t> in_moving_;  // of each body: its number in moving_
  std::vector<MovingOutline> outlines_;   // of moving_
  std::vector<GapPair> pairs_;
  std::vector<BodyLink> links_;
  std::vector<TickStart> starts_;            // of moving_
  std::vector<std::uint8_t> is_pushable_;    // of moving_
  std::vector<std::uint32_t> world_before_;  // of moving_
  std::vector<std::uint32_t> changed_;       // bodies that come into another world
  std::vector<std::uint32_t> isolated_;      // dynamic bodies, ascending
  ContactGroups groups_;
  bool are_all_in_one_ = false;    // every body and fixed outline is in the same group
  bool must_find_groups_ = false;  // a grip joined two groups

  std::vector<std::unique_ptr<GroupWorld>> worlds_;
  std::vector<std::uint32_t> free_worlds_;     // numbers in worlds_, of closed ones
  std::vector<std::uint32_t> world_of_group_;  // of each group
  std::vector<std::uint32_t> order_;           // groups, the largest first: the order in which threads take them
  std::vector<WorldClaim> claims_;             // of each world
  std::vector<std::uint32_t> votes_;           // of each world
  std::unique_ptr<RemoteGroups> remote_;       // nullptr if the engine is not split
};

}  // namespace swarmanoid::dynamics2d

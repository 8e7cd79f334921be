// Dynamics2dWorld: rigid bodies on a plane. Metres, kilograms, newtons and radians. Each contact group, the bodies that
// can touch each other within a tick, is solved by itself (group_solver.h). Isolated bodies, which meet no other one
// within a tick, move in closed form, as the solver would move them without contacts. Regions of a split engine can
// solve groups (remote_groups.h).
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "common/messages/regions.h"
#include "common/plugin_descriptions/robot_parts.h"
#include "common/serialisation/bytes.h"
#include "common/threads/worker_pool.h"
#include "engine_worker/engines/dynamics2d/group_solver.h"
#include "engine_worker/engines/dynamics2d/plane_body.h"
#include "engine_worker/engines/plane_frame.h"
#include "engine_worker/engines/rigid_bodies/contact_groups.h"

namespace swarmanoid::dynamics2d
{

struct WorldSettings
{
  int velocity_iterations = 8;
  int position_iterations = 3;
  double turret_torque = 0;  // N m, of the motor that turns a gripping turret
  double grip_distance = 0;  // m, from the face of the gripper to what it can take
};

// How far from its front a gripper of the model rod takes bodies (m): the circle of dynamics2d_footbot_model.cpp of
// ARGoS3.
inline constexpr double kRodGripDistance = 0.01;

class RemoteGroups;

class Dynamics2dWorld
{
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
    InParts(
        IfItShares(pool_), count, 1,
        [&](unsigned, std::size_t begin, std::size_t end)
        {
          for (std::size_t i = begin; i < end; ++i) act(i);
        },
        kLeast);
  }

  // Begins a tick of `seconds` and finds the groups. Bodies must not be placed or driven before it ends.
  void BeginTick(double seconds);
  // Makes the tick in equal steps.
  void Advance(int steps);
  // The number of groups in this tick.
  std::size_t GroupCount() const { return groups_.Count(); }
  // The number of bodies that are isolated in this tick.
  std::size_t IsolatedCount() const { return isolated_.size(); }

  PlanePose PoseOf(int body) const
  {
    const BodyState& state = bodies_[Index(body)].state;
    return {state.x, state.y, state.angle};
  }
  PlaneVelocity VelocityOf(int body) const
  {
    const BodyState& state = bodies_[Index(body)].state;
    return {state.vx, state.vy, state.turn};
  }
  // Sets the pose of a body. Its grips stay, so the caller must also place the bodies that it grips or that grip it.
  void Place(int body, const PlanePose& pose);
  void SetVelocity(int body, const PlaneVelocity& velocity);
  // Another polygon for a body that has one; the old one stays if no corner is farther off than `tolerance` (m).
  void SetOutline(int body, const std::vector<Vector2>& polygon, double tolerance);
  const std::vector<Vector2>& OutlineOf(int body) const { return bodies_[Index(body)].model.polygon; }
  // Takes a body out of all collisions, or puts it back.
  void SetSolid(int body, bool solid) { bodies_[Index(body)].solid = solid; }
  // Says whether grippers can take a body.
  void SetGrippable(int body, bool grippable) { bodies_[Index(body)].model.grippable = grippable; }

  // Sets the velocity that a body strives for against the ground, within its ground_force and ground_torque.
  void SetDrive(int body, const Twist& drive) { bodies_[Index(body)].drive = drive; }
  // Turns the gripper of a body that grips nothing to an angle against it, radians.
  void SetTurretAngle(int body, double radians) { bodies_[Index(body)].turret_angle = radians; }
  void SetTurretSpeed(int body, double radians_per_second) { bodies_[Index(body)].turret_speed = radians_per_second; }
  double TurretAngleOf(int body) const  // -pi..pi
  {
    const Body& it = bodies_[Index(body)];
    if (!it.model.has_turret_motor || it.gripped == kNoBody) return it.turret_angle;
    return AngleOfGrip(it, bodies_[Index(it.gripped)]);
  }

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
  void MeasureLoads() { settings_of_solver_.measures_loads = 1; }
  const TickMeasures& MeasuresOf(int body) const { return bodies_[Index(body)].measures; }

  int ContactCount() const { return contact_count_; }
  int GripCount() const;

  // The state has no forces of contacts and grips, which Rebuild drops.
  void SaveState(ByteWriter& state) const;
  void LoadState(ByteReader& state);
  void Rebuild();
  // Forgets the forces. Angles, which grow with each turn, stay.
  void BeginAgain() { Build(); }

private:
  // A body when the tick began.
  struct TickStart
  {
    BodyState state;
    GroundForce ground;
    GripForces grip_forces;
    double turret_angle;
    std::optional<double> held_angle;
  };
  // The contacts of the last tick whose first body is this one.
  struct ContactRange
  {
    std::uint32_t first, count;
  };
  static constexpr std::uint32_t kNoRun = 0xffffffff;

  static std::size_t Index(int body) { return static_cast<std::size_t>(body); }

  // The groups of bodies (body_groups.cpp).
  void ConfigureSeparation();
  void Outline(Body& body, double seconds, MovingOutline& outline) const;
  void FindGroups();
  bool MergeGroups(double step_seconds, int steps);
  void LetGoOn(std::uint32_t moving, double seconds);
  void SearchGroups();
  void ListIsolated();
  void BeginRun(std::size_t group);
  void GoOn(std::size_t group, std::uint32_t number);
  void SortGroups();

  // The steps of a tick (dynamics2d_step.cpp).
  void KeepStarts();
  void ReturnToStart(std::size_t moving);
  void RunGroups(double seconds, int steps, std::span<const std::uint32_t> isolated);
  void RunHere(double seconds, int steps, std::span<const std::uint32_t> isolated, bool with_groups);
  void KeepContacts();
  void CountTurns(Body& body);
  void WrapAngles();
  bool LeadsTo(int from, int to) const;

  WorldSettings settings_;
  SolverSettings settings_of_solver_;
  std::vector<Body> bodies_;

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
  std::vector<TickStart> starts_;          // of moving_
  std::vector<std::uint8_t> is_pushable_;  // of moving_
  std::vector<std::uint32_t> no_groups_;   // of moving_: kAlone
  std::vector<std::uint32_t> isolated_;    // dynamic bodies, ascending
  ContactGroups groups_;
  bool are_all_in_one_ = false;    // every body and fixed outline is in the same group
  bool must_find_groups_ = false;  // a grip joined two groups

  std::vector<std::unique_ptr<GroupRun>> runs_;
  std::vector<std::uint32_t> free_runs_;
  std::vector<std::uint32_t> run_of_group_, run_before_;
  std::vector<std::uint32_t> run_of_moving_;  // of the group before, while groups merge
  std::vector<std::uint32_t> order_;          // groups, the largest first: the order in which threads take them
  std::vector<Contact> contacts_;             // after the last tick
  std::vector<ContactRange> contacts_of_;     // of each body
  int contact_count_ = 0;
  std::unique_ptr<RemoteGroups> remote_;  // nullptr if the engine is not split
};

}  // namespace swarmanoid::dynamics2d

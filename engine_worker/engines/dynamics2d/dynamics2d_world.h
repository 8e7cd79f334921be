// Dynamics2dWorld: rigid bodies on a plane, solved by Box2D. Metres, kilograms, newtons and radians outside; inside one
// unit is a decimetre, so that Box2D's tolerances, made for things of a metre, fit robots. Isolated bodies, which meet
// no other one within a tick, are not in Box2D: they move as its solver moves them without contacts.
#pragma once

#include <box2d/box2d.h>

#include <memory>
#include <optional>
#include <vector>

#include "common/plugin_descriptions/robot_parts.h"
#include "common/serialisation/bytes.h"
#include "engine_worker/engines/plane_frame.h"
#include "engine_worker/engines/separation_test.h"

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

// The square of the gripper: its edge, and how far its outer face stands from the axis of the turret (m).
inline constexpr double kGripperSide = GripperSquare::kSide;
inline constexpr double kGripperReach = GripperSquare::kReach;
inline constexpr int kNoBody = -1;
// Box2D's units.
inline constexpr double kUnitsPerMetre = 10;
inline constexpr double kForceUnits = kUnitsPerMetre;                    // per newton
inline constexpr double kTorqueUnits = kUnitsPerMetre * kUnitsPerMetre;  // per newton metre
inline b2Vec2 ToUnits(double x, double y)
{
  return {static_cast<float>(x * kUnitsPerMetre), static_cast<float>(y * kUnitsPerMetre)};
}

class Dynamics2dWorld
{
public:
  explicit Dynamics2dWorld(const WorldSettings& settings);
  ~Dynamics2dWorld();

  // Bodies are numbered from 0 in the order in which they come. None can be added after Build.
  int AddBody(BodyModel model, const PlanePose& pose);
  void Build();

  // Begins a tick of `seconds` and decides which bodies are isolated. Bodies must not be placed, driven or gripped
  // before it ends.
  void BeginTick(double seconds);
  // Advances by `seconds`, a part of the tick.
  void Step(double seconds);
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

  // The velocity that a body strives for against the ground, within its ground_force and ground_torque.
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
  TurretLoad LoadOf(int body) const;

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
  struct Body
  {
    BodyModel model;
    BodyState start{};  // while it is not in Box2D
    // The part of the position (decimetres) that Box2D's single precision cannot hold. Without it each step would lose
    // or gain some of its way.
    double remainder_x = 0;
    double remainder_y = 0;
    bool solid = true;
    Twist drive;
    double turret_speed = 0;
    double turret_angle = 0;           // while nothing is gripped; otherwise the joint's
    std::optional<double> held_angle;  // that the motor of a gripping turret returns to
    int gripped = kNoBody;
    bool is_gripped = false;  // when the tick began
    GripState grip{};
    b2Body* b2 = nullptr;
    b2Fixture* gripper = nullptr;
    b2MotorJoint* ground = nullptr;
    b2Joint* joint = nullptr;  // to the gripped body
  };

  // How far a body may get in a tick, and where it began.
  struct Way
  {
    double x, y, angle;  // decimetres, radians
    double most;         // decimetres
  };

  static std::size_t Index(int body) { return static_cast<std::size_t>(body); }
  static BodyState StateOf(const Body& body);
  void BuildBody(Body& body);
  void ConfigureIsolation();
  bool CanBeIsolated(const Body& body) const;
  void Isolate(Body& body);
  static void LeaveOut(Body& body);
  void Outline(const Body& body, double seconds, MovingOutline& outline) const;
  static Way WayFrom(const Body& body, double metres);
  void EndIsolation(int number);
  void MarkGripped();
  void AdvanceIsolated(Body& body, double seconds) const;
  // Returns whether a body was pushed farther than was allowed for when the tick began, or is about to be.
  bool IsAnyTooFar(double seconds) const;
  b2FixtureDef FixtureOf(const Body& body) const;
  static b2PolygonShape ShapeOf(const std::vector<Vector2>& outline);
  void BuildGrip(Body& body);
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
  void ApplyTurret(Body& body, double seconds);
  void KeepRemainder(Body& body, const b2Vec2& before, double seconds) const;
  static void SetPosition(Body& body, double x, double y, float angle);
  bool LeadsTo(int from, int to) const;
  void WrapAngles();

  WorldSettings settings_;
  std::vector<Body> bodies_;
  std::unique_ptr<b2World> world_;
  b2Body* ground_ = nullptr;       // without shape: ground joints hold on to it
  std::vector<b2Vec2> positions_;  // before a step
  double last_step_ = 0;           // seconds

  SeparationTest isolation_;
  bool isolation_is_configured_ = false;
  double tick_ = 0;                      // seconds
  std::vector<std::uint32_t> moving_;    // bodies that are not static, ascending, as isolation_ has them
  std::vector<MovingOutline> outlines_;  // of them
  std::vector<Nearness> nearness_;       // of them
  std::vector<std::uint32_t> isolated_;  // bodies, ascending
  std::vector<std::uint32_t> solved_;    // dynamic ones that are in Box2D, ascending
  std::vector<Way> ways_;                // of the bodies in moving_
};

}  // namespace swarmanoid::dynamics2d

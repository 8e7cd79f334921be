// The rigid bodies of the engine dynamics2d and their state, as plain structs. Metres, kilograms, seconds, newtons and
// radians. Dynamics2dWorld has them; group_solver.h moves those that can touch others.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "common/math/elementary.h"
#include "common/plugin_descriptions/robot_parts.h"
#include "common/serialisation/bytes.h"
#include "engine_worker/engines/plane_frame.h"

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

inline constexpr int kNoBody = -1;
// The square of the gripper: its edge, and how far its outer face stands from the axis of the turret (m).
inline constexpr double kGripperSide = GripperSquare::kSide;
inline constexpr double kGripperReach = GripperSquare::kReach;
inline constexpr double kGripperMiddle = kGripperReach - kGripperSide / 2;
inline const double kGripperRadius = std::sqrt(0.5) * kGripperSide;
// No body goes farther than this in a step (m), or turns more (radians).
inline constexpr double kLongestStep = 0.2;
inline constexpr double kLargestTurn = kPi / 2;

inline double Length(double x, double y) { return std::sqrt(x * x + y * y); }

struct BodyState
{
  double x, y, angle;
  double vx, vy, turn;
};

// The hold of a gripper on a body. The forces are those of the last step: it begins with them.
struct GripState
{
  double anchor_x = 0, anchor_y = 0;  // the axis of the turret, or the end of the rod, in the frame of the gripped body
  double reference_angle = 0;         // of the gripped body against the gripping one where the joint's angle is 0
};
struct GripForces
{
  double x = 0, y = 0;  // N, on the gripped body; of a rod, x is the push along it
  double torque = 0;    // N m
};
// The force and torque of the ground on a body in the last step.
struct GroundForce
{
  double x = 0, y = 0, torque = 0;
};

// A corner of a polygon, and the outward normal of the edge from it to the next one.
struct Corner
{
  double x, y;
  double normal_x, normal_y;
};

struct Body
{
  BodyState state{};
  SinCos heading{0, 1};  // of state.angle when the tick began
  Twist drive;
  double turret_speed = 0;
  double turret_angle = 0;  // while nothing is gripped by a turret with a motor; otherwise the joint's
  GroundForce ground;
  double radius = 0;     // around the origin, of the outline and the gripper
  double arm = 0;        // m, from the origin to the point of the gripper that turning moves farthest
  double half_axle = 0;  // m; 0: the wheels are not measured
  TickMeasures measures;
  bool solid = true;
  int gripped = kNoBody;
  GripState grip;
  GripForces grip_forces;
  std::optional<double> held_angle;  // that the motor of a gripping turret returns to
  std::vector<Corner> corners;       // of model.polygon
  BodyModel model;
};

// Derives the lengths and corners of a body from its model.
void UpdateShape(Body& body);

// Parts (0 to 1) of the friction with the ground that resist sliding and turning.
struct FrictionShares
{
  double sliding;
  double turning;
};
FrictionShares SharesOf(const BodyModel& model, double vx, double vy, double turn);

// The way of a body that turns at a steady rate through a step: its chord has the direction of the middle of the step,
// and is shorter than the arc.
struct ChordOfStep
{
  double cos, sin;    // of half the angle by which it turns
  double shortening;  // length of the chord / length of the arc
};
ChordOfStep ChordOf(double turn);

// The angle of the turret of a body that grips `gripped`, -pi..pi.
double AngleOfGrip(const Body& body, const Body& gripped);

// These put the parts of a body that change into bytes, and get them.
void PutMotion(const Body& body, ByteWriter& state);
void GetMotion(Body& body, ByteReader& state);
void PutGrip(const Body& body, ByteWriter& state);
void GetGrip(Body& body, ByteReader& state);

}  // namespace swarmanoid::dynamics2d

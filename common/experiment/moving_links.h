// The links of a robot that joints move: legs, arms, lifts. The row of a kind lists them. The reader of URDF files
// makes them, dynamics3d moves them, and sensors, renderers and devices read their positions from attributes.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "common/math/pose.h"

namespace swarmanoid
{

struct ConvexHull;
struct EntityKindDescription;

// A shape that collides, fixed to a link.
struct LinkShape
{
  enum class Form : std::uint8_t
  {
    kBox,       // size: lengths along x, y, z
    kCylinder,  // about z; size: radius, radius, length
    kSphere,    // size: radius, three times
    kHull       // size: the box around `hull`, whose centre is that of `pose`
  };
  Form form = Form::kBox;
  Vector3 size = Vector3::Zero();                    // m
  Pose pose{};                                       // of its centre, in the frame of the entity, all joints at 0
  std::shared_ptr<const ConvexHull> hull = nullptr;  // in the frame of `pose`
};

// The mass and the shapes of links that move as one body, in the frame of the entity, all joints at 0.
struct LinkBody
{
  double mass_kg = 0;
  Vector3 centre_of_mass = Vector3::Zero();           // m
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  // kg m², about the centre of mass, along the axes of the entity
  std::vector<LinkShape> shapes{};
};

// A link with the joint that moves it. Joints turn (rad) or slide (m) along `axis` from 0.
struct MovingLink
{
  static constexpr int kBase = -1;

  std::string joint{};      // its name
  std::string attribute{};  // with its position: "joint_NAME"
  bool slides = false;
  int parent = kBase;                // index of the link that carries it, which is smaller than its own
  Vector3 anchor = Vector3::Zero();  // a point on the axis, in the frame of the entity, all joints at 0
  Vector3 axis = Vector3::UnitX();   // a unit vector, in the same frame
  // The range of positions; infinite for a joint that turns without end.
  double lowest = -std::numeric_limits<double>::infinity();
  double highest = std::numeric_limits<double>::infinity();
  double max_speed = 0;  // rad/s or m/s, of its motor
  double effort = 0;     // N m or N, the most that its motor exerts; 0: it has no motor and moves freely
  double damping = 0;    // N m s/rad or N s/m
  double friction = 0;   // N m or N; of a joint without a motor
  LinkBody body{};

  bool IsEndless() const { return !slides && highest == std::numeric_limits<double>::infinity(); }
  // Returns the position in its range that is nearest to `position`.
  double Within(double position) const;
  // Returns where it starts: as near to 0 as its range allows.
  double Start() const { return Within(0); }
};

// Returns by which rigid motion each link has left its pose with all joints at 0, in the frame of the entity.
// `positions` has one for each link.
std::vector<Pose> MotionsOfLinks(std::span<const MovingLink> links, std::span<const double> positions);

// The motors of joints follow one law in all engines. A commanded position is approached at the joint's largest speed;
// a commanded speed is kept. Both move a reference, which the joint follows.
struct JointCommand
{
  enum class Mode : std::uint8_t
  {
    kNone,      // it stays where it started
    kPosition,  // value: rad or m
    kVelocity   // value: rad/s or m/s
  };
  Mode mode = Mode::kNone;
  double value = 0;

  // Reads the two numbers that a joint has in the channel "joints": the mode, and the value.
  static JointCommand From(std::span<const double> numbers);
};
inline constexpr int kJointCommandWidth = 2;  // numbers of the channel of commands for each joint
inline constexpr int kJointReadingWidth = 3;  // of the channel of readings: position, velocity, effort

// Returns where the reference of a joint is after `seconds`, within its range. That of an endless joint is not wrapped.
double NextReference(const MovingLink& link, const JointCommand& command, double reference, double seconds);

}  // namespace swarmanoid

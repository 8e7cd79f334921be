// Poses of bodies on a plane and their exact first-order motion.
#pragma once

#include <cstddef>
#include <vector>

namespace swarmanoid::kinematics2d
{

// A heading as the unit quaternion (0, 0, z, w) about the normal of the plane: sine and cosine of half the angle.
struct Rotor
{
  double z = 0;
  double w = 1;
};

struct Pose2
{
  double x = 0;
  double y = 0;
  Rotor heading;
};

// The velocity of a body in its own frame: forward and left in m/s, turn in rad/s counter-clockwise.
struct Twist
{
  double forward = 0;
  double left = 0;
  double turn = 0;
};

Rotor RotorOf(double angle);
double AngleOf(Rotor rotor);
inline Rotor operator*(Rotor a, Rotor b) { return {a.z * b.w + a.w * b.z, a.w * b.w - a.z * b.z}; }
inline Rotor Conjugate(Rotor r) { return {-r.z, r.w}; }
inline double CosOf(Rotor r) { return r.w * r.w - r.z * r.z; }
inline double SinOf(Rotor r) { return 2 * r.z * r.w; }
Pose2 Compose(const Pose2& frame, const Pose2& local);
// Returns the pose of `inner` in the frame of `outer`.
Pose2 Relative(const Pose2& outer, const Pose2& inner);
// Returns the pose of a body with this twist after `seconds`.
Pose2 Advanced(const Pose2& pose, const Twist& twist, double seconds);

// Arrays that the vector loops read are padded to a multiple of this many elements.
inline constexpr std::size_t kPadding = 16;
constexpr std::size_t PaddedCount(std::size_t count) { return (count + 2 * kPadding - 1) / kPadding * kPadding; }

// The poses of all bodies, one array a component, padded for the vector loops.
struct PoseStore
{
  std::vector<double> x, y, z, w;

  void Resize(std::size_t padded);
  Pose2 Get(std::size_t k) const { return {x[k], y[k], {z[k], w[k]}}; }
  void Set(std::size_t k, const Pose2& pose)
  {
    x[k] = pose.x;
    y[k] = pose.y;
    z[k] = pose.heading.z;
    w[k] = pose.heading.w;
  }
};

struct TwistStore
{
  std::vector<double> forward, left, turn;

  void Resize(std::size_t padded);
  Twist Get(std::size_t k) const { return {forward[k], left[k], turn[k]}; }
  void Set(std::size_t k, const Twist& twist)
  {
    forward[k] = twist.forward;
    left[k] = twist.left;
    turn[k] = twist.turn;
  }
};

// Moves bodies begin..end (multiples of kPadding) by `seconds` at constant twist: each follows the arc of a circle
// exactly, to rounding. Reads `from`, writes `to`.
void Integrate(const PoseStore& from, const TwistStore& twists, double seconds, std::size_t begin, std::size_t end,
               PoseStore& to);

}  // namespace swarmanoid::kinematics2d

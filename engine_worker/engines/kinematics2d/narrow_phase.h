// Exact contacts between two collision models at given poses. Used by the kinematic world for the few pairs whose
// bounding circles meet.
#pragma once

#include <array>
#include <cmath>

#include "engine_worker/engines/kinematics2d/collision_model.h"
#include "engine_worker/engines/kinematics2d/motion.h"

namespace swarmanoid::kinematics2d
{

// A model put somewhere: position, heading and turret as cosine and sine.
struct Placed
{
  const CollisionModel* model = nullptr;
  double x = 0, y = 0;
  double cos = 1, sin = 0;
  double turret_cos = 1, turret_sin = 0;
};

// Where two outlines are near. As long as neither turns, their depth at other positions a, b of the two bodies is
//   point: reach - |(a - b) + (x, y)|, pushing apart along that difference;
//   face:  reach - (a - b) . (x, y),   pushing apart along the unit vector (x, y).
struct Touch
{
  double x, y;
  double reach;
  bool face;
  double depth;  // where it was found
};

struct Touches
{
  static constexpr int kMaximum = 24;
  std::array<Touch, kMaximum> list;
  int count = 0;

  // Drops those that are more than `gap` less deep than the deepest one.
  void KeepDeepest(double gap);
  void Add(const Touch& touch)
  {
    if (count < kMaximum) list[static_cast<std::size_t>(count++)] = touch;
  }
};

// All places where the outlines overlap or are less than `margin` apart, with their depths.
void FindTouches(const Placed& a, const Placed& b, double margin, Touches& touches);
// The depth of a touch where the first body is (dx, dy) from the second.
inline double DepthOf(const Touch& touch, double dx, double dy)
{
  if (touch.face) return touch.reach - (dx * touch.x + dy * touch.y);
  const double x = dx + touch.x;
  const double y = dy + touch.y;
  return touch.reach - std::sqrt(x * x + y * y);
}
// The deepest overlap in metres; 0 where there is none.
double Overlap(const Placed& a, const Placed& b);

}  // namespace swarmanoid::kinematics2d

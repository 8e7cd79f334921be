// Exact contacts between two collision models at given poses. Used by the kinematic world for the few pairs whose
// bounding circles meet.
#pragma once

#include <array>

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
  double x = 0, y = 0;
  double reach = 0;
  bool face = false;
};

struct Touches
{
  static constexpr int kMaximum = 24;
  std::array<Touch, kMaximum> list;
  int count = 0;

  void Add(const Touch& touch)
  {
    if (count < kMaximum) list[static_cast<std::size_t>(count++)] = touch;
  }
};

// All places where the outlines overlap or are less than `margin` apart.
void FindTouches(const Placed& a, const Placed& b, double margin, Touches& touches);
double DepthOf(const Touch& touch, double dx, double dy);
// The deepest overlap in metres; 0 where there is none.
double Overlap(const Placed& a, const Placed& b);

}  // namespace swarmanoid::kinematics2d

// Exact contacts between two collision models at given poses. Used by the kinematic world for the few pairs whose
// bounding circles meet.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "engine_worker/engines/kinematics2d/collision_model.h"
#include "engine_worker/engines/kinematics2d/kinematic_limits.h"
#include "engine_worker/engines/kinematics2d/motion.h"
#include "engine_worker/engines/kinematics2d/vectors.h"

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

// A placed model with the centres of its parts, relative to the body, along the axes of the world.
struct Spot
{
  Placed placed;
  alignas(kVectorBytes) CollisionModel::PartValues centre_x, centre_y;
};

inline void Spread(Spot& spot)
{
  const Placed& body = spot.placed;
  const CollisionModel& model = *body.model;
  const double turned_cos = body.cos * body.turret_cos - body.sin * body.turret_sin;
  const double turned_sin = body.sin * body.turret_cos + body.cos * body.turret_sin;
  for (std::size_t k = 0; k < CollisionModel::kMaximumParts; k += kDoubles)
  {
    const DoubleMask turns = LoadMask(&model.on_turret[k]);
    const Doubles c = turns ? turned_cos + Doubles{} : body.cos + Doubles{};
    const Doubles s = turns ? turned_sin + Doubles{} : body.sin + Doubles{};
    const Doubles x = LoadDoubles(&model.part_x[k]);
    const Doubles y = LoadDoubles(&model.part_y[k]);
    Store(&spot.centre_x[k], c * x - s * y);
    Store(&spot.centre_y[k], s * x + c * y);
  }
}

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

// The depth of a touch where the first body is (dx, dy) from the second.
inline double DepthOf(const Touch& touch, double dx, double dy)
{
  if (touch.face) return touch.reach - (dx * touch.x + dy * touch.y);
  const double x = dx + touch.x;
  const double y = dy + touch.y;
  return touch.reach - std::sqrt(x * x + y * y);
}

// The touches of one pair. Those that are kTouchesApart less deep than the deepest one are left out.
class Touches
{
public:
  // Touches less deep than -margin are of no interest.
  void Begin(double dx, double dy, double margin)
  {
    count_ = 0;
    dx_ = dx;
    dy_ = dy;
    deepest_ = -1e300;
    margin_ = margin;
  }
  // A touch that is not too shallow.
  void Add(const Touch& touch)
  {
    if (count_ < kMaximum) list_[static_cast<std::size_t>(count_++)] = touch;
  }
  void Add(double x, double y, double reach, bool face)
  {
    Touch touch{x, y, reach, face, 0};
    touch.depth = DepthOf(touch, dx_, dy_);
    if (touch.depth <= -margin_) return;
    Add(touch);
    NoteDepth(touch.depth);
  }
  void NoteDepth(double depth)
  {
    if (depth <= deepest_) return;
    deepest_ = depth;
    margin_ = std::min(margin_, kTouchesApart - depth);
  }
  void DropShallow();
  double Margin() const { return margin_; }
  double Deepest() const { return deepest_; }
  int Count() const { return count_; }
  const Touch& operator[](int k) const { return list_[static_cast<std::size_t>(k)]; }

private:
  static constexpr int kMaximum = 24;  // more than two models can have
  std::array<Touch, kMaximum> list_;
  int count_;
  double dx_, dy_;  // from the second body to the first
  double deepest_, margin_;
};

// All places where the outlines overlap or are less than `margin` apart.
void FindTouches(const Spot& a, const Spot& b, double margin, Touches& touches);

// The deepest overlap in metres; 0 where there is none.
double Overlap(const Placed& a, const Placed& b);

}  // namespace swarmanoid::kinematics2d

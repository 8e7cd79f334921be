// Planes between near parts of outlines, as limits for the motions of their leaders (motion_limiter.h). The derivation
// is in separating_planes.cpp.
#pragma once

#include <array>
#include <cstdint>

#include "engine_worker/engines/kinematics2d/motion_limiter.h"
#include "engine_worker/engines/kinematics2d/narrow_phase.h"

namespace swarmanoid::kinematics2d
{

// A part of an outline where the substep began, and the motion that its leader wants. A leader goes a straight way and
// turns about its own origin.
struct MovingPart
{
  const CollisionModel* model = nullptr;
  std::size_t part = 0;
  double x = 0, y = 0;                // of the body
  double centre_x = 0, centre_y = 0;  // of the part
  double cos = 1, sin = 0;            // of the part's angle
  // All that follows is 0 if nothing moves the body.
  bool can_move = false;
  std::uint32_t leader = 0;
  double way_x = 0, way_y = 0;
  double turn = 0;
  double from_x = 0, from_y = 0;              // from the leader to the body
  double centre_way_x = 0, centre_way_y = 0;  // the way of the part's centre by turning, in first order

  // Returns nullptr if the part is a circle.
  const Polygon* OwnPolygon() const
  {
    const auto circles = static_cast<std::size_t>(model->circles);
    return part < circles ? nullptr : &model->polygons[part - circles];
  }
};

// The part of a body at its place, which does not move.
MovingPart PartAt(const Placed& body, std::size_t part);

struct SeparatingPlane
{
  double gap;   // m between the parts, and the overlap that is allowed
  double left;  // of it after all motions
  std::array<Approach, 4> approaches;
};

// Returns the plane with a normal along (x, y), which may have any length and points from the second part to the first.
SeparatingPlane PlaneAlong(const MovingPart& first, const MovingPart& second, double x, double y, double allowed);
// Returns the plane that suits two near parts best. `touch`: where they are nearest; `allowed`: the overlap (m) left
// alone.
SeparatingPlane PlaneBetween(const MovingPart& first, const MovingPart& second, const Touch& touch, double allowed);

}  // namespace swarmanoid::kinematics2d

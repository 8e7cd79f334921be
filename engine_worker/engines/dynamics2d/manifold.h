// The points at which two parts of bodies meet: discs and convex polygons. Box2D finds those of two polygons. Positions
// are relative to the bodies, so that results do not depend on where these are.
#pragma once

#include <array>
#include <cstdint>

#include "engine_worker/engines/dynamics2d/plane_body.h"

namespace swarmanoid::dynamics2d
{

// Polygons collide this far (m) around them.
inline constexpr double kPolygonSkin = 2.5e-4;

// A disc around the origin of its body, or a convex polygon in its frame, counter-clockwise.
struct PartShape
{
  const Corner* corners = nullptr;
  int count = 0;      // 0: a disc
  double radius = 0;  // of the disc, or the skin of the polygon
  double reach = 0;   // of the circle around (x, y) that contains the part
  double x = 0, y = 0;
};

struct BodyPlace
{
  double x, y, cos, sin;
};

// In the terms of Box2D: a plane on one body, and points of the other; or the middles of two discs.
struct Manifold
{
  int points = 0;
  bool are_discs = false;
  bool is_plane_of_b = false;
  double normal_x, normal_y, plane_x, plane_y;  // in the frame of the body with the plane
  std::array<double, 2> x, y;                   // in the frame of the other one
  std::array<std::uint32_t, 2> features{};
};

// Returns true if a circle is farther than its radius from an edge of a polygon, on the outer side.
bool IsBeyondEdge(const PartShape& polygon, const BodyPlace& at, double x, double y, double radius);

// Finds the points with gaps up to `margin`.
Manifold Collide(const PartShape& a, const BodyPlace& at_a, const PartShape& b, const BodyPlace& at_b, double margin);

// A point of a manifold with the bodies where they are now. The normal points from a to b.
struct Meeting
{
  double normal_x, normal_y;
  double x, y;  // between the surfaces
  double gap;   // negative if they overlap
};
Meeting MeetingOf(const Manifold& manifold, int point, const PartShape& a, const BodyPlace& at_a, const PartShape& b,
                  const BodyPlace& at_b);

}  // namespace swarmanoid::dynamics2d

// What an observer sees of some points: exact lines of sight against the bodies around, many at a time. Bodies hide
// what lies behind them where they share an engine with the observer or with the owner of the point; nobody hides
// himself.
#pragma once

#include <span>
#include <vector>

#include "controller_host/devices/sensor_world.h"

namespace swarmanoid
{

class SightLines
{
public:
  static constexpr std::uint32_t kNobody = 0xffffffff;

  // `reach`: how far points usually lie from the eye in the xy plane, m.
  SightLines(const SensorWorld& world, double reach);

  // A movable body around the eye.
  struct Neighbour
  {
    std::uint32_t entity;
    float ring_start;  // square of a distance (m^2) that it is not nearer than
    double x, y;       // m, of its origin from the eye
  };

  // Starts anew: an eye of `observer`, for points within `reach` m in the xy plane. The world must be refreshed.
  void LookFrom(std::uint32_t observer, const Vector3& eye, double reach);
  // The movable bodies around the eye, without the observer; many of them come near first.
  std::span<const Neighbour> Around() const { return {around_.data(), neighbours_}; }
  // A point by its offset from the eye; `owner`: the entity that it is part of, or kNobody. Fastest when points are
  // added in the order of Around().
  void AddPoint(const Vector3& offset, std::uint32_t owner)
  {
    if (points_ + kLanes > point_x_.size()) Grow();
    // Straight above or below: moved aside by a micrometre, so that it has a direction.
    const bool vertical = offset.x() * offset.x() + offset.y() * offset.y() < 1e-12;
    point_x_[points_] = vertical ? 1e-6F : static_cast<float>(offset.x());
    point_y_[points_] = vertical ? 0 : static_cast<float>(offset.y());
    point_z_[points_] = static_cast<float>(offset.z());
    owner_[points_] = static_cast<std::int32_t>(owner);
    ++points_;
  }
  // For each point, in the order of AddPoint, whether it is seen. Valid until the next LookFrom.
  std::span<const char> Solve();

private:
  // An upright cylinder, relative to the eye.
  struct Disc
  {
    float x, y;
    float square_radius;
    float ring_start;  // m^2
    float far_edge;    // m
    float low, high;
    std::int32_t entity;
    bool spans;  // as high and as low as all points and the eye
    bool holds_eye;
  };
  // An upright box.
  struct Box
  {
    Heading heading;
    float x, y;  // of the eye in the frame of the box
    float half_x, half_y, low, high;
    std::int32_t entity;
  };
  // What the points span.
  struct Bounds
  {
    float lowest = 0, highest = 0;  // m, the eye included
    float farthest = 0;             // m, in the xy plane
  };

  void Grow();
  void SortAround();
  void CollectBodies();
  void AddBody(std::uint32_t body, double dx, double dy, float ring_start, bool upright, const Bounds& bounds);
  void AddFixed(std::uint32_t body, const Bounds& bounds);
  void AddUpright(std::uint32_t body, double dx, double dy, float ring_start, const Bounds& bounds);
  void SolveGroup(std::size_t first);
  bool HiddenByOthers(std::size_t point) const;

  const SensorWorld& world_;
  FixedBodies fixed_;
  double usual_reach_;

  std::uint32_t observer_ = 0;
  Vector3 eye_ = Vector3::Zero();
  double reach_ = 0;
  std::size_t neighbours_ = 0;
  std::vector<Neighbour> around_;  // as long as there are bodies, so that it never grows
  std::vector<Neighbour> sorted_around_;

  // Points, with room for whole lanes behind them.
  std::size_t points_ = 0;
  std::vector<float> point_x_, point_y_, point_z_;
  std::vector<std::int32_t> owner_;
  std::vector<char> seen_;

  std::vector<Disc> discs_;
  bool all_span_ = true;  // none of them needs a look at heights
  float largest_radius_ = 0;
  std::vector<Box> boxes_;
  std::vector<std::uint32_t> tilted_;   // tested one by one
  std::vector<std::uint32_t> foreign_;  // hide only what shares an engine with them, tested one by one
  std::vector<std::uint32_t> stamps_;
  std::uint32_t stamp_ = 0;
};

}  // namespace swarmanoid

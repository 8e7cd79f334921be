// SightLines: the points that an observer sees, by exact lines of sight against the bodies around and the terrain, many
// at a time. A body hides points if it shares an engine with the observer or with the owner of the point. No body hides
// its own points. The spot of a laser belongs to no entity (kNobody): bodies of any
// engine hide it, since they stop the beam, too. The surface that it lies on does not hide it.
#pragma once

#include <span>
#include <vector>

#include "controller_host/devices/sensing/disc_field.h"
#include "controller_host/devices/sensing/sensor_world.h"

namespace swarmanoid
{

class SightLines
{
public:
  static constexpr std::uint32_t kNobody = 0xffffffff;

  // `reach` (m) is the usual distance of points from the eye in the xy plane.
  SightLines(const SensorWorld& world, double reach);

  // Starts a new search: an eye of `observer`, for points within `reach` m in the xy plane. The world must be
  // refreshed.
  void LookFrom(std::uint32_t observer, const Vector3& eye, double reach);
  // Returns the movable bodies around the eye, without the observer: entity indices, and places in the order of the
  // grid.
  std::span<const std::int32_t> AroundForTest() const { return {near_.entity.data(), near_.count}; }
  std::span<const std::int32_t> PlacesAround() const { return {near_.place.data(), near_.count}; }
  // Adds a point by its offset from the eye. `owner` is the entity that has the point, or kNobody. The
  // offset of a point with kNobody is the one that InFrontOf returns.
  void AddPoint(const Vector3& offset, std::uint32_t owner)
  {
    const std::size_t i = points_.count++;
    if (i + kLanes >= points_.x.size()) points_.Reserve(2 * i + 64);
    points_.x[i] = static_cast<float>(offset.x());
    points_.y[i] = static_cast<float>(offset.y());
    points_.z[i] = static_cast<float>(offset.z());
    points_.owner[i] = static_cast<std::int32_t>(owner);
  }
  // Returns the end of a line of sight to a spot at this offset from the eye, a little in front of its surface.
  static Vector3 InFrontOf(const Vector3& spot);
  // Adds one point on each movable body around the eye, in the order of PlacesAround(), instead of AddPoint. The points
  // are at the origins, moved by the height of the eye above the observer's origin. The world must have no tilted
  // bodies. Boxes may not hide the points that are farther than the reach.
  void LookAtBodiesAround();
  // Gives access for callers that put many points at once.
  SightPoints& Points() { return points_; }
  // Returns for each point, in the order of AddPoint, whether it is visible. The result is valid until the next
  // LookFrom.
  const SeenPoints& Solve();

private:
  // An upright box, relative to the eye.
  struct Box
  {
    Heading heading;
    float x, y;  // of the eye in the frame of the box
    float half_x, half_y, low, high;
    float normal_x, normal_y, distance;  // of a side that faces the eye: lines that do not reach its plane pass
    std::int32_t entity;
  };

  void FindHeights();
  void FindOutline();
  void FindOutlineOfOrigins();
  void CollectBodies();
  bool IsOutside(std::size_t near);
  void AddBody(std::uint32_t body, bool upright);
  void AddBox(std::uint32_t body);
  void HideBehindBox(const Box& box);
  bool HiddenByOthers(std::size_t point) const;
  bool HiddenByTerrain(std::size_t point) const;

  const SensorWorld& world_;
  FixedBodies fixed_;
  double usual_reach_;

  std::uint32_t observer_ = 0;
  Vector3 eye_ = Vector3::Zero();
  double reach_ = 0;
  NearBodies near_;
  SightPoints points_;
  bool are_origins_ = false;       // the points are those of LookAtBodiesAround
  std::vector<float> same_level_;  // zeros
  PointView shown_;                // the points that Solve looks at
  SeenPoints seen_;

  NearBodies discs_;  // upright cylinders that hide things from the observer, if not all that are near do
  DiscField field_;
  // The bounds of the points and the eye, or wider.
  float lowest_ = 0, highest_ = 0;
  bool has_outline_ = false;
  float left_ = 0, right_ = 0, back_ = 0, front_ = 0;
  struct
  {
    std::uint64_t rebuilds = 0;  // of the grid
    double left, right, back, front;
  } origins_;  // the bounds of the origins of all movable bodies, m
  std::vector<Box> boxes_;
  std::vector<std::uint32_t> tilted_;   // tested one by one
  std::vector<std::uint32_t> foreign_;  // hide only what shares an engine with them, tested one by one
  std::vector<std::uint32_t> stamps_;
  std::uint32_t stamp_ = 0;
};

}  // namespace swarmanoid

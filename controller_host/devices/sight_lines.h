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

  // Starts anew: an eye of `observer`, for points within `reach` m in the xy plane. The world must be refreshed.
  void LookFrom(std::uint32_t observer, const Vector3& eye, double reach);
  // The movable bodies around the eye, without the observer.
  std::span<const std::uint32_t> Around() const { return around_; }
  // A point by its offset from the eye; `owner`: the entity that it is part of, or kNobody.
  void AddPoint(const Vector3& offset, std::uint32_t owner);
  // For each point, in the order of AddPoint, whether it is seen. Valid until the next LookFrom.
  std::span<const char> Solve();

private:
  struct Box
  {
    Heading heading;
    float x, y;  // of the eye in the frame of the box
    float half_x, half_y, low, high;
    std::int32_t entity;
  };

  void CollectBodies();
  void AddBody(std::uint32_t body, float lowest, float highest, float farthest);
  void SortNearFirst();
  void SolveGroup(std::size_t first);
  bool HiddenByOthers(std::size_t point) const;

  const SensorWorld& world_;
  FixedBodies fixed_;
  double usual_reach_;

  std::uint32_t observer_ = 0;
  Vector3 eye_ = Vector3::Zero();
  double reach_ = 0;
  std::vector<std::uint32_t> around_;

  // Points, padded to whole lanes; near first after SortNearFirst, `order_` leads back.
  std::size_t points_ = 0;
  std::vector<float> point_x_, point_y_, point_z_;
  std::vector<std::int32_t> owner_;
  std::vector<std::uint32_t> order_;
  std::vector<char> seen_;

  // Discs: upright cylinders, relative to the eye.
  struct Disc
  {
    float x, y;
    float square_radius;
    float square_distance;
    float low, high;
    std::int32_t entity;
    bool spans;  // as high and as low as all points and the eye
  };
  std::vector<Disc> discs_;
  float largest_radius_ = 0;
  bool sorted_ = false;
  std::vector<Box> boxes_;
  std::vector<std::uint32_t> tilted_;   // tested one by one
  std::vector<std::uint32_t> foreign_;  // hide only what shares an engine with them, tested one by one
  std::vector<std::uint32_t> stamps_;
  std::uint32_t stamp_ = 0;

  // Scratch of SortNearFirst.
  std::vector<Disc> sorted_discs_;
  std::vector<float> sorted_x_, sorted_y_, sorted_z_;
  std::vector<std::int32_t> sorted_owner_;
};

}  // namespace swarmanoid

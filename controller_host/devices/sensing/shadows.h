// Shadows: finds the points that see a source of light. The bodies around the source are sorted by direction and
// distance, movable ones once a tick, so that each robot is tested only with bodies on its line of sight. The answers
// equal those of SensorWorld::FirstHit for each line. Used by the batches of light sensors. In steady running it
// allocates nothing.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/math/cells.h"
#include "controller_host/devices/sensing/sensor_world.h"

namespace swarmanoid
{

// The directions around a source in the xy plane, cut into sectors. A direction is y / (|x| + |y|) in each quadrant,
// which grows with the angle and needs no arc tangent. A turn is 0 ... 4.
class Sectors
{
public:
  explicit Sectors(std::size_t count) : count_(static_cast<int>(count)) {}

  std::size_t Count() const { return static_cast<std::size_t>(count_); }
  static FloatLanes TurnOf(FloatLanes x, FloatLanes y);
  // Returns sectors that are not wrapped: a turn may lie slightly beyond both ends.
  IntLanes Of(FloatLanes turn) const;
  int Last() const { return count_ - 1; }
  std::size_t Wrapped(int sector) const { return static_cast<std::size_t>(sector & (count_ - 1)); }
  // Returns a vector along the lower border of a sector.
  Vector2 Border(std::size_t sector) const;

private:
  int count_;  // a power of two
};

// Points from which a source is looked for: places in the space, m, and the robot that each is part of. Arrays with
// room for kLanes more.
struct SightedPoints
{
  std::size_t count = 0;
  std::vector<double> x, y, z;
  std::vector<std::uint32_t> robot;

  void Reserve(std::size_t points);
  Vector3 At(std::size_t point) const { return {x[point], y[point], z[point]}; }
};

// The bodies that never move, around one source.
class FixedShadows
{
public:
  void Place(const SensorWorld& world, const Vector3& source);
  // Returns for kLanes lines, by their sectors and lengths in the xy plane, whether a body is near enough to hide the
  // source. Only then Hide must be asked.
  IntLanes MayHide(IntLanes sector, FloatLanes length) const;
  // Returns whether one of them hides the source from a point of `robot`, which is `length` m away in the xy plane.
  bool Hide(const SensorWorld& world, std::uint32_t robot, const Vector3& point, std::size_t sector,
            float length) const;
  const Sectors& Directions() const { return sectors_; }

private:
  struct Body
  {
    float near, far;  // m, from the source along the xy plane, as far as it stands in the sector
    float low, high;  // m, from the height of the source
    std::uint32_t entity;
  };
  void Add(const SensorWorld& world, std::uint32_t entity);

  Sectors sectors_{256};
  Vector3 source_ = Vector3::Constant(1e300);
  std::vector<std::vector<Body>> bodies_;  // by sector, the nearest first
  std::vector<float> nearest_;             // m, from the source to the first body of each sector
};

class MovingShadows
{
public:
  explicit MovingShadows(const SensorWorld& world);

  // Sorts the movable bodies of this tick around a source, those that come within `reach` m of it in the xy plane.
  void Sort(const Vector3& source, double reach);
  // Appends to `seen` the numbers of the points that are within the reach and have nothing between them and the source,
  // ascending.
  void Look(const SightedPoints& points, const FixedShadows& fixed, std::vector<std::uint32_t>& seen) const;

private:
  static constexpr int kRings = 8;  // of distance
  // So few bodies are quicker to look at than to sort.
  static constexpr std::size_t kFew = 4 * kLanes;

  // Lines of sight to kLanes points.
  struct Lines
  {
    FloatLanes way_x, way_y;  // of length 1, from the source
    FloatLanes first, last;   // m: from where to where each may be as high as the bodies
    FloatLanes surely_first, surely_last;
    FloatLanes margin;  // m
    IntLanes first_cell, last_cell;
  };

  Lines LinesTo(const SightedPoints& points, std::size_t group, FloatLanes x, FloatLanes y, FloatLanes length,
                IntLanes sector) const;
  bool IsHidden(const SightedPoints& points, std::size_t point, const Lines& lines, unsigned lane) const;
  // Returns whether one of the bodies at the places `first` + each bit of a mask hides the source, by the exact test.
  bool HidesExactly(unsigned bodies, std::size_t first, std::uint32_t robot, const Vector3& point) const;
  IntLanes RingOf(FloatLanes distance) const;
  // Lists the bodies in the order of the grid, all for each line.
  void ListAll(std::span<const std::uint32_t> bodies);

  const SensorWorld& world_;
  bool are_few_ = false;
  bool share_engines_ = false;  // all movable bodies are in the same engines
  bool are_exact_ = false;      // all are upright cylinders of one size that hide each other
  Vector3 source_ = Vector3::Zero();
  float reach_ = 0;           // m
  float low_ = 0, high_ = 0;  // m, from the source: of all bodies
  float largest_ = 0;         // m: radius
  Sectors sectors_{8};
  float rings_per_m_ = 0;
  // Values by body, then by place in the order of the cells. A sector has kRings cells.
  std::vector<float> body_x_, body_y_, body_radius_;
  std::vector<std::uint32_t> members_;  // the body of each entry in the cells
  CellSort sort_;
  std::vector<float> x_, y_, radius_;  // m, from the source
  std::vector<std::int32_t> entity_;
};

}  // namespace swarmanoid

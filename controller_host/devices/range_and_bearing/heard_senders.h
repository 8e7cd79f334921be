// The senders that receivers of range and bearing hear, robot after robot in one list, so that many angles are computed
// at a time. Used by the receivers' batch. In steady running it allocates nothing.
#pragma once

#include <cstdint>
#include <vector>

#include "common/math/pose.h"
#include "controller_host/devices/sensing/neighbour_grid.h"

namespace swarmanoid
{

class HeardSenders
{
public:
  // The way from antenna to antenna (m): along the axes of the space, then, after Turn, of the receiver's body. `place`
  // is that of the sender in the grid. The arrays have some room behind `count`.
  struct Lanes
  {
    std::int32_t* place;
    double *x, *y, *z;
    double* square;                       // of the distance, m^2: once turned
    double *range, *bearing, *elevation;  // m, rad: once measured
    double* flat;                         // m, in the plane of the body
  };

  // Reserves ReusedMemory for `more` senders and some lanes.
  void Reserve(std::size_t more);
  const Lanes& At() const { return lanes_; }
  // Adds senders whose places are already behind the others, turned into the frame of an upright receiver at `own`.
  // Without heights if all bodies of the grid, which must be upright, are level.
  void Add(std::size_t more, const NeighbourGrid& grid, const Vector3& own, const Heading& heading);
  void Move(std::size_t from, std::size_t to);

  // Turns the ways from `first` on into the axes of a body.
  void Turn(std::size_t first, const Heading& heading);
  void Turn(std::size_t first, const Eigen::Matrix3d& to_body);
  // Computes range and angles of all senders. If `are_level` is true, no sender is higher than its receiver, and the
  // heights are ignored.
  void Measure(bool are_level);

  std::size_t count = 0;

private:
  static constexpr std::size_t kArrays = 8;  // of doubles
  std::vector<std::int32_t> place_;
  std::vector<double> values_;
  Lanes lanes_{};
};

}  // namespace swarmanoid

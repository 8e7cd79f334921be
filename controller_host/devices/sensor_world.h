// The world as the sensors of a process see it, shared by all batches over one space: body shapes, engine membership
// and the grid of neighbours of the current tick. One thread at a time, as the space itself.
#pragma once

#include <memory>
#include <vector>

#include "controller_host/devices/body_shapes.h"
#include "controller_host/devices/engine_membership.h"
#include "controller_host/devices/neighbour_grid.h"

namespace swarmanoid
{

class SensorWorld
{
public:
  explicit SensorWorld(const CSwarmanoidSpace& space);

  // The world of a space: the same object for all who ask while one of them holds it (shared: batches come and go).
  static std::shared_ptr<SensorWorld> Of(const CSwarmanoidSpace& space);

  // Brings the grid to the state of the space, once for all batches of a step. `seen` is kept by the caller, 0 at
  // first: a caller who has seen the current grid already starts a new one, so that a space that was set back is
  // noticed too.
  void Refresh(std::uint64_t& seen);

  const CSwarmanoidSpace& Space() const { return space_; }
  const BodyShape& Shape(std::uint32_t entity) const { return shapes_[entity]; }
  std::span<const BodyShape> Shapes() const { return shapes_; }
  const EngineMembership& Membership() const { return membership_; }
  const NeighbourGrid& Grid() const { return grid_; }

private:
  const CSwarmanoidSpace& space_;
  std::vector<BodyShape> shapes_;
  EngineMembership membership_;
  NeighbourGrid grid_;
  std::uint64_t generation_ = 0;  // of the grid
  std::uint64_t tick_ = 0;
};

}  // namespace swarmanoid

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

  // Brings the grid to the poses of the space, once for all batches of a step.
  void Refresh();

  const CSwarmanoidSpace& Space() const { return space_; }
  const BodyShape& Body(std::uint32_t entity) const { return bodies_[entity]; }
  std::span<const BodyShape> Bodies() const { return bodies_; }
  const EngineMembership& Membership() const { return membership_; }
  const NeighbourGrid& Grid() const { return grid_; }

private:
  const CSwarmanoidSpace& space_;
  std::vector<BodyShape> bodies_;
  EngineMembership membership_;
  NeighbourGrid grid_;
  std::uint64_t revision_;  // of the poses in the grid
};

}  // namespace swarmanoid

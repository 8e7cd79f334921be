// The world as the sensors of a process see it, shared by all batches over one space: body shapes, terrain, engine
// membership and the grid of neighbours of the current tick. One thread at a time, as the space itself.
#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "common/space/collision_models.h"
#include "common/space/space.h"
#include "controller_host/devices/sensing/body_shapes.h"
#include "controller_host/devices/sensing/engine_membership.h"
#include "controller_host/devices/sensing/moved_since.h"
#include "controller_host/devices/sensing/neighbour_grid.h"
#include "controller_host/devices/sensing/sensed_terrain.h"

namespace swarmanoid
{

class SensorWorld
{
public:
  explicit SensorWorld(const CSwarmanoidSpace& space);

  // Returns the world of a space. It is one shared object as long as a batch holds it, since batches come and go.
  static std::shared_ptr<SensorWorld> Of(const CSwarmanoidSpace& space);

  // Brings the grid to the poses of the space, once for all batches of a step; in the threads of `pool`, if there is
  // one.
  void Refresh(WorkerPool* pool = nullptr);

  // Returns whether a body has parts that reach beyond its shape (CollisionModels::Articulated): it is sensed part by
  // part.
  bool IsArticulated(std::uint32_t entity) const { return !parts_of_.empty() && parts_of_[entity] >= 0; }
  // Returns whether any body has such parts.
  bool HasArticulated() const { return !parts_.empty(); }
  // Returns the parts of such a body in the frame of its entity, as of the last Refresh.
  std::span<const CollisionBody> PartsOf(std::uint32_t entity) const
  {
    return parts_[static_cast<std::size_t>(parts_of_[entity])];
  }
  // Returns the fraction of the way from one point to another at which it meets a body; nullopt if it does not.
  std::optional<double> HitOn(std::uint32_t body, const Vector3& from, const Vector3& to) const
  {
    if (IsArticulated(body)) return SegmentHit(PartsOf(body), space_.GetPose(body), from, to);
    return SegmentHit(bodies_[body], space_.GetPose(body), from, to);
  }

  // The part 0..1 of the way from one point to another at which it meets the first body or terrain for which
  // accept(entity) holds; more than 1 if it meets none.
  template <class Accept>
  double FirstHit(const Vector3& from, const Vector3& to, Accept&& accept) const;
  // The first hit, with the entity that was met. If several are met at once, it is the first one of the file.
  struct Met
  {
    double part = 2;
    std::uint32_t entity = 0;
  };
  template <class Accept>
  Met FirstMet(const Vector3& from, const Vector3& to, Accept&& accept) const;
  // Returns whether `body` can hide things from `observer`: they share an engine, or the body stands in the space
  // without being part of any engine's world.
  bool CanHideFrom(std::uint32_t observer, std::uint32_t body) const
  {
    return membership_.ShareEngine(observer, body) ||
           (!membership_.IsInSomeEngine(body) && !space_.GetEntity(body).IsMovable());
  }

  const CSwarmanoidSpace& Space() const { return space_; }
  const BodyShape& Body(std::uint32_t entity) const { return bodies_[entity]; }
  const BodyExtent& Extent(std::uint32_t entity) const { return bodies_[entity].extent; }
  const BodyShapes& Bodies() const { return bodies_; }
  const EngineMembership& Membership() const { return membership_; }
  // Returns the grid of the last Refresh.
  const NeighbourGrid& Grid() const { return grid_; }
  // Returns the movement of the bodies, for sensors that keep their neighbours. Refresh does not update it.
  MovedSince& Moved() { return moved_; }
  // Returns the StreamName of each entity's id. The names are made on the first call and valid as long as the world.
  std::span<const std::uint64_t> Names();
  const SensedTerrain& Terrain() const { return terrain_; }

private:
  void MoveParts();

  const CSwarmanoidSpace& space_;
  CollisionModels models_;
  std::vector<std::int32_t> parts_of_;             // of each entity its place in parts_, or -1; empty if none has parts
  std::vector<std::vector<CollisionBody>> parts_;  // of the entities that are articulated
  BodyShapes bodies_;
  EngineMembership membership_;
  NeighbourGrid grid_;
  MovedSince moved_;
  FixedBodies fixed_;
  SensedTerrain terrain_;
  std::vector<std::uint64_t> names_;
  std::uint64_t revision_;  // of the poses in the grid
};

template <class Accept>
double SensorWorld::FirstHit(const Vector3& from, const Vector3& to, Accept&& accept) const
{
  double first = 2;
  const auto test = [&](std::uint32_t body)
  {
    if (!accept(body)) return;
    if (const auto hit = HitOn(body, from, to)) first = std::min(first, *hit);
  };
  grid_.ForEachAlong(from, to, test);
  fixed_.ForEachAlong(from, to, test);
  return terrain_.IsEmpty() ? first : std::min(first, terrain_.FirstHit(from, to, accept));
}

template <class Accept>
SensorWorld::Met SensorWorld::FirstMet(const Vector3& from, const Vector3& to, Accept&& accept) const
{
  Met first;
  const auto take = [&](double part, std::uint32_t entity)
  {
    if (part < first.part || (part == first.part && entity < first.entity)) first = {part, entity};
  };
  const auto test = [&](std::uint32_t body)
  {
    if (!accept(body)) return;
    if (const auto hit = HitOn(body, from, to)) take(*hit, body);
  };
  grid_.ForEachAlong(from, to, test);
  fixed_.ForEachAlong(from, to, test);
  terrain_.ForEach(
      [&](std::uint32_t terrain)
      {
        if (accept(terrain))
          take(terrain_.FirstHit(from, to, [&](std::uint32_t entity) { return entity == terrain; }), terrain);
      });
  return first;
}

}  // namespace swarmanoid

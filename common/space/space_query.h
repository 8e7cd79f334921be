// SpaceQuery: the entities near a point or in a box, and the bodies between two points. Each role that needs it has one
// object, which updates its index when the space has changed. Answers go by the position of the entity's origin, and
// have only entities in the arena.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "common/space/collision_models.h"
#include "common/space/entity.h"
#include "common/space/index/positional_index.h"
#include "common/space/shape.h"
#include "common/space/terrain/terrain.h"

#ifndef SWARMANOID_OWN_SOURCES
#include <common/space/space.h>  // for plug-ins, which mostly need it
#endif

namespace swarmanoid
{

class CSwarmanoidSpace;

class SpaceQuery
{
public:
  // Reads the terrains of the experiment. Throws ConfigurationError for a mistake in them, and for more than 64
  // engines. The space outlives the query.
  explicit SpaceQuery(const CSwarmanoidSpace& space);
  ~SpaceQuery();

  // Return the entities within a distance (m) of a point, ascending by index.
  const std::vector<std::uint32_t>& FindWithin(const Vector3& point, double distance);
  // Returns the same about an entity, without itself.
  const std::vector<std::uint32_t>& FindWithin(const CSwarmanoidSpaceEntity& entity, double distance);
  const std::vector<std::uint32_t>& FindInBox(const Vector3& low, const Vector3& high);
  // Return the nearest entity within a distance (m), or nullptr.
  const CSwarmanoidSpaceEntity* FindNearest(const Vector3& point, double distance);
  const CSwarmanoidSpaceEntity* FindNearest(const CSwarmanoidSpaceEntity& entity, double distance);

  struct Hit
  {
    std::uint32_t entity = 0;
    double fraction = 0;  // fraction of the way to the hit
  };
  // Returns the first body that the straight line between two points meets in the worlds of an observer. Engines are
  // closed to each other, so only entities that share an engine with the observer count. Entities in `ignored` are
  // transparent. Bodies are those of CollisionModels.
  std::optional<Hit> FindFirstHit(const Vector3& from, const Vector3& to, std::uint32_t observer,
                                  std::span<const std::uint32_t> ignored = {});
  // Returns whether one entity's point is hidden from another's: anything between but the two themselves that shares an
  // engine with either, or never moves and is in no engine: as cameras see it.
  bool IsOccluded(const Vector3& from, const Vector3& to, std::uint32_t observer, std::uint32_t target);

  // Returns one bit for each engine that an entity is bound to.
  std::uint64_t EnginesOf(std::size_t entity) const { return engines_[entity]; }
  const Shape& ShapeOfEntity(std::size_t entity) const { return shapes_[entity]; }
  const PositionalIndex& Index();

private:
  template <class Counts>
  std::optional<Hit> FirstHit(const Vector3& from, const Vector3& to, const Counts& counts,
                              std::span<const std::uint32_t> ignored);
  bool ShareEngine(std::uint32_t a, std::uint32_t b) const { return (engines_[a] & engines_[b]) != 0; }
  void Refresh();
  void DropAbsent(std::vector<std::uint32_t>& entities) const;

  const CSwarmanoidSpace& space_;
  std::unique_ptr<PositionalIndex> index_;
  std::uint64_t revision_;
  std::vector<Shape> shapes_;
  std::vector<std::pair<std::uint32_t, std::shared_ptr<const Terrain>>> terrains_;
  std::vector<std::uint64_t> engines_;
  CollisionModels models_;
  std::vector<CollisionBody> bodies_;
  // These entities are too large for the search near a line, or articulated; they are tested one by one.
  std::vector<std::uint32_t> large_;
  double search_radius_ = 0;  // the largest radius of the other entities
  std::vector<std::uint32_t> found_;
  std::vector<std::uint32_t> candidates_;
};

}  // namespace swarmanoid

// The bodies of entities, as far as placing them needs: do two overlap, which of many overlaps a new one. Engines have
// models of their own, and so has the space: hence the namespace.
#pragma once

#include <optional>
#include <vector>

#include "common/experiment/experiment.h"
#include "common/math/cells.h"

namespace swarmanoid::placement
{

struct Body
{
  bool cylinder = false;
  Vector3 centre = Vector3::Zero();
  Quaternion orientation = Quaternion::Identity();
  // Half the extent along the body's axes; of a cylinder along z: radius, radius, half the height.
  Vector3 half = Vector3::Zero();

  // Half the extent of the box along the axes of the space that holds the body.
  Vector3 HalfExtent() const;
};

// nullopt for kinds without a body (lights, sounds, areas of the floor, terrain).
std::optional<Body> BodyOf(const EntityConfiguration& entity);

// Whether two bodies interpenetrate by more than a micrometre. Exact for boxes and for bodies with parallel axes; of a
// tilted cylinder only the inscribed box counts, so that what is reported does overlap.
bool Overlap(const Body& a, const Body& b);

// Finds overlaps among many bodies in constant time each: a uniform grid over the arena.
class BodyGrid
{
public:
  // `cell`: about the size of the most frequent body (m).
  BodyGrid(const Vector3& arena_size, double cell);

  void Add(const Body& body, std::uint32_t name);
  // The name of a body that overlaps this one; nullopt for none.
  std::optional<std::uint32_t> Find(const Body& body) const;

private:
  struct Entry
  {
    std::uint32_t body;
    std::int32_t next;
  };
  // The cells that the box around a body touches, as ForEachRow of these.
  template <class Visit>
  void ForEachRowOf(const Body& body, const Visit& visit) const;

  BoxCells cells_;
  std::vector<std::int32_t> heads_;
  std::vector<Entry> entries_;
  std::vector<Body> bodies_;
  std::vector<std::uint32_t> names_;
  std::vector<std::uint32_t> large_;  // bodies that would fill too many cells
};

}  // namespace swarmanoid::placement

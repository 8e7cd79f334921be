// The bodies of entities, as far as placing them needs: whether two overlap, and which of many overlaps a new one.
// Engines and the space have their own models, hence the namespace.
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
  // It is half the extent along the body's axes. For a cylinder along z: radius, radius, half the height.
  Vector3 half = Vector3::Zero();

  // Returns half the extent, along the axes of the space, of the box around the body.
  Vector3 HalfExtent() const;
};

// Returns nullopt for kinds without a body (lights, sounds, areas of the floor, terrain).
std::optional<Body> BodyOf(const EntityConfiguration& entity);

// Returns whether two bodies interpenetrate by more than a micrometre. The test is exact for boxes and for bodies with
// parallel axes. A tilted cylinder counts as its inscribed box, so reported bodies do overlap.
bool Overlap(const Body& a, const Body& b);

// Finds overlaps among many bodies in constant time for each body, by a uniform grid over the arena.
class BodyGrid
{
public:
  // `cell` is about the size of the most frequent body (m).
  BodyGrid(const Vector3& arena_size, double cell);

  // Adds a body, whose `name` Find returns.
  void Add(const Body& body, std::uint32_t name);
  // Returns the name of a body that overlaps this one; nullopt if none does.
  std::optional<std::uint32_t> Find(const Body& body) const;

private:
  struct Entry
  {
    std::uint32_t body;
    std::int32_t next;
  };
  // Calls `visit` with the cells that the box around a body touches, as ForEachRow of the cells.
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

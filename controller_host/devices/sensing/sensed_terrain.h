// The terrains of an experiment as sensors meet them, in the coordinates of the space. Part of SensorWorld; fixed after
// construction.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "common/math/pose.h"
#include "common/space/terrain/terrain.h"

namespace swarmanoid
{

class CSwarmanoidSpace;

class SensedTerrain
{
public:
  // Reads the files of the terrains. Throws ConfigurationError.
  explicit SensedTerrain(const CSwarmanoidSpace& space);

  bool IsEmpty() const { return terrains_.empty(); }

  template <class Visit>
  void ForEach(Visit&& visit) const
  {
    for (const Placed& placed : terrains_) visit(placed.entity);
  }
  // The part 0..1 of the way from one point to another at which it meets the first terrain for which accept(entity)
  // holds; more than 1 if it meets none.
  template <class Accept>
  double FirstHit(const Vector3& from, const Vector3& to, Accept&& accept) const
  {
    double first = 2;
    for (const Placed& placed : terrains_)
      if (accept(placed.entity)) first = std::min(first, HitOf(placed, from, to));
    return first;
  }
  // Returns the distance (m) from a point down to the highest ground of these terrains, or nullopt if no ground is
  // below it.
  template <class Accept>
  std::optional<double> DepthOfGround(const Vector3& point, Accept&& accept) const
  {
    std::optional<double> depth;
    for (const Placed& placed : terrains_)
    {
      if (!accept(placed.entity)) continue;
      const Vector3 local = placed.to_terrain.Apply(point);
      const std::optional<double> ground = placed.terrain->GroundBelow(local);
      if (ground && (!depth || local.z() - *ground < *depth)) depth = local.z() - *ground;
    }
    return depth;
  }

private:
  struct Placed
  {
    std::uint32_t entity;
    std::shared_ptr<const Terrain> terrain;
    Pose to_terrain;
    Vector3 low, high;  // m, in the frame of the terrain
  };

  static double HitOf(const Placed& placed, const Vector3& from, const Vector3& to);

  std::vector<Placed> terrains_;
};

}  // namespace swarmanoid

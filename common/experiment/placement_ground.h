// The terrains of an experiment as <distribute> meets them: where is ground to stand on, what is inside rock. Read
// while the experiment is, by PlaceDistributed alone.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "common/experiment/body.h"
#include "common/experiment/sections.h"
#include "common/space/terrain/terrain.h"

namespace swarmanoid::placement
{

class Ground
{
public:
  // Reads the files of the terrains; reports those that cannot be read.
  explicit Ground(Reading& reading);

  // The highest ground under a body (m in the space), looked for from a height downwards in the terrains of the engines
  // that the entity is in. nullopt if there is none under some part of the body.
  std::optional<double> HighestUnder(std::size_t entity, const Body& body, double from) const;
  // Whether some of the body of an entity is inside rock: in a two-dimensional engine where the rock cuts its plane.
  bool IsInRock(std::size_t entity, const Body& body) const;

private:
  struct Placed
  {
    std::shared_ptr<const Terrain> terrain;
    Pose pose, to_terrain;
    std::vector<bool> is_walked;    // by entity: some engine has both
    std::vector<bool> is_in_space;  // by entity: some engine of these is no plane
  };
  std::vector<Placed> terrains_;
};

}  // namespace swarmanoid::placement

// A <distribute> asks here where the terrains of the experiment have ground, and what is inside rock. Only
// PlaceDistributed uses it, while the experiment is read.
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
  // Reads the files of the terrains, and reports unreadable ones.
  explicit Ground(Reading& reading);

  // Returns the highest ground under a body (m in the space) in the terrains of the entity's engines, searched from a
  // height downwards. Returns nullopt if no ground is under some part of the body.
  std::optional<double> HighestUnder(std::size_t entity, const Body& body, double from) const;
  // Returns whether some part of an entity's body is inside rock. In a two-dimensional engine, rock counts where it
  // cuts the plane.
  bool IsInRock(std::size_t entity, const Body& body) const;

private:
  struct Placed
  {
    std::shared_ptr<const Terrain> terrain;
    Pose pose, to_terrain;
    std::vector<bool> is_walked;    // by entity: some engine has both the entity and terrain
    std::vector<bool> is_in_space;  // by entity: some of these engines is three-dimensional
  };
  std::vector<Placed> terrains_;
};

}  // namespace swarmanoid::placement

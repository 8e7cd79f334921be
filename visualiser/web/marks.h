// What pages show beside bodies if they ask for it: rays of proximity sensors, the bodies that engines collide, and who
// hears whom by range and bearing. Used by web_render in the thread of Draw and Idle.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/space/collision_models.h"
#include "common/space/query.h"
#include "visualiser/scene/proximity_rays.h"
#include "visualiser/web/page_messages.h"

namespace swarmanoid
{

class MarksWriter
{
public:
  // The space outlives the writer.
  explicit MarksWriter(const CSwarmanoidSpace& space);
  // "marks", for the entities that are asked for. Those that are not in the arena have none.
  std::string Text(const MarksRequest& wanted);

private:
  // A robot with an antenna.
  struct Antenna
  {
    std::uint32_t message = 0;  // slot of the attribute
    double range = 0;           // m, from which it hears; 0: it does not listen
  };

  bool IsPresent(std::uint32_t entity) const;
  Vector3 PlaceOf(std::uint32_t robot) const;

  const CSwarmanoidSpace& space_;
  SpaceQuery query_;
  CollisionModels models_;
  std::vector<std::optional<Antenna>> antennas_;  // by entity
  double longest_range_ = 0;
  std::vector<ProximityRay> rays_;
  std::vector<CollisionBody> bodies_;
};

}  // namespace swarmanoid

// The lengths of the rays of proximity sensors, for all renderers.
#pragma once

#include <vector>

#include "common/space/space_query.h"

namespace swarmanoid
{

struct ProximityRay
{
  Vector3 from, to;  // m, in the space: the whole range
  double hit = 1;    // fraction of the ray up to the first body; 1: it meets none
};

// Replaces `rays` by those of a robot, in the order of ProximityRing::sensors. The result is empty if the robot's kind
// has no ring, or if its controller has no sensor that reads it.
void FindProximityRays(const CSwarmanoidSpace& space, SpaceQuery& query, std::uint32_t robot,
                       std::vector<ProximityRay>& rays);

}  // namespace swarmanoid

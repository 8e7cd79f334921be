// How far the rays of proximity sensors go, for all renderers.
#pragma once

#include <vector>

#include "common/space/query.h"

namespace swarmanoid
{

struct ProximityRay
{
  Vector3 from, to;  // m, in the space: all of its range
  double hit = 1;    // the part of the way after which it meets something; 1: it meets nothing
};

// Replaces `rays` by those of a robot, in the order of ProximityRing::sensors: none if its kind has none, or if its
// controller has no sensor that reads them.
void FindProximityRays(const CSwarmanoidSpace& space, SpaceQuery& query, std::uint32_t robot,
                       std::vector<ProximityRay>& rays);

}  // namespace swarmanoid

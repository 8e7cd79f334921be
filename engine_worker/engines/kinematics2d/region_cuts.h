// Cuts a plane into regions that have about as much work as each other.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/experiment/experiment.h"

namespace swarmanoid::kinematics2d
{

// Returns the region of each block, from the number of bodies in each: rows of `columns` blocks. A grid is cut into
// columns, and each of these into rows. Otherwise each part is cut across its longer side until there are enough.
// Regions for which no block is left have no work.
std::vector<std::uint8_t> CutPlane(std::span<const std::uint32_t> bodies_in_blocks, std::uint32_t columns,
                                   const EngineSplit& split);

}  // namespace swarmanoid::kinematics2d

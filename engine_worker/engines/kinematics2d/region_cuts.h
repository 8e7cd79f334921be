// Where a plane is cut so that its regions have about as much to do as one another.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/experiment/experiment.h"

namespace swarmanoid::kinematics2d
{

// Which region has each block, from how many bodies are in each: rows of `columns` blocks. A grid is cut into columns,
// and each of these into rows; otherwise each part is cut across its longer side until there are enough. Regions for
// which no block is left have nothing to do.
std::vector<std::uint8_t> CutPlane(std::span<const std::uint32_t> bodies_in_blocks, std::uint32_t columns,
                                   const EngineSplit& split);

}  // namespace swarmanoid::kinematics2d

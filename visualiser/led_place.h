// The positions of a robot's LEDs, for renderers that draw them from the row of its kind.
#pragma once

#include <cstddef>

#include "common/space/entity.h"

namespace swarmanoid
{

// Returns the position in metres, in the frame of the robot; its LEDs may turn with a turret. The kind must have more
// LEDs than `led`.
Vector3 LedPlace(const CSwarmanoidSpaceEntity& robot, std::size_t led);

}  // namespace swarmanoid

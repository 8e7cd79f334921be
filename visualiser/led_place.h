// Where the LEDs of a robot are, for renderers that draw them from the row of its kind.
#pragma once

#include <cstddef>

#include "common/space/entity.h"

namespace swarmanoid
{

// In metres, in the frame of the robot; its LEDs may turn with a turret. The kind has LEDs, more than `led`.
Vector3 LedPlace(const CSwarmanoidSpaceEntity& robot, std::size_t led);

}  // namespace swarmanoid

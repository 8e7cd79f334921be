// The classes of entities that users hold, by kind. For space.cpp alone.
#pragma once

#include <memory>

#include "common/space/entity.h"

namespace swarmanoid
{

std::unique_ptr<CSwarmanoidSpaceEntity> MakeEntity(CSwarmanoidSpace& space, std::uint32_t index,
                                                   const EntityConfiguration& configuration, std::uint32_t first_slot);

}  // namespace swarmanoid

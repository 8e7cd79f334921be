// Makes the classes of entities that users hold, by kind. Only the space uses it.
#pragma once

#include <memory>
#include <memory_resource>

#include "common/space/entity.h"

namespace swarmanoid
{

// Ends the lifetime of an entity. Its memory belongs to a resource, which holds all entities in their order.
struct EndEntity
{
  void operator()(CSwarmanoidSpaceEntity* entity) const { std::destroy_at(entity); }
};
using EntityPointer = std::unique_ptr<CSwarmanoidSpaceEntity, EndEntity>;

EntityPointer MakeEntity(std::pmr::memory_resource& memory, CSwarmanoidSpace& space, std::uint32_t index,
                         const EntityConfiguration& configuration, std::uint32_t first_slot);

}  // namespace swarmanoid

// The attributes of each kind of entity: numbers besides the pose that all processes see, such as LEDs, laser and
// gripper. Colours are 0xRRGGBB as a number. The table decides which numbers are sent, covered by the state hash and
// shown by renderers.
#pragma once

#include <span>
#include <string_view>

#include "common/experiment/experiment.h"

namespace swarmanoid
{

// Returns the attributes in the order of the slots.
std::span<const AttributeSpec> AttributesOf(EntityKind kind);
int AttributeCount(EntityKind kind);
// Returns the attribute of that name; nullptr if the kind has none.
const AttributeSpec* FindAttribute(EntityKind kind, std::string_view name);
// Returns the first slot of an attribute within its entity, or -1.
int AttributeOffset(EntityKind kind, std::string_view name);

}  // namespace swarmanoid

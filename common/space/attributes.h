// The attributes of each kind of entity: numbers beside the pose that all processes see. LEDs, laser, gripper and the
// like. Colours are 0xRRGGBB as a number. The table decides what travels, what the state hash covers and what renderers
// show.
#pragma once

#include <span>
#include <string_view>

#include "common/experiment/experiment.h"

namespace swarmanoid
{

struct AttributeSpec
{
  std::string_view name;
  int count;       // slots
  double initial;  // of each slot, unless the kind says otherwise (space.cpp)
  std::string_view description;
};

// In the order of the slots.
std::span<const AttributeSpec> AttributesOf(EntityKind kind);
int AttributeCount(EntityKind kind);
// The first slot of an attribute within its entity, or -1.
int AttributeOffset(EntityKind kind, std::string_view name);

}  // namespace swarmanoid

// The attributes of each kind of entity: numbers beside the pose that all processes see. LEDs, laser, gripper and the
// like. Colours are 0xRRGGBB as a number. The table decides what travels, what the state hash covers and what renderers
// show.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "common/experiment/experiment.h"

namespace swarmanoid
{

// What the number in a slot stands for, and so which numbers may enter the state.
enum class AttributeValue : std::uint8_t
{
  kNumber,   // finite, at most 1e9 from 0
  kColour,   // 0xRRGGBB: a whole number from 0 to 0xffffff
  kSwitch,   // 0 or 1
  kEntity,   // 1 + index of an entity, or 0
  kBytes,    // up to five bytes: a whole number from 0 to 2^40 - 1
  kPresence  // 1 in the arena, 0 not: set by the space server alone
};

struct AttributeSpec
{
  std::string_view name;
  int count;       // slots
  double initial;  // of each slot, unless the kind says otherwise (space.cpp)
  std::string_view description;
  AttributeValue value = AttributeValue::kNumber;
};

// In the order of the slots.
std::span<const AttributeSpec> AttributesOf(EntityKind kind);
int AttributeCount(EntityKind kind);
// The attribute of that name; nullptr where the kind has none.
const AttributeSpec* FindAttribute(EntityKind kind, std::string_view name);
// The first slot of an attribute within its entity, or -1.
int AttributeOffset(EntityKind kind, std::string_view name);

}  // namespace swarmanoid

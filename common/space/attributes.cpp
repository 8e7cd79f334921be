#include "common/space/attributes.h"

#include <array>

namespace swarmanoid
{
namespace
{

// "gripped": 1 + index of the entity that the gripper holds, 0 for none.
constexpr AttributeSpec kMessage{"message", 3, 0,
                                 "range and bearing: 1 while sending, then bytes 0..4 and 5..9 as one number each",
                                 AttributeValue::kBytes};
constexpr std::array kFootbot{
    AttributeSpec{"led", 12, 0, "colours of the LED ring, counter-clockwise from 15 degrees left of the turret's front",
                  AttributeValue::kColour},
    AttributeSpec{"beacon", 1, 0, "colour of the beacon", AttributeValue::kColour},
    AttributeSpec{"gripper_aperture", 1, 0, "aperture of the gripper in radians; 0 is closed"},
    AttributeSpec{"gripped", 1, 0, "1 + index of the entity held by the gripper; 0: none", AttributeValue::kEntity},
    AttributeSpec{"turret_angle", 1, 0, "angle of the turret against the body in radians"},
    kMessage};
constexpr std::array kEyebot{
    AttributeSpec{"led", 16, 0, "colours of the LED ring", AttributeValue::kColour},
    AttributeSpec{"laser", 1, 0, "1 while the laser is on", AttributeValue::kSwitch},
    AttributeSpec{"laser_colour", 1, 0xff0000, "colour of the laser", AttributeValue::kColour},
    AttributeSpec{"laser_pan", 1, 0, "pan of the laser in radians"},
    AttributeSpec{"laser_tilt", 1, 0, "tilt of the laser from straight down in radians"},
    AttributeSpec{"attached", 1, 0, "1 while attached to the ceiling", AttributeValue::kSwitch},
    kMessage};
constexpr std::array kHandbot{
    AttributeSpec{"led", 12, 0, "colours of the LED ring", AttributeValue::kColour},
    AttributeSpec{"beacon", 1, 0, "colour of the beacon", AttributeValue::kColour},
    AttributeSpec{"head_angle", 1, 0, "rotation of the head with the two arms in radians"},
    AttributeSpec{"arm", 2, 0, "apertures of the left and the right arm in radians"},
    AttributeSpec{"wrist", 2, 0, "rotations of the left and the right wrist in radians"},
    AttributeSpec{"hand_aperture", 2, 0, "apertures of the left and the right hand in radians; 0 is closed"},
    AttributeSpec{"gripped", 2, 0, "1 + index of the entity held by the left and the right hand; 0: none",
                  AttributeValue::kEntity},
    AttributeSpec{"rope_attached", 1, 0, "1 while the rope is attached to the ceiling", AttributeValue::kSwitch},
    AttributeSpec{"rope_length", 1, 0, "free length of the rope in metres"},
    kMessage};
constexpr std::array kColoured{AttributeSpec{"colour", 1, 0xc0c0c0, "colour of the surface", AttributeValue::kColour}};
constexpr std::array kLight{AttributeSpec{"colour", 1, 0xffff00, "colour of the light", AttributeValue::kColour},
                            AttributeSpec{"intensity", 1, 1, "intensity of the light"}};

}  // namespace

std::span<const AttributeSpec> AttributesOf(EntityKind kind)
{
  switch (kind)
  {
    case EntityKind::kFootbot:
      return kFootbot;
    case EntityKind::kEyebot:
      return kEyebot;
    case EntityKind::kHandbot:
      return kHandbot;
    case EntityKind::kLightBulb:
      return kLight;
    case EntityKind::kSoundSource:
      return kLight;
    case EntityKind::kTerrain:
    case EntityKind::kHole:
      return {};
    default:
      return kColoured;
  }
}

int AttributeCount(EntityKind kind)
{
  int count = 0;
  for (const AttributeSpec& spec : AttributesOf(kind)) count += spec.count;
  return count;
}

const AttributeSpec* FindAttribute(EntityKind kind, std::string_view name)
{
  for (const AttributeSpec& spec : AttributesOf(kind))
    if (spec.name == name) return &spec;
  return nullptr;
}

int AttributeOffset(EntityKind kind, std::string_view name)
{
  int offset = 0;
  for (const AttributeSpec& spec : AttributesOf(kind))
  {
    if (spec.name == name) return offset;
    offset += spec.count;
  }
  return -1;
}

}  // namespace swarmanoid

// The materials that meshes are made of, and the palette. All renderers take their colours from here.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace swarmanoid
{

using Colour = std::uint32_t;  // 0xRRGGBB

enum class Material : std::uint8_t
{
  kDark,   // plastic of the robots' lower parts
  kShell,  // light plastic
  kMetal,
  kRubber,
  kGlass,  // the tube of the footbot's camera
  kFootbot,
  kEyebot,
  kHandbot,  // accents of the three robots
  kRotor,    // the disc of a turning rotor: see-through
  kRope,
  kTint,     // the colour of the entity
  kPainted,  // the colour of each vertex
  kBeacon,   // the colour of the robot's beacon
  kLed0,     // kLed0 + i: the colour of its LED i, up to 15
  kEnd = kLed0 + 16
};

inline constexpr int kMostLeds = 16;

struct MaterialLook
{
  std::string_view name;
  Colour colour = 0;  // for LEDs and beacons: the colour while they are off
  float gloss = 0;    // 0 dull .. 1 polished
  float opacity = 1;
  bool takes_tint = false;
  bool is_painted = false;  // uses the colours of the vertices
  int led = -1;             // index into the robot's lights: 0..15 LEDs, 16 the beacon; -1: not a light
};

inline constexpr int kLightsPerRobot = 17;
inline constexpr int kBeaconLight = 16;

// Returns the look of a material: colour, gloss and opacity.
const MaterialLook& LookOf(Material material);

inline Material LedMaterial(int led) { return static_cast<Material>(static_cast<int>(Material::kLed0) + led); }

// Returns the paint for a floor, wall, block or prey that a file calls red, green ...: the same hue, less saturated.
Colour Paint(Colour colour);
// Rounds each channel to the nearest of 0, 51, 102 … 255.
Colour OfFewShades(Colour colour);

namespace palette
{
inline constexpr Colour kSky = 0xe9eef4;
inline constexpr Colour kFloor = 0xdcdfe2;
inline constexpr Colour kFloorLine = 0xc3c8ce;
inline constexpr Colour kOutside = 0xe4e8ec;  // the ground around the arena
inline constexpr Colour kWall = 0xeae6de;
inline constexpr Colour kTerrain = 0xb9ae9a;
inline constexpr Colour kHole = 0x1c2026;
inline constexpr Colour kSelection = 0xf2a33a;
inline constexpr Colour kCollision = 0x1f8f5f;
inline constexpr Colour kRayFree = 0x6fa8dc;
inline constexpr Colour kRayHit = 0xd9483b;
inline constexpr Colour kLabel = 0x20262e;
}  // namespace palette

}  // namespace swarmanoid

#include "visualiser/scene/material.h"

#include <algorithm>
#include <cmath>

namespace swarmanoid
{
namespace
{

constexpr std::array<std::string_view, kMostLeds> kLedNames{"led0",  "led1",  "led2",  "led3", "led4",  "led5",
                                                            "led6",  "led7",  "led8",  "led9", "led10", "led11",
                                                            "led12", "led13", "led14", "led15"};

constexpr auto kLooks = []
{
  std::array<MaterialLook, static_cast<std::size_t>(Material::kEnd)> looks{};
  const auto set = [&looks](Material material, const MaterialLook& look)
  { looks[static_cast<std::size_t>(material)] = look; };
  set(Material::kDark, {"dark", 0x353b44, 0.25F});
  set(Material::kShell, {"shell", 0xe3e6ea, 0.35F});
  set(Material::kMetal, {"metal", 0x9aa3ad, 0.7F});
  set(Material::kRubber, {"rubber", 0x23272d, 0.05F});
  set(Material::kGlass, {"glass", 0xb9cbd6, 1.0F});
  set(Material::kFootbot, {"footbot", 0x3b78b0, 0.3F});
  set(Material::kEyebot, {"eyebot", 0x3f9a86, 0.3F});
  set(Material::kHandbot, {"handbot", 0xd98736, 0.3F});
  set(Material::kRotor, {"rotor", 0x6c7783, 0.0F, 0.28F});
  set(Material::kRope, {"rope", 0x7d6f5a, 0.0F});
  set(Material::kTint, {"tint", 0xffffff, 0.15F, 1, true});
  set(Material::kPainted, {"painted", 0xffffff, 0.15F, 1, false, true});
  set(Material::kBeacon, {"beacon", 0x59616c, 0.4F, 1, false, false, kBeaconLight});
  for (int i = 0; i < kMostLeds; ++i)
    set(static_cast<Material>(static_cast<int>(Material::kLed0) + i),
        {kLedNames[static_cast<std::size_t>(i)], 0x59616c, 0.4F, 1, false, false, i});
  return looks;
}();

}  // namespace

const MaterialLook& LookOf(Material material) { return kLooks[static_cast<std::size_t>(material)]; }

Colour Paint(Colour colour)
{
  const std::array channels{static_cast<double>((colour >> 16) & 0xff), static_cast<double>((colour >> 8) & 0xff),
                            static_cast<double>(colour & 0xff)};
  const double grey = 0.3 * channels[0] + 0.59 * channels[1] + 0.11 * channels[2];
  Colour paint = 0;
  for (const double channel : channels)
  {
    const double calm = 0.52 * channel + 0.26 * grey + 0.22 * 205;
    paint = paint << 8 | static_cast<Colour>(std::lround(std::clamp(calm, 0.0, 255.0)));
  }
  return paint;
}

Colour OfFewShades(Colour colour)
{
  Colour few = 0;
  for (const unsigned shift : {16U, 8U, 0U}) few |= ((colour >> shift & 0xff) + 25) / 51 * 51 << shift;
  return few;
}

}  // namespace swarmanoid

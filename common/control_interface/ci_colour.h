// Colours in the form in which controllers set and read them: 0xRRGGBB. 0 is off.
#pragma once

#include <algorithm>
#include <cstdint>

namespace swarmanoid
{

struct CCI_Colour
{
  static constexpr std::uint32_t BLACK = 0x000000;
  static constexpr std::uint32_t RED = 0xff0000;
  static constexpr std::uint32_t GREEN = 0x00ff00;
  static constexpr std::uint32_t BLUE = 0x0000ff;
  static constexpr std::uint32_t YELLOW = 0xffff00;
  static constexpr std::uint32_t CYAN = 0x00ffff;
  static constexpr std::uint32_t MAGENTA = 0xff00ff;
  static constexpr std::uint32_t WHITE = 0xffffff;

  // Returns the colour of the eight above that is nearest in hue: each channel above half of the strongest one is on.
  // Colours whose channels are all below 32 are black.
  static constexpr std::uint32_t Nearest(std::uint32_t colour)
  {
    const std::uint32_t red = colour >> 16 & 0xff;
    const std::uint32_t green = colour >> 8 & 0xff;
    const std::uint32_t blue = colour & 0xff;
    const std::uint32_t strongest = red > green ? (red > blue ? red : blue) : (green > blue ? green : blue);
    if (strongest < 32) return BLACK;
    return (2 * red > strongest ? RED : 0) | (2 * green > strongest ? GREEN : 0) | (2 * blue > strongest ? BLUE : 0);
  }

  // Returns the colour of a column of numbers, cut to BLACK..WHITE.
  static std::uint32_t FromNumber(double number)
  {
    return static_cast<std::uint32_t>(std::clamp(number, double{BLACK}, double{WHITE}));
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_Colour;

// Tests the palette of GIF films: which colours it keeps, and when it chooses others.
#include "visualiser/scene/colour_palette.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <functional>

namespace swarmanoid
{
namespace
{

using Rgb = std::array<std::uint8_t, 3>;

Picture PictureOf(int width, int height, const std::function<Rgb(int, int)>& colour_at)
{
  Picture picture{width, height, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
    {
      const Rgb colour = colour_at(x, y);
      picture.pixels.insert(picture.pixels.end(), {colour[0], colour[1], colour[2], 0});
    }
  return picture;
}

// Returns the sum of the differences of red, green and blue between a colour and the one that stands for it.
int Error(const ColourPalette& palette, const Rgb& colour)
{
  const std::uint32_t shown = palette.Colours()[palette.Number(colour[0], colour[1], colour[2])];
  return std::abs(colour[0] - static_cast<int>(shown >> 16U & 255U)) +
         std::abs(colour[1] - static_cast<int>(shown >> 8U & 255U)) +
         std::abs(colour[2] - static_cast<int>(shown & 255U));
}

TEST(ColourPalette, APictureOfOneColourKeepsIt)
{
  ColourPalette palette;
  palette.Suit(PictureOf(4, 4, [](int, int) { return Rgb{17, 130, 201}; }));
  EXPECT_EQ(Error(palette, {17, 130, 201}), 0);
}

TEST(ColourPalette, FewColoursAreKeptExactly)
{
  ColourPalette palette;
  const auto colour = [](int x, int) { return Rgb{static_cast<std::uint8_t>(x * 8), 40, 200}; };
  palette.Suit(PictureOf(32, 2, colour));
  for (int x = 0; x < 32; ++x) EXPECT_EQ(Error(palette, colour(x, 0)), 0) << x;
}

TEST(ColourPalette, ThousandsOfColoursHaveNearOnes)
{
  ColourPalette palette;
  const auto colour = [](int x, int y) {
    return Rgb{static_cast<std::uint8_t>(4 * x), static_cast<std::uint8_t>(4 * y), 128};
  };
  palette.Suit(PictureOf(64, 64, colour));
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) EXPECT_LE(Error(palette, colour(x, y)), 40) << x << " " << y;
}

TEST(ColourPalette, ALargeAreaIsNotShiftedByManySmallOnes)
{
  ColourPalette palette;
  const auto colour = [](int x, int y) {
    return y < 60 ? Rgb{221, 224, 227} : Rgb{static_cast<std::uint8_t>(x * 4), 90, static_cast<std::uint8_t>(y)};
  };
  palette.Suit(PictureOf(64, 64, colour));
  EXPECT_LE(Error(palette, {221, 224, 227}), 3);
}

TEST(ColourPalette, ItStaysWhileFewPixelsChange)
{
  ColourPalette palette;
  const auto floor = [](int, int) { return Rgb{220, 220, 220}; };
  palette.Suit(PictureOf(100, 100, floor));
  const auto before = palette.Colours();
  // The red LEDs of a robot, 20 of 10,000 pixels, have a colour that was spread.
  palette.Suit(PictureOf(100, 100, [&](int x, int y) { return y == 0 && x < 20 ? Rgb{255, 0, 0} : floor(x, y); }));
  EXPECT_EQ(palette.Colours(), before);
  EXPECT_LE(Error(palette, {255, 0, 0}), 2);
}

TEST(ColourPalette, ItIsChosenAgainForAnotherPicture)
{
  ColourPalette palette;
  palette.Suit(PictureOf(100, 100, [](int, int) { return Rgb{220, 220, 220}; }));
  palette.Suit(PictureOf(100, 100, [](int x, int) { return x < 50 ? Rgb{60, 170, 20} : Rgb{30, 60, 190}; }));
  EXPECT_EQ(Error(palette, {60, 170, 20}), 0);
  EXPECT_EQ(Error(palette, {30, 60, 190}), 0);
}

}  // namespace
}  // namespace swarmanoid

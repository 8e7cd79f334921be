// ColourPalette: at most 256 colours that stand for those of a picture, for films in the format GIF.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "visualiser/scene/drawn_picture.h"

namespace swarmanoid
{

class ColourPalette
{
public:
  ColourPalette();

  // Chooses the colours for a picture. They stay as they are while they suit most of its pixels, since only pictures
  // with the colours of the first one can leave out what has not changed.
  void Suit(const Picture& picture);

  // Returns the number of the colour for a pixel.
  std::uint8_t Number(std::uint8_t red, std::uint8_t green, std::uint8_t blue) const
  {
    return numbers_[Bin(red, green, blue)];
  }
  // Returns the colours as 0xffRRGGBB.
  const std::array<std::uint32_t, 256>& Colours() const { return colours_; }

private:
  static constexpr unsigned kBits = 5;  // of each channel: colours are counted in bins
  static constexpr std::size_t kBins = std::size_t{1} << (3 * kBits);

  static std::size_t Bin(unsigned red, unsigned green, unsigned blue)
  {
    return (red >> (8 - kBits)) << (2 * kBits) | (green >> (8 - kBits)) << kBits | blue >> (8 - kBits);
  }

  // The colours of a bin in a picture: their number, and the sums of red, green and blue.
  struct Count
  {
    std::uint64_t pixels = 0;
    std::array<std::uint64_t, 3> sums{};
    std::array<int, 3> Mean() const;
  };

  // Fills numbers_ for the used bins. Returns the number of pixels that are far from their colour.
  std::uint64_t Assign();
  void Choose();

  std::vector<Count> counts_;
  std::vector<std::uint32_t> used_;  // bins
  std::vector<std::uint8_t> numbers_;
  std::array<std::uint32_t, 256> colours_{};
  std::optional<std::uint64_t> far_;  // the result of Assign after the last choice
};

}  // namespace swarmanoid

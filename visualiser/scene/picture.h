// A picture of what was drawn, and its PNG file.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace swarmanoid
{

struct Picture
{
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> pixels;  // red, green, blue, unused; the upper row first

  const std::uint8_t* At(int x, int y) const
  {
    return &pixels[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x))];
  }
};

// Fast rather than small: about 12 ms for 1024 by 768. Whoever reads meanwhile gets the picture before, whole. Throws
// std::runtime_error, naming the file.
void WritePng(const Picture& picture, const std::string& path);

}  // namespace swarmanoid

// A drawn picture, and its PNG file.
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
  std::vector<std::uint8_t> pixels;  // red, green, blue, unused; from the top row

  const std::uint8_t* At(int x, int y) const
  {
    return &pixels[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x))];
  }
};

// Writes the picture, with speed rather than small size: about 12 ms for 1024 by 768. A reader meanwhile gets the whole
// previous picture. Throws std::runtime_error with the name of the file.
void WritePng(const Picture& picture, const std::string& path);

}  // namespace swarmanoid

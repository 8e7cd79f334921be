// Reads the pixels of a file: greys of a PNG for height maps (HeightTerrain), colours of a PNG or JPEG for pictures on
// the floor (FloorPicture). In any process.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace swarmanoid
{

struct GreyPicture
{
  std::vector<double> values;  // 0 black … 1 white, rows from the top
  int columns = 0;
  int rows = 0;
};

struct ColourPicture
{
  std::vector<std::uint32_t> pixels;  // 0xRRGGBB, rows from the top
  int columns = 0;
  int rows = 0;
};

// Returns the samples unchanged, of 1 to 16 bits: a grey of half the range is 0.5, for any gamma that the file states.
// Colours count as 0.299 R + 0.587 G + 0.114 B; transparency is ignored. Throws std::runtime_error, which names the
// file, if it cannot be read.
GreyPicture ReadGreyPicture(const std::string& path);
// Reads a PNG or a JPEG; 16-bit samples keep their upper 8 bits. Throws as the function above.
ColourPicture ReadColourPicture(const std::string& path);

}  // namespace swarmanoid

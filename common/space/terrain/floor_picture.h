// A picture on a patch of the floor, from a PNG or JPEG. One read-only object for each file; ground sensors and
// renderers ask it in the frame of the patch.
//
//   <ground_patch id="floor" picture="floor.png" size="4, 3"><position>2,1.5,0</position>…</ground_patch>
#pragma once

#include <memory>
#include <string>

#include "common/experiment/experiment.h"
#include "common/space/terrain/png_picture.h"

namespace swarmanoid
{

// Returns one colour tinted by another: each of red, green and blue is the product, with 255 as 1, rounded.
std::uint32_t Tinted(std::uint32_t colour, std::uint32_t tint);

class FloorPicture
{
public:
  explicit FloorPicture(ColourPicture picture) : picture_(std::move(picture)) {}

  int Columns() const { return picture_.columns; }
  int Rows() const { return picture_.rows; }
  // Returns 0xRRGGBB. Rows count from the top, which is the edge at the largest y.
  std::uint32_t Pixel(int column, int row) const
  {
    return picture_.pixels[static_cast<std::size_t>(row) * static_cast<std::size_t>(picture_.columns) +
                           static_cast<std::size_t>(column)];
  }
  // Returns the colour of the pixel at a point. `across` and `up` are 0 … 1 from the patch's left lower corner, and are
  // clamped to that.
  std::uint32_t ColourAt(double across, double up) const;

private:
  ColourPicture picture_;
};

// Returns the picture of a patch, or nullptr for a patch without one. Each file is read once in a process. Throws
// ConfigurationError.
std::shared_ptr<const FloorPicture> LoadFloorPicture(const EntityConfiguration& configuration,
                                                     const std::string& experiment_folder);

}  // namespace swarmanoid

// Pictures of the floor for renderers: few colours and a limited number of pixels.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/space/terrain/floor_picture.h"
#include "visualiser/scene/mesh.h"

namespace swarmanoid
{

struct PaintedFloor
{
  int columns = 0;
  int rows = 0;
  std::vector<Colour> palette;       // at most 256
  std::vector<std::uint8_t> pixels;  // into the palette, rows from the top
};

// Returns every n-th pixel along both edges, so that neither edge exceeds `most`. With more than 256 colours, each of
// red, green and blue has six shades.
PaintedFloor Simplified(const FloorPicture& picture, int most);

// Returns a flat model of side 1 in the plane z = 0 for each colour of the palette, with Material::kTint.
std::vector<Model> FloorModels(const PaintedFloor& floor, const std::string& name);

}  // namespace swarmanoid

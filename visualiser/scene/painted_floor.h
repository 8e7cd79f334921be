// Pictures of the floor as renderers draw them: few colours and not too many pixels.
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

// Every n-th pixel along both edges, n such that neither has more than `most`; beyond 256 colours, six shades each of
// red, green and blue.
PaintedFloor Simplified(const FloorPicture& picture, int most);

// A flat model of side 1 in the plane z = 0 for each colour of the palette, Material::kTint.
std::vector<Model> FloorModels(const PaintedFloor& floor, const std::string& name);

}  // namespace swarmanoid

// Problem: draw a picture on the floor with renderers that have no textures.
//
// Method: the picture is thinned out to a limited number of pixels and at most kMostColours colours. Each colour
// becomes one flat model. Runs of a colour in a row are joined with equal runs of the row above to one rectangle, which
// keeps the number of faces small for drawn pictures.
//
// Invariant: the rectangles of all colours cover each pixel once.
#include "visualiser/scene/painted_floor.h"

#include <algorithm>
#include <map>

#include "visualiser/scene/mesh_builder.h"

namespace swarmanoid
{
namespace
{

constexpr std::size_t kMostColours = 256;

// A rectangle of pixels with one colour.
struct Block
{
  int left, right, top, bottom;
  std::uint8_t colour;
};

// Joins equal runs of consecutive rows into blocks.
std::vector<Block> BlocksOf(const PaintedFloor& floor)
{
  std::vector<Block> done, open, next;
  for (int row = 0; row <= floor.rows; ++row)
  {
    next.clear();
    std::size_t above = 0;
    for (int left = 0; row < floor.rows && left < floor.columns;)
    {
      const auto* const pixels = floor.pixels.data() + static_cast<std::ptrdiff_t>(row) * floor.columns;
      int right = left;
      while (right < floor.columns && pixels[right] == pixels[left]) ++right;
      Block block{left, right, row, row + 1, pixels[left]};
      while (above < open.size() && open[above].left < left) done.push_back(open[above++]);
      if (above < open.size() && open[above].left == left && open[above].right == right &&
          open[above].colour == block.colour)
        block.top = open[above++].top;
      next.push_back(block);
      left = right;
    }
    done.insert(done.end(), open.begin() + static_cast<std::ptrdiff_t>(above), open.end());
    open.swap(next);
  }
  return done;
}

}  // namespace

PaintedFloor Simplified(const FloorPicture& picture, int most)
{
  const int step = (std::max(picture.Columns(), picture.Rows()) + most - 1) / most;
  PaintedFloor floor;
  floor.columns = (picture.Columns() + step - 1) / step;
  floor.rows = (picture.Rows() + step - 1) / step;
  const auto fill = [&](auto shade)
  {
    std::map<Colour, std::uint8_t> numbers;
    floor.palette.clear();
    floor.pixels.clear();
    for (int row = 0; row < floor.rows; ++row)
      for (int column = 0; column < floor.columns; ++column)
      {
        const Colour colour = shade(picture.Pixel(column * step, row * step));
        const auto [number, is_new] = numbers.emplace(colour, static_cast<std::uint8_t>(floor.palette.size()));
        if (is_new && floor.palette.size() == kMostColours) return false;
        if (is_new) floor.palette.push_back(colour);
        floor.pixels.push_back(number->second);
      }
    return true;
  };
  if (!fill([](Colour colour) { return colour; })) fill(OfFewShades);
  return floor;
}

std::vector<Model> FloorModels(const PaintedFloor& floor, const std::string& name)
{
  std::vector<MeshBuilder> builders(floor.palette.size(), MeshBuilder(4));
  const auto x = [&](int column) { return static_cast<float>(column) / static_cast<float>(floor.columns) - 0.5F; };
  const auto y = [&](int row) { return 0.5F - static_cast<float>(row) / static_cast<float>(floor.rows); };
  for (const Block& block : BlocksOf(floor))
    builders[block.colour].Face({{x(block.left), y(block.bottom), 0},
                                 {x(block.right), y(block.bottom), 0},
                                 {x(block.right), y(block.top), 0},
                                 {x(block.left), y(block.top), 0}},
                                Material::kTint);
  std::vector<Model> models;
  for (std::size_t k = 0; k < builders.size(); ++k)
  {
    Model& model = models.emplace_back();
    model.name = name + "_" + std::to_string(k);
    model.levels.fill(builders[k].Take());
    Measure(model);
  }
  return models;
}

}  // namespace swarmanoid

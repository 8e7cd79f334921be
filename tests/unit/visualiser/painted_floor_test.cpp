// Pictures of the floor as renderers draw them, pixel by pixel against the picture.
#include <gtest/gtest.h>

#include "common/math/random.h"
#include "visualiser/scene/painted_floor.h"

namespace swarmanoid
{
namespace
{

FloorPicture Random(int columns, int rows, int colours)
{
  RandomStream random(1, 2, 3, 4);
  ColourPicture picture;
  picture.columns = columns;
  picture.rows = rows;
  for (int k = 0; k < columns * rows; ++k)
    picture.pixels.push_back(static_cast<std::uint32_t>(random.Uniform(0, colours)) * 0x030507);
  return FloorPicture(std::move(picture));
}

// The models under the middle of each pixel: one, that of its colour.
void ExpectCovered(const FloorPicture& picture)
{
  const PaintedFloor floor = Simplified(picture, 512);
  ASSERT_EQ(floor.columns, picture.Columns());
  ASSERT_EQ(floor.rows, picture.Rows());
  const std::vector<Model> models = FloorModels(floor, "floor");
  ASSERT_EQ(models.size(), floor.palette.size());
  std::vector<int> cover(floor.pixels.size(), 0);
  double area = 0;
  for (std::size_t m = 0; m < models.size(); ++m)
  {
    const Mesh& mesh = models[m].levels[0];
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
    {
      Eigen::Vector2f at[3];
      for (std::size_t k = 0; k < 3; ++k) at[k] = mesh.vertices[mesh.indices[i + k]].position.head<2>();
      const auto cross = [](const Eigen::Vector2f& a, const Eigen::Vector2f& b)
      { return a.x() * b.y() - a.y() * b.x(); };
      area += cross(at[1] - at[0], at[2] - at[0]) / 2;
      for (int row = 0; row < floor.rows; ++row)
        for (int column = 0; column < floor.columns; ++column)
        {
          // The point is off the diagonals on which triangles meet.
          const Eigen::Vector2f middle((static_cast<float>(column) + 0.51F) / static_cast<float>(floor.columns) - 0.5F,
                                       0.5F - (static_cast<float>(row) + 0.503F) / static_cast<float>(floor.rows));
          bool inside = true;
          for (std::size_t k = 0; k < 3; ++k) inside = inside && cross(at[(k + 1) % 3] - at[k], middle - at[k]) > 0;
          if (!inside) continue;
          ++cover[static_cast<std::size_t>(row * floor.columns + column)];
          EXPECT_EQ(floor.palette[m], picture.Pixel(column, row)) << column << ", " << row;
        }
    }
  }
  for (const int models_here : cover) EXPECT_EQ(models_here, 1);
  EXPECT_NEAR(area, 1, 1e-4);
}

TEST(PaintedFloor, EachPixelIsDrawnOnceInItsColour)
{
  ExpectCovered(Random(17, 11, 2));
  ExpectCovered(Random(9, 23, 40));
  ExpectCovered(Random(30, 20, 1));
}

TEST(PaintedFloor, EqualPixelsAreDrawnTogether)
{
  const std::vector<Model> models = FloorModels(Simplified(Random(30, 20, 1), 512), "floor");
  ASSERT_EQ(models.size(), 1U);
  EXPECT_EQ(models[0].levels[0].Triangles(), 2U);
}

TEST(PaintedFloor, ManyPixelsAndColoursAreReduced)
{
  const FloorPicture picture = Random(700, 300, 30'000);
  const PaintedFloor floor = Simplified(picture, 256);
  EXPECT_EQ(floor.columns, 234);  // each third one
  EXPECT_EQ(floor.rows, 100);
  EXPECT_LE(floor.palette.size(), 216U);
  for (int row = 0; row < floor.rows; ++row)
    for (int column = 0; column < floor.columns; ++column)
    {
      const Colour drawn = floor.palette[floor.pixels[static_cast<std::size_t>(row * floor.columns + column)]];
      const Colour painted = picture.Pixel(3 * column, 3 * row);
      for (const unsigned shift : {16U, 8U, 0U})
        EXPECT_LE(std::abs(static_cast<int>(drawn >> shift & 0xff) - static_cast<int>(painted >> shift & 0xff)), 26);
    }
}

}  // namespace
}  // namespace swarmanoid

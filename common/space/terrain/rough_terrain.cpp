// The ground is the sum of three waves of value noise: random heights at the points of a lattice, with smooth
// interpolation between them. Each wave has half the length and half the height of the one before. Round holes are cut
// into it, and the columns of cells are filled up to the surface.
//
// Invariants: all random numbers come from streams of the seed (common/math/random.h), one for each wave and one for
// the holes. So the number of holes does not change the bumps. A hole never goes through the ground.
#include "common/space/terrain/rough_terrain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "common/math/random.h"
#include "common/space/terrain/octomap_file.h"

namespace swarmanoid
{
namespace
{

constexpr double kMostColumns = 1e6;
constexpr double kMostLayers = 200;
constexpr std::uint64_t kHoles = StreamName("holes of a terrain");
constexpr std::uint64_t kBumps = StreamName("bumps of a terrain");
// The bumps have these wave lengths (m); each wave is half as high as the one before.
constexpr std::array kWaves{0.5, 0.25, 0.125};
constexpr double kNarrowestHole_m = 0.12;
constexpr double kWidestHole_m = 0.2;

struct Hole
{
  double x, y, radius;
};

void Check(const RoughTerrain& terrain)
{
  const auto refuse = [](const std::string& text) { throw std::invalid_argument(text); };
  if (!(terrain.resolution > 0)) refuse("the resolution must be above 0 m");
  if (!(terrain.roughness >= 0)) refuse("the roughness must be 0 m or more");
  if (!(terrain.depth >= 0)) refuse("the depth of the holes must be 0 m or more");
  if (terrain.holes < 0) refuse("the number of holes must be 0 or more");
  if (!(terrain.size.minCoeff() >= terrain.resolution)) refuse("the size must be at least one cell in x and y");
  const double columns = terrain.size.x() * terrain.size.y() / (terrain.resolution * terrain.resolution);
  const double layers = (terrain.roughness + terrain.depth) / terrain.resolution;
  if (!(columns <= kMostColumns) || !(layers <= kMostLayers))
    refuse(
        "that is too many cells: up to a million columns (size / resolution, squared) and 200 layers are made; take a "
        "larger --resolution or a smaller --size");
}

// Returns a smooth surface between 0 and 1 through random heights at the points of a lattice.
class Bumps
{
public:
  Bumps(double spacing, const Vector2& size, std::uint64_t seed, std::uint32_t wave)
      : spacing_(spacing), columns_(static_cast<int>(size.x() / spacing) + 2)
  {
    const int rows = static_cast<int>(size.y() / spacing) + 2;
    RandomStream random(seed, kBumps, wave, 0);
    for (int k = 0; k < columns_ * rows; ++k) heights_.push_back(random.Uniform(0, 1));
  }

  double At(double x, double y) const
  {
    const int column = static_cast<int>(x / spacing_);
    const int row = static_cast<int>(y / spacing_);
    const double u = Eased(x / spacing_ - column);
    const double v = Eased(y / spacing_ - row);
    const auto height = [&](int dx, int dy)
    { return heights_[static_cast<std::size_t>((row + dy) * columns_ + column + dx)]; };
    return (1 - v) * ((1 - u) * height(0, 0) + u * height(1, 0)) + v * ((1 - u) * height(0, 1) + u * height(1, 1));
  }

private:
  static double Eased(double t) { return t * t * (3 - 2 * t); }

  double spacing_;
  int columns_;
  std::vector<double> heights_;
};

std::vector<Hole> HolesOf(const RoughTerrain& terrain)
{
  RandomStream random(terrain.seed, kHoles, 0, 0);
  std::vector<Hole> holes;
  for (int k = 0; k < terrain.holes; ++k)
  {
    Hole& hole = holes.emplace_back();
    hole.x = random.Uniform(0, terrain.size.x());
    hole.y = random.Uniform(0, terrain.size.y());
    hole.radius = random.Uniform(kNarrowestHole_m, kWidestHole_m);
  }
  return holes;
}

}  // namespace

void WriteRoughTerrain(const std::string& path, const RoughTerrain& terrain)
{
  Check(terrain);
  const double cell = terrain.resolution;
  const int columns = static_cast<int>(terrain.size.x() / cell + 1e-9);
  const int rows = static_cast<int>(terrain.size.y() / cell + 1e-9);

  std::vector<double> heights(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), 0.0);
  double weight = 1;
  for (std::uint32_t wave = 0; wave < kWaves.size(); ++wave, weight /= 2)
  {
    const Bumps bumps(kWaves[wave], terrain.size, terrain.seed, wave);
    for (int y = 0; y < rows; ++y)
      for (int x = 0; x < columns; ++x)
        heights[static_cast<std::size_t>(y * columns + x)] += weight * bumps.At((x + 0.5) * cell, (y + 0.5) * cell);
  }
  const auto [lowest, highest] = std::minmax_element(heights.begin(), heights.end());
  const double low = *lowest;
  const double scale = *highest > low ? terrain.roughness / (*highest - low) : 0;

  // The lowest ground is at 0. Below it the map has one layer more than the holes are deep.
  const int bottom = -static_cast<int>(std::ceil(terrain.depth / cell - 1e-9)) - 1;
  const std::vector<Hole> holes = HolesOf(terrain);
  octomap::OcTree map(cell);
  const octomap::OcTreeKey origin = map.coordToKey(0.5 * cell, 0.5 * cell, 0.5 * cell);
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x)
    {
      const bool in_hole = std::any_of(holes.begin(), holes.end(),
                                       [&](const Hole& hole)
                                       {
                                         const double dx = (x + 0.5) * cell - hole.x;
                                         const double dy = (y + 0.5) * cell - hole.y;
                                         return dx * dx + dy * dy < hole.radius * hole.radius;
                                       });
      const double height = (heights[static_cast<std::size_t>(y * columns + x)] - low) * scale;
      const int top = in_hole ? bottom + 1 : static_cast<int>(height / cell + 0.5);
      for (int z = bottom; z < top; ++z)
        map.setNodeValue(octomap::OcTreeKey(static_cast<octomap::key_type>(origin[0] + x),
                                            static_cast<octomap::key_type>(origin[1] + y),
                                            static_cast<octomap::key_type>(origin[2] + z)),
                         map.getClampingThresMaxLog(), true);
    }
  map.updateInnerOccupancy();
  map.toMaxLikelihood();
  map.prune();
  WriteOctoMap(path, map);
}

}  // namespace swarmanoid

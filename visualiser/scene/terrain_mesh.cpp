// Problem: show a terrain of up to millions of cells at three levels of detail.
//
// Method: a height map becomes a grid of quadrangles with smooth normals and a skirt at its rim, thinned out by 1, 2 or
// 4. Cells of a map become the faces between occupied and free cubes of 1, 2 or 4 cells; equal faces in a row are
// merged to one.
//
// Invariant: a cube is occupied if any of its cells is, so thin walls stay visible from afar.
#include <algorithm>

#include "visualiser/scene/mesh_builder.h"
#include "visualiser/scene/meshes.h"

namespace swarmanoid
{
namespace
{

// Returns one quadrangle a cell with the normals of the surface, so that it looks smooth, and a skirt down to the
// ground.
Mesh HeightMesh(const HeightTerrain& terrain, int step)
{
  Mesh mesh;
  const Vector3 size = terrain.High();
  const int columns = terrain.Columns();
  const int rows = terrain.Rows();
  const auto cell_x = static_cast<float>(size.x() / (columns - 1));
  const auto cell_y = static_cast<float>(size.y() / (rows - 1));
  const auto height = [&](int column, int row)
  { return static_cast<float>(terrain.Height(std::clamp(column, 0, columns - 1), std::clamp(row, 0, rows - 1))); };
  std::vector<int> xs, ys;
  for (int x = 0; x < columns - 1; x += step) xs.push_back(x);
  for (int y = 0; y < rows - 1; y += step) ys.push_back(y);
  xs.push_back(columns - 1);
  ys.push_back(rows - 1);

  for (const int y : ys)
    for (const int x : xs)
    {
      const Eigen::Vector3f slope((height(x - 1, y) - height(x + 1, y)) / (2 * cell_x),
                                  (height(x, y - 1) - height(x, y + 1)) / (2 * cell_y), 1);
      mesh.vertices.push_back({{static_cast<float>(x) * cell_x, static_cast<float>(y) * cell_y, height(x, y)},
                               slope.normalized(),
                               Material::kTint,
                               1});
    }
  const auto at = [&](std::size_t x, std::size_t y) { return static_cast<std::uint32_t>(y * xs.size() + x); };
  for (std::size_t y = 0; y + 1 < ys.size(); ++y)
    for (std::size_t x = 0; x + 1 < xs.size(); ++x)
      mesh.indices.insert(mesh.indices.end(), {at(x, y), at(x + 1, y), at(x + 1, y + 1),  //
                                               at(x, y), at(x + 1, y + 1), at(x, y + 1)});

  const auto skirt = [&](std::uint32_t from, std::uint32_t to, const Eigen::Vector3f& normal)
  {
    const auto base = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const std::uint32_t corner : {from, to})
      for (const bool top : {false, true})
      {
        Eigen::Vector3f position = mesh.vertices[corner].position;
        if (!top) position.z() = std::min(0.0F, static_cast<float>(terrain.Low().z()));
        mesh.vertices.push_back({position, normal, Material::kTint, 0.9F});
      }
    mesh.indices.insert(mesh.indices.end(), {base, base + 2, base + 3, base, base + 3, base + 1});
  };
  const std::size_t last_x = xs.size() - 1;
  const std::size_t last_y = ys.size() - 1;
  for (std::size_t x = 0; x < last_x; ++x)
  {
    skirt(at(x, 0), at(x + 1, 0), -Eigen::Vector3f::UnitY());
    skirt(at(x + 1, last_y), at(x, last_y), Eigen::Vector3f::UnitY());
  }
  for (std::size_t y = 0; y < last_y; ++y)
  {
    skirt(at(last_x, y), at(last_x, y + 1), Eigen::Vector3f::UnitX());
    skirt(at(0, y + 1), at(0, y), -Eigen::Vector3f::UnitX());
  }
  return mesh;
}

// Cubes of `step` cells of a map on each side. A cube is occupied if any of its cells is.
class Cubes
{
public:
  Cubes(const VoxelTerrain& terrain, int step)
      : count_{(terrain.CellsX() + step - 1) / step, (terrain.CellsY() + step - 1) / step,
               (terrain.CellsZ() + step - 1) / step},
        occupied_(static_cast<std::size_t>(count_[0]) * static_cast<std::size_t>(count_[1]) *
                  static_cast<std::size_t>(count_[2]))
  {
    for (int z = 0; z < terrain.CellsZ(); ++z)
      for (int y = 0; y < terrain.CellsY(); ++y)
        for (int x = 0; x < terrain.CellsX(); ++x)
          if (terrain.IsOccupied(x, y, z)) occupied_[Index({x / step, y / step, z / step})] = true;
  }

  const std::array<int, 3>& Count() const { return count_; }
  // Returns false outside the map.
  bool IsOccupied(const std::array<int, 3>& at) const
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (at[axis] < 0 || at[axis] >= count_[axis]) return false;
    return occupied_[Index(at)];
  }

private:
  std::size_t Index(const std::array<int, 3>& at) const
  {
    return (static_cast<std::size_t>(at[2]) * static_cast<std::size_t>(count_[1]) + static_cast<std::size_t>(at[1])) *
               static_cast<std::size_t>(count_[0]) +
           static_cast<std::size_t>(at[0]);
  }

  std::array<int, 3> count_;
  std::vector<bool> occupied_;
};

// Returns the faces between occupied and free cubes. Runs of equal faces along one axis are merged.
Mesh VoxelMesh(const VoxelTerrain& terrain, int step)
{
  MeshBuilder builder(4);
  const Cubes cubes(terrain, step);
  const std::array<int, 3>& cells = cubes.Count();
  const auto cell = static_cast<float>(terrain.CellSize() * step);
  const Eigen::Vector3f low = terrain.Low().cast<float>();
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const std::size_t run = axis == 0 ? 1 : 0;
    const std::size_t other = 3 - axis - run;
    for (const int side : {-1, 1})
    {
      const auto exposed = [&](std::array<int, 3> at)
      {
        if (!cubes.IsOccupied(at)) return false;
        at[axis] += side;
        return !cubes.IsOccupied(at);
      };
      std::array<int, 3> at{};
      for (at[axis] = 0; at[axis] < cells[axis]; ++at[axis])
        for (at[other] = 0; at[other] < cells[other]; ++at[other])
          for (at[run] = 0; at[run] < cells[run]; ++at[run])
          {
            if (!exposed(at)) continue;
            const int start = at[run];
            while (at[run] + 1 < cells[run])
            {
              ++at[run];
              if (exposed(at)) continue;
              --at[run];
              break;
            }
            std::array<Eigen::Vector3f, 4> corners;
            for (std::size_t corner = 0; corner < 4; ++corner)
            {
              Eigen::Vector3f& point = corners[corner];
              point[static_cast<Eigen::Index>(axis)] = static_cast<float>(at[axis] + (side > 0 ? 1 : 0));
              point[static_cast<Eigen::Index>(run)] = static_cast<float>(corner % 3 == 0 ? start : at[run] + 1);
              point[static_cast<Eigen::Index>(other)] = static_cast<float>(at[other] + (corner >= 2 ? 1 : 0));
              point = low + cell * point;
            }
            const Eigen::Vector3f normal = (corners[1] - corners[0]).cross(corners[3] - corners[0]);
            if (normal[static_cast<Eigen::Index>(axis)] * static_cast<float>(side) < 0)
              std::reverse(corners.begin(), corners.end());
            builder.Face(corners, Material::kTint);
          }
    }
  }
  return builder.Take();
}

}  // namespace

Model TerrainModel(const Terrain& terrain, const std::string& name)
{
  Model model;
  model.name = name;
  model.is_terrain = true;
  if (const auto* heights = dynamic_cast<const HeightTerrain*>(&terrain))
    model.levels = {HeightMesh(*heights, 1), HeightMesh(*heights, 2), HeightMesh(*heights, 4)};
  else if (const auto* voxels = dynamic_cast<const VoxelTerrain*>(&terrain))
    model.levels = {VoxelMesh(*voxels, 1), VoxelMesh(*voxels, 2), VoxelMesh(*voxels, 4)};
  Measure(model);
  return model;
}

}  // namespace swarmanoid

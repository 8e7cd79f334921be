#include "visualiser/scene/simplify_mesh.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>
#include <unordered_map>

namespace swarmanoid
{
namespace
{

constexpr int kFinestCells = 512;  // along the longest side
constexpr int kCoarsestCells = 4;

using CellKey = std::uint64_t;

// Returns the mesh with the vertices of each cell merged at their mean.
Mesh Clustered(const Mesh& mesh, const Eigen::AlignedBox3f& box, int cells)
{
  const float edge = box.sizes().maxCoeff() / static_cast<float>(cells);
  const auto key_of = [&](const Eigen::Vector3f& position)
  {
    CellKey key = 0;
    for (int axis = 0; axis < 3; ++axis)
      key = key << 16U | static_cast<CellKey>(std::floor((position[axis] - box.min()[axis]) / edge));
    return key;
  };
  std::unordered_map<CellKey, std::uint32_t> numbers;
  std::vector<Eigen::Vector3f> sums;
  std::vector<float> counts;
  std::vector<std::uint32_t> cell_of(mesh.vertices.size());
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
  {
    const auto [place, is_new] =
        numbers.emplace(key_of(mesh.vertices[v].position), static_cast<std::uint32_t>(sums.size()));
    if (is_new)
    {
      sums.emplace_back(Eigen::Vector3f::Zero());
      counts.push_back(0);
    }
    cell_of[v] = place->second;
    sums[place->second] += mesh.vertices[v].position;
    ++counts[place->second];
  }

  Mesh simple;
  std::unordered_map<std::uint32_t, std::uint32_t> kept;  // by cell and attributes of the vertex
  std::set<std::array<std::uint32_t, 3>> there;           // triangles by their cells
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
  {
    std::array<std::uint32_t, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) corners[k] = cell_of[mesh.indices[i + k]];
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) continue;
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    if (!there.insert(corners).second) continue;
    for (std::size_t k = 0; k < 3; ++k)
    {
      const std::uint32_t vertex = mesh.indices[i + k];
      const auto [place, is_new] = kept.emplace(vertex, static_cast<std::uint32_t>(simple.vertices.size()));
      if (is_new)
      {
        simple.vertices.push_back(mesh.vertices[vertex]);
        simple.vertices.back().position = sums[cell_of[vertex]] / counts[cell_of[vertex]];
      }
      simple.indices.push_back(place->second);
    }
  }
  return simple;
}

}  // namespace

Mesh Simplified(const Mesh& mesh, std::size_t most_triangles)
{
  if (mesh.Triangles() <= most_triangles) return mesh;
  Eigen::AlignedBox3f box;
  for (const MeshVertex& vertex : mesh.vertices) box.extend(vertex.position);
  Mesh simple;
  for (int cells = kFinestCells; cells >= kCoarsestCells; cells = cells * 3 / 4)
  {
    simple = Clustered(mesh, box, cells);
    if (simple.Triangles() <= most_triangles) break;
  }
  return simple;
}

}  // namespace swarmanoid

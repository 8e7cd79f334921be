// Meshes of users: glTF 2.0 (.glb, .gltf), Wavefront (.obj) and STL, read by Assimp. Positions, normals and base
// colours; textures, transparency and animations are left out. Renderers reach them by kind_model.h and object_model.h.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <string>

#include "common/mesh/mesh_points.h"
#include "visualiser/scene/mesh.h"

namespace swarmanoid
{

inline constexpr std::size_t kMostDrawnTriangles = 20'000;  // larger meshes are simplified

struct MeshFile
{
  // The meshes are in metres, z up, x to the front. In glTF, y is up and z is to the front (its specification, 3.4);
  // the other formats are taken as they are. The material is kPainted, or kTint for a file without colours.
  std::array<Mesh, kLevels> levels;
  Eigen::AlignedBox3f box;
};

// Throws FileError with the reason, without the path. Any thread may call it.
MeshFile ReadMeshFile(const std::string& path);
// Returns the same, read once in a process for each path.
std::shared_ptr<const MeshFile> LoadMeshFile(const std::string& path);

}  // namespace swarmanoid

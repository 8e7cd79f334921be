// Reads the points of the surface of a mesh file, for bodies that collide as a mesh. Every process reads them while the
// experiment is read.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "common/math/pose.h"

namespace swarmanoid
{

// the limit for the file and the files that it names
inline constexpr std::size_t kMostMeshBytes = std::size_t{64} << 20U;
inline constexpr std::size_t kMostMeshTriangles = 1'000'000;

struct MeshPoints
{
  std::vector<Vector3> corners;  // m, z up, x to the front
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

// Throws FileError with the reason, without the path. Any thread may call it. The first call loads the library
// mesh_files and with it Assimp, whose loading takes a seventh of the start of a process.
MeshPoints ReadMeshPoints(const std::string& path);

// The function of that library, by its name. Throws like ReadMeshPoints.
extern "C" void ImportMeshPoints(const std::string& path, MeshPoints& points);

}  // namespace swarmanoid

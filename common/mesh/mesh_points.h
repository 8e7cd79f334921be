// Where the surface of a mesh file is: what a body is made from that collides as a mesh. Read while the experiment is
// read, in every process.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "common/math/pose.h"

namespace swarmanoid
{

inline constexpr std::size_t kMostMeshBytes = std::size_t{64} << 20U;  // of the file and those that it names
inline constexpr std::size_t kMostMeshTriangles = 1'000'000;

struct MeshPoints
{
  std::vector<Vector3> corners;  // m, z up, x to the front
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

// Throws FileError with the reason, without the path. Any thread.
MeshPoints ReadMeshPoints(const std::string& path);

}  // namespace swarmanoid

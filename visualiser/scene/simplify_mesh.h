// Meshes with fewer triangles, for what is far away.
#pragma once

#include <cstddef>

#include "visualiser/scene/mesh.h"

namespace swarmanoid
{

// The mesh itself if it has at most so many triangles; otherwise one whose vertices are brought together cell by cell
// of a grid, the finest that leaves so few (J. Rossignac and P. Borrel, Multi-resolution 3D approximations for
// rendering complex scenes, 1993). Normals, materials and colours stay those of the corners.
Mesh Simplified(const Mesh& mesh, std::size_t most_triangles);

}  // namespace swarmanoid

// Simplifies meshes, for distant bodies.
#pragma once

#include <cstddef>

#include "visualiser/scene/mesh.h"

namespace swarmanoid
{

// Returns the mesh itself if it has at most so many triangles. Otherwise the vertices in each cell of a grid are
// merged, with the finest grid that leaves so few (J. Rossignac and P. Borrel, Multi-resolution 3D approximations for
// rendering complex scenes, 1993). Normals, materials and colours stay those of the corners.
Mesh Simplified(const Mesh& mesh, std::size_t most_triangles);

}  // namespace swarmanoid

// Replaces mesh_points.cpp and import_mesh.cpp in a build without Assimp.
#include "common/configuration/regular_file.h"
#include "common/mesh/mesh_points.h"

namespace swarmanoid
{

MeshPoints ReadMeshPoints(const std::string&)
{
  throw FileError("this build reads no meshes: install libassimp-dev, then build again");
}

}  // namespace swarmanoid

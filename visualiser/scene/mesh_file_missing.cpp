// Replaces mesh_file.cpp in a build without Assimp.
#include "common/configuration/regular_file.h"
#include "visualiser/scene/mesh_file.h"

namespace swarmanoid
{

MeshFile ReadMeshFile(const std::string&)
{
  throw FileError("this build reads no meshes: install libassimp-dev, then build again");
}

std::shared_ptr<const MeshFile> LoadMeshFile(const std::string& path)
{
  return std::make_shared<const MeshFile>(ReadMeshFile(path));
}

}  // namespace swarmanoid

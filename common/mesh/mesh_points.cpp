#include "common/mesh/mesh_points.h"

#include <stdexcept>

#include "common/configuration/regular_file.h"
#include "common/plugins/own_library.h"

namespace swarmanoid
{
namespace
{

using Import = decltype(&ImportMeshPoints);

// Throws FileError if the library is missing, as in a build without Assimp.
Import LoadImport()
{
  try
  {
    return reinterpret_cast<Import>(FunctionOfOwnLibrary("mesh_files", "ImportMeshPoints"));
  }
  catch (const std::runtime_error& error)
  {
    throw FileError("this installation reads no meshes (" + std::string(error.what()) +
                    "): install libassimp-dev, then build again");
  }
}

}  // namespace

MeshPoints ReadMeshPoints(const std::string& path)
{
  static const Import import = LoadImport();
  MeshPoints points;
  import(path, points);
  return points;
}

}  // namespace swarmanoid

#include "common/mesh/mesh_points.h"

#include <dlfcn.h>

#include "common/configuration/regular_file.h"
#include "common/math/reproducible_math.h"
#include "common/plugins/library.h"

namespace swarmanoid
{
namespace
{

using Import = decltype(&ImportMeshPoints);

// Throws FileError if the library is missing, as in a build without Assimp.
Import LoadImport()
{
  const std::string file = OwnLibraryFolder() + "/" SWARMANOID_MESH_LIBRARY;
  void* const library = OpenLibrary(file);
  void* const function = library == nullptr ? nullptr : dlsym(library, "ImportMeshPoints");
  if (function == nullptr)
    throw FileError("this installation reads no meshes (" + std::string(dlerror()) +
                    "): install libassimp-dev, then build again");
  return reinterpret_cast<Import>(function);
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

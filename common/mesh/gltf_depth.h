// Checks of a glTF file that Assimp does not make. For import_mesh.cpp.
#pragma once

#include <string_view>

namespace swarmanoid
{

// Throws FileError for a file with too many levels, one that is no JSON, or a version other than 2. Assimp reads nested
// values and nodes by recursion, which many levels would take through the end of the stack. `bytes`: the content of a
// .glb or .gltf file.
void CheckGltf(std::string_view bytes);

}  // namespace swarmanoid

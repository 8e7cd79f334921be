// What Assimp does not check of a glTF file. For import_mesh.cpp.
#pragma once

#include <string_view>

namespace swarmanoid
{

// Assimp reads values in values and nodes below nodes by recursion, which a file of many levels takes through the end
// of the stack. Throws FileError for such a file, for one that is no JSON, and for another version than 2. bytes: of a
// .glb or .gltf file.
void CheckGltf(std::string_view bytes);

}  // namespace swarmanoid

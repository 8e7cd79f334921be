// Any bytes with the ending of a mesh file (.glb, .gltf, .obj, .stl) are refused with a reason, or are triangles whose
// corners are finite and in the mesh.
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <string>

#include "common/configuration/regular_file.h"
#include "tests/fuzz/fuzz_driver.h"
#include "visualiser/scene/mesh_file.h"

namespace swarmanoid
{
namespace
{

void Take(const fuzz::Input& bytes, const char* ending)
{
  const std::string path = "mesh_fuzzer." + std::to_string(getpid()) + ending;
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  try
  {
    const MeshFile file = ReadMeshFile(path);
    if (file.levels[0].indices.empty() || file.levels[0].Triangles() > kMostDrawnTriangles) std::abort();
    for (const Mesh& mesh : file.levels)
    {
      for (const std::uint32_t index : mesh.indices)
        if (index >= mesh.vertices.size()) std::abort();
      for (const MeshVertex& vertex : mesh.vertices)
        if (!vertex.position.allFinite() || !vertex.normal.allFinite()) std::abort();
    }
  }
  catch (const FileError& error)
  {
    if (std::string(error.what()).empty()) std::abort();
  }
  unlink(path.c_str());
}

fuzz::Input Bytes(const std::string& text) { return {text.begin(), text.end()}; }

// A triangle of 36 bytes behind its JSON.
fuzz::Input Glb(std::string json)
{
  json.append((4 - json.size() % 4) % 4, ' ');
  const auto word = [](std::size_t number)
  {
    std::string bytes;
    for (unsigned k = 0; k < 4; ++k) bytes += static_cast<char>(number >> 8 * k & 0xff);
    return bytes;
  };
  const std::string corners = std::string("\0\0\0\0\0\0\0\0\0\0\x80\x3f", 12) +
                              std::string("\0\0\x80\x3f\0\0\0\0\0\0\0\0", 12) +
                              std::string("\0\0\0\0\0\0\x80\x3f\0\0\0\0", 12);
  return Bytes("glTF" + word(2) + word(28 + json.size() + corners.size()) + word(json.size()) + "JSON" + json +
               word(corners.size()) + std::string("BIN\0", 4) + corners);
}

const std::string kGltf =
    R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"scale":[1,-1,1],"children":[1]},{"mesh":0}],)"
    R"("materials":[{"doubleSided":true,"pbrMetallicRoughness":{"baseColorFactor":[1,0.5,0,1]}}],)"
    R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],"buffers":[{"byteLength":36}],)"
    R"("bufferViews":[{"buffer":0,"byteLength":36}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}]})";

}  // namespace

std::vector<fuzz::Input> fuzz::FirstInputs()
{
  return {
      Glb(kGltf), Bytes(kGltf),
      Bytes("mtllib a.mtl\no box\nv 0 0 0\nv 1 0 0 1 0 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\nusemtl red\nf 1//1 2//1 3//1\nf "
            "-3 -2 -1\n"),
      Bytes("solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
            "0\nendloop\nendfacet\nendsolid s\n"),
      Bytes(std::string(80, ' ') + std::string("\1\0\0\0", 4) + std::string(50, '\x3f'))};
}

std::vector<fuzz::Input> fuzz::Words()
{
  std::vector<Input> words;
  for (const char* word : {"\"children\":[0]", "\"byteStride\":", "\"sparse\":{\"count\":9}", "\"indices\":0",
                           "\"mode\":", "\"count\":", "4294967295", "-1", "1e38", "nan", "5125", "\"MAT4\"", "facet",
                           "f 1 2 3\n", "v 0 0 0\n", "l 1 2\n", "g a b\n", "usemtl "})
    words.push_back(Bytes(word));
  return words;
}

}  // namespace swarmanoid

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* input, std::size_t count)
{
  const swarmanoid::fuzz::Input bytes(input, input + count);
  for (const char* ending : {".glb", ".gltf", ".obj", ".stl"}) swarmanoid::Take(bytes, ending);
  return 0;
}

#include "common/mesh/import_mesh.h"

#include <fmt/format.h>

#include <assimp/BaseImporter.h>
#include <assimp/MemoryIOWrapper.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <string_view>
#include <utility>

#include "common/configuration/regular_file.h"
#include "common/mesh/gltf_depth.h"
#include "common/mesh/mesh_points.h"

namespace swarmanoid
{
namespace
{

constexpr float kFarthestVertex = 1e4F;  // m from the origin: the limit for vertices
constexpr float kSmoothDegrees = 40;     // in files without normals, sharper edges stay edges

const char* const kReduce = "make it smaller, for example by Blender's modifier Decimate";

// Gives Assimp the files that it opens: only regular ones, and limited in their total size.
class LimitedFiles : public Assimp::IOSystem
{
public:
  bool Exists(const char* path) const override { return FileMistake(path).empty(); }
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char* path, const char* mode) override
  {
    if (std::string_view(mode).find('w') != std::string_view::npos) return nullptr;
    try
    {
      const std::string& bytes = BytesOf(path);
      return new Assimp::MemoryIOStream(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
    }
    catch (const FileError&)
    {
      return nullptr;  // Assimp reports the missing file
    }
  }
  void Close(Assimp::IOStream* stream) override { delete stream; }

  // Returns the content of a file, and reads it at most once. Throws FileError.
  const std::string& BytesOf(const std::string& path)
  {
    if (const auto known = files_.find(path); known != files_.end()) return known->second;
    std::string bytes = ReadRegularFile(path, left_);
    left_ -= bytes.size();
    return files_.emplace(path, std::move(bytes)).first->second;
  }

private:
  std::map<std::string, std::string> files_;
  std::size_t left_ = kMostMeshBytes;
};

std::string EndingOf(const std::string& path)
{
  std::string ending = std::filesystem::path(path).extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

// Assimp guesses the format of unknown files. Only formats that are checked here may be guessed.
void KeepOurFormats(Assimp::Importer& importer)
{
  for (std::size_t i = importer.GetImporterCount(); i-- > 0;)
  {
    const aiImporterDesc* description = importer.GetImporterInfo(i);
    const std::string_view name = description == nullptr ? "" : description->mName;
    if (name.starts_with("glTF2") || name.starts_with("Wavefront") || name.starts_with("Stereolithography")) continue;
    const std::unique_ptr<Assimp::BaseImporter> unused(importer.GetImporter(i));
    importer.UnregisterLoader(unused.get());
  }
}

void Walk(const aiScene& scene, const aiNode& node, const aiMatrix4x4& parent, std::size_t& triangles,
          const std::function<void(const aiMesh& part, const aiMatrix4x4& place)>& take)
{
  const aiMatrix4x4 place = parent * node.mTransformation;
  for (unsigned m = 0; m < node.mNumMeshes; ++m)
  {
    const aiMesh& part = *scene.mMeshes[node.mMeshes[m]];
    triangles += part.mNumFaces;
    if (triangles > kMostMeshTriangles)
      throw FileError(fmt::format("it has more than {} triangles; {}", kMostMeshTriangles, kReduce));
    take(part, place);
  }
  for (unsigned child = 0; child < node.mNumChildren; ++child)
    Walk(scene, *node.mChildren[child], place, triangles, take);
}

}  // namespace

ImportedMesh::ImportedMesh(const std::string& path) : importer_(std::make_unique<Assimp::Importer>())
{
  const std::string ending = EndingOf(path);
  is_gltf_ = ending == ".glb" || ending == ".gltf";
  Assimp::Importer& importer = *importer_;
  KeepOurFormats(importer);
  auto* files = new LimitedFiles;  // the importer owns it
  importer.SetIOHandler(files);
  const std::string& bytes = files->BytesOf(path);
  if (is_gltf_) CheckGltf(bytes);
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  importer.SetPropertyFloat(AI_CONFIG_PP_GSN_MAX_SMOOTHING_ANGLE, kSmoothDegrees);
  int unused = aiComponent_TANGENTS_AND_BITANGENTS | aiComponent_TEXCOORDS | aiComponent_BONEWEIGHTS |
               aiComponent_ANIMATIONS | aiComponent_TEXTURES | aiComponent_LIGHTS | aiComponent_CAMERAS;
  // The normals of STL are those of its triangles, so round shapes would have edges.
  if (ending == ".stl") unused |= aiComponent_NORMALS;
  importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS, unused);
  // A glTF file without normals is flat by its specification.
  const unsigned normals = is_gltf_ ? aiProcess_GenNormals : aiProcess_GenSmoothNormals;
  scene_ = importer.ReadFile(path, aiProcess_ValidateDataStructure | aiProcess_RemoveComponent | aiProcess_Triangulate |
                                       normals | aiProcess_JoinIdenticalVertices | aiProcess_SortByPType);
  if (scene_ == nullptr)
  {
    std::string reason = importer.GetErrorString();
    while (reason.ends_with('.') || reason.ends_with('\n')) reason.pop_back();
    throw FileError(fmt::format("it cannot be read: {}; export it again, for example as .glb with Blender", reason));
  }
  if (scene_->mRootNode == nullptr) throw FileError("it has no triangles");
}

ImportedMesh::~ImportedMesh() = default;

void ImportedMesh::ForEachPart(const std::function<void(const aiMesh& part, const aiMatrix4x4& place)>& take) const
{
  std::size_t triangles = 0;
  Walk(*scene_, *scene_->mRootNode, aiMatrix4x4(), triangles, take);
}

Eigen::Vector3f ImportedMesh::VertexOf(const aiMesh& part, unsigned number, const aiMatrix4x4& place) const
{
  const Eigen::Vector3f vertex = ToOurs(place * part.mVertices[number]);
  if (!vertex.allFinite() || vertex.cwiseAbs().maxCoeff() > kFarthestVertex)
    throw FileError(fmt::format("a vertex is at no place, or farther than {:g} m from the origin; meshes are in metres",
                                kFarthestVertex));
  return vertex;
}

}  // namespace swarmanoid

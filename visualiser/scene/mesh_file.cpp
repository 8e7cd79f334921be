#include "visualiser/scene/mesh_file.h"

#include <fmt/format.h>

#include <assimp/BaseImporter.h>
#include <assimp/MemoryIOWrapper.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <map>
#include <mutex>
#include <set>
#include <string_view>
#include <utility>

#include "common/configuration/regular_file.h"
#include "visualiser/scene/gltf_depth.h"
#include "visualiser/scene/simplify_mesh.h"

namespace swarmanoid
{
namespace
{

using Eigen::Vector3f;

constexpr float kFarthestVertex = 1e4F;       // m from the origin
constexpr float kSmoothDegrees = 40;          // sharper edges stay edges, in files without normals
constexpr std::size_t kMostMeshColours = 64;  // beyond it, six shades each of red, green and blue
constexpr std::array<std::size_t, kLevels> kMostTrianglesOfLevel{kMostDrawnTriangles, 1500, 150};

const char* const kReduce = "make it smaller, for example by Blender's modifier Decimate";

// Files as Assimp asks for them: regular ones, and not too much of them in all.
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
      return nullptr;  // Assimp says which file it lacks
    }
  }
  void Close(Assimp::IOStream* stream) override { delete stream; }

  // Throws FileError.
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

// Assimp guesses the format of what it cannot read: only the ones that are checked here may be guessed.
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

float SrgbOf(float linear)
{
  return linear <= 0.0031308F ? 12.92F * linear : 1.055F * std::pow(linear, 1 / 2.4F) - 0.055F;
}

Colour PackedColour(const aiColor4D& colour, bool is_linear)
{
  Colour packed = 0;
  for (const float channel : {colour.r, colour.g, colour.b})
  {
    const float value = std::isfinite(channel) ? std::clamp(channel, 0.0F, 1.0F) : 0.0F;
    packed = packed << 8U | static_cast<Colour>(std::lround(255 * (is_linear ? SrgbOf(value) : value)));
  }
  return packed;
}

// Puts the meshes of a file together, each at each of its nodes.
class Assembler
{
public:
  Assembler(const aiScene& scene, bool is_gltf) : scene_(scene), is_gltf_(is_gltf) {}

  Mesh Assemble()
  {
    AddNode(*scene_.mRootNode, aiMatrix4x4());
    if (mesh_.indices.empty()) throw FileError("it has no triangles");
    std::set<Colour> colours;
    for (const MeshVertex& vertex : mesh_.vertices) colours.insert(vertex.colour);
    for (MeshVertex& vertex : mesh_.vertices)
    {
      if (colours.size() > kMostMeshColours) vertex.colour = OfFewShades(vertex.colour);
      if (is_painted_) vertex.material = Material::kPainted;
    }
    return std::move(mesh_);
  }

private:
  // For what has no material Assimp makes one: of glTF files the last, of others one of this name.
  bool IsPainted(const aiMesh& part) const
  {
    if (is_gltf_) return part.mMaterialIndex + 1 < scene_.mNumMaterials;
    return std::string_view(scene_.mMaterials[part.mMaterialIndex]->GetName().C_Str()) != AI_DEFAULT_MATERIAL_NAME;
  }

  void AddNode(const aiNode& node, const aiMatrix4x4& parent)
  {
    const aiMatrix4x4 place = parent * node.mTransformation;
    for (unsigned m = 0; m < node.mNumMeshes; ++m) AddMesh(*scene_.mMeshes[node.mMeshes[m]], place);
    for (unsigned child = 0; child < node.mNumChildren; ++child) AddNode(*node.mChildren[child], place);
  }

  Vector3f ToOurs(const aiVector3D& v) const { return is_gltf_ ? Vector3f(v.z, v.x, v.y) : Vector3f(v.x, v.y, v.z); }

  void AddMesh(const aiMesh& part, const aiMatrix4x4& place)
  {
    if (mesh_.Triangles() + part.mNumFaces > kMostMeshTriangles)
      throw FileError(fmt::format("it has more than {} triangles; {}", kMostMeshTriangles, kReduce));
    const aiMaterial& material = *scene_.mMaterials[part.mMaterialIndex];
    aiColor4D base(1, 1, 1, 1);
    if (material.Get(AI_MATKEY_BASE_COLOR, base) != aiReturn_SUCCESS) material.Get(AI_MATKEY_COLOR_DIFFUSE, base);
    if (!IsPainted(part)) base = aiColor4D(1, 1, 1, 1);
    is_painted_ |= IsPainted(part) || part.HasVertexColors(0);
    int two_sided = 0;
    material.Get(AI_MATKEY_TWOSIDED, two_sided);
    const aiMatrix3x3 turn(place);
    aiMatrix3x3 normal_turn = turn;
    normal_turn.Inverse().Transpose();
    const bool is_mirrored = turn.Determinant() < 0;
    added_.clear();
    for (unsigned f = 0; f < part.mNumFaces; ++f)
    {
      const aiFace& face = part.mFaces[f];
      if (face.mNumIndices != 3) continue;
      aiColor4D colour = base;
      if (part.HasVertexColors(0))
      {
        aiColor4D sum;
        for (unsigned k = 0; k < 3; ++k) sum += part.mColors[0][face.mIndices[k]];
        colour = base * (sum / 3.0F);
      }
      const Colour paint = PackedColour(colour, is_gltf_);
      for (const bool back : {false, true})
      {
        if (back && two_sided == 0) break;
        for (unsigned k = 0; k < 3; ++k)
        {
          const unsigned vertex = face.mIndices[back != is_mirrored ? 2 - k : k];
          mesh_.indices.push_back(Vertex(part, vertex, paint, back, place, normal_turn));
        }
      }
    }
  }

  // One for each colour and side that it has.
  std::uint32_t Vertex(const aiMesh& part, unsigned number, Colour paint, bool back, const aiMatrix4x4& place,
                       const aiMatrix3x3& normal_turn)
  {
    const auto next = static_cast<std::uint32_t>(mesh_.vertices.size());
    const auto [known, is_new] = added_.emplace(std::tuple(number, paint, back), next);
    if (!is_new) return known->second;
    MeshVertex& vertex = mesh_.vertices.emplace_back();
    vertex.position = ToOurs(place * part.mVertices[number]);
    if (!vertex.position.allFinite() || vertex.position.cwiseAbs().maxCoeff() > kFarthestVertex)
      throw FileError(fmt::format(
          "a vertex is at no place, or farther than {:g} m from the origin; meshes are in metres", kFarthestVertex));
    Vector3f normal = part.HasNormals() ? ToOurs(normal_turn * part.mNormals[number]) : Vector3f::UnitZ();
    if (!normal.allFinite() || normal.norm() < 1e-12F) normal = Vector3f::UnitZ();
    vertex.normal = (back ? -normal : normal).normalized();
    vertex.colour = paint;
    return next;
  }

  const aiScene& scene_;
  bool is_gltf_;
  bool is_painted_ = false;
  std::map<std::tuple<unsigned, Colour, bool>, std::uint32_t> added_;  // of the mesh that is being added
  Mesh mesh_;
};

Mesh ReadMesh(const std::string& path)
{
  const std::string ending = EndingOf(path);
  const bool is_gltf = ending == ".glb" || ending == ".gltf";
  Assimp::Importer importer;
  KeepOurFormats(importer);
  auto* files = new LimitedFiles;  // the importer's
  importer.SetIOHandler(files);
  const std::string& bytes = files->BytesOf(path);
  if (is_gltf) CheckGltf(bytes);
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  importer.SetPropertyFloat(AI_CONFIG_PP_GSN_MAX_SMOOTHING_ANGLE, kSmoothDegrees);
  int unused = aiComponent_TANGENTS_AND_BITANGENTS | aiComponent_TEXCOORDS | aiComponent_BONEWEIGHTS |
               aiComponent_ANIMATIONS | aiComponent_TEXTURES | aiComponent_LIGHTS | aiComponent_CAMERAS;
  // The normals of STL are those of its triangles: round things would have edges.
  if (ending == ".stl") unused |= aiComponent_NORMALS;
  importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS, unused);
  // Without normals glTF is flat, as it says.
  const unsigned normals = is_gltf ? aiProcess_GenNormals : aiProcess_GenSmoothNormals;
  const aiScene* scene =
      importer.ReadFile(path, aiProcess_ValidateDataStructure | aiProcess_RemoveComponent | aiProcess_Triangulate |
                                  normals | aiProcess_JoinIdenticalVertices | aiProcess_SortByPType);
  if (scene == nullptr)
  {
    std::string reason = importer.GetErrorString();
    while (reason.ends_with('.') || reason.ends_with('\n')) reason.pop_back();
    throw FileError(fmt::format("it cannot be read: {}; export it anew, for example as .glb with Blender", reason));
  }
  if (scene->mRootNode == nullptr) throw FileError("it has no triangles");
  return Assembler(*scene, is_gltf).Assemble();
}

}  // namespace

MeshFile ReadMeshFile(const std::string& path)
{
  try
  {
    Mesh mesh = ReadMesh(path);
    MeshFile file;
    for (const MeshVertex& vertex : mesh.vertices) file.box.extend(vertex.position);
    for (std::size_t level = 0; level < kLevels; ++level)
      mesh = file.levels[level] = Simplified(mesh, kMostTrianglesOfLevel[level]);
    return file;
  }
  catch (const FileError&)
  {
    throw;
  }
  catch (const std::exception& error)  // of Assimp, or of memory
  {
    throw FileError(error.what());
  }
}

std::shared_ptr<const MeshFile> LoadMeshFile(const std::string& path)
{
  static std::mutex mutex;
  static std::map<std::string, std::shared_ptr<const MeshFile>> loaded;
  const std::lock_guard lock(mutex);
  std::shared_ptr<const MeshFile>& file = loaded[path];
  if (!file) file = std::make_shared<const MeshFile>(ReadMeshFile(path));
  return file;
}

}  // namespace swarmanoid

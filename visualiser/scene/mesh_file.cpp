// Problem: draw mesh files of users, of any size and with any materials, like our own models.
//
// Method: Assimp reads the file. All parts are joined in one mesh, with the transforms of their nodes. Colours of
// materials and vertices become the colour of each triangle. Parts that are seen from both sides get each triangle
// twice. The mesh is then simplified to three levels of detail (simplify_mesh.h).
//
// Invariant: mirrored nodes reverse the order of corners, so that outsides stay outside.
#include "visualiser/scene/mesh_file.h"

#include <fmt/format.h>

#include <assimp/material.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <set>
#include <string_view>
#include <utility>

#include "common/configuration/regular_file.h"
#include "common/mesh/import_mesh.h"
#include "visualiser/scene/simplify_mesh.h"

namespace swarmanoid
{
namespace
{

using Eigen::Vector3f;

constexpr std::size_t kMostMeshColours = 64;  // with more colours, six shades each of red, green and blue
constexpr std::array<std::size_t, kLevels> kMostTrianglesOfLevel{kMostDrawnTriangles, 1500, 150};

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

// Joins the meshes of a file, each at each of its nodes.
class Assembler
{
public:
  explicit Assembler(const ImportedMesh& imported) : imported_(imported), scene_(imported.Scene()) {}

  Mesh Assemble()
  {
    imported_.ForEachPart([&](const aiMesh& part, const aiMatrix4x4& place) { AddMesh(part, place); });
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
  // Returns whether a part has a material in the file. Assimp adds one for parts without: the last one in glTF files,
  // one of this name in others.
  bool IsPainted(const aiMesh& part) const
  {
    if (imported_.IsGltf()) return part.mMaterialIndex + 1 < scene_.mNumMaterials;
    return std::string_view(scene_.mMaterials[part.mMaterialIndex]->GetName().C_Str()) != AI_DEFAULT_MATERIAL_NAME;
  }

  void AddMesh(const aiMesh& part, const aiMatrix4x4& place)
  {
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
      const Colour paint = PackedColour(colour, imported_.IsGltf());
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

  // Adds a vertex once for each colour and side.
  std::uint32_t Vertex(const aiMesh& part, unsigned number, Colour paint, bool back, const aiMatrix4x4& place,
                       const aiMatrix3x3& normal_turn)
  {
    const auto next = static_cast<std::uint32_t>(mesh_.vertices.size());
    const auto [known, is_new] = added_.emplace(std::tuple(number, paint, back), next);
    if (!is_new) return known->second;
    MeshVertex& vertex = mesh_.vertices.emplace_back();
    vertex.position = imported_.VertexOf(part, number, place);
    Vector3f normal = part.HasNormals() ? imported_.ToOurs(normal_turn * part.mNormals[number]) : Vector3f::UnitZ();
    if (!normal.allFinite() || normal.norm() < 1e-12F) normal = Vector3f::UnitZ();
    vertex.normal = (back ? -normal : normal).normalized();
    vertex.colour = paint;
    return next;
  }

  const ImportedMesh& imported_;
  const aiScene& scene_;
  bool is_painted_ = false;
  std::map<std::tuple<unsigned, Colour, bool>, std::uint32_t> added_;  // the vertices of the mesh that is being added
  Mesh mesh_;
};

}  // namespace

MeshFile ReadMeshFile(const std::string& path)
{
  try
  {
    const ImportedMesh imported(path);
    Mesh mesh = Assembler(imported).Assemble();
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
  catch (const std::exception& error)  // an error of Assimp or of memory
  {
    throw FileError(error.what());
  }
}

std::shared_ptr<const MeshFile> LoadMeshFile(const std::string& path)
{
  static std::mutex mutex;  // guards loaded
  static std::map<std::string, std::shared_ptr<const MeshFile>> loaded;
  const std::lock_guard lock(mutex);
  std::shared_ptr<const MeshFile>& file = loaded[path];
  if (!file) file = std::make_shared<const MeshFile>(ReadMeshFile(path));
  return file;
}

}  // namespace swarmanoid
